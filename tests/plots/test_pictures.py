"""Pictures of any kind: their axes, texts and files; and those of energy and of charts."""

import functools
import subprocess
import sys
import warnings
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from cycler import cycler
from hypothesis import Phase, given, settings
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

import optipath as op
from charts import charts, texts_over_marks
from measured_hemispheres import measured
from optipath.lab.chart_file import KINDS, read_chart
from optipath.plots import energy
from optipath.plots.axes import own_axes, own_panel
from optipath.plots.poincare_sphere import sphere_axes
from pictures import faults_of, texts_of
from tables import rows, slow

NAN = np.nan
MALUS, LIGHT = op.load_preset("malus"), op.Light([1.0, 0.6, 0.0, 0.8])
FEW = {"x_values": [0, 1], "y_values": [0, 1]}


@rows("projection", ["3d", "polar"])
@rows(
    "draw",
    [
        lambda ax: op.plots.curve(MALUS, "angle", ax=ax),
        lambda ax: op.plots.quantity_map(MALUS, "angle", "intensity", ax=ax, **FEW),
        lambda ax: op.plots.reflection(1.5, ax),
        lambda ax: op.plots.energy(MALUS, ax),
        lambda ax: op.plots.stokes(LIGHT, ax),
        lambda ax: op.plots.ellipse(LIGHT, ax),
        lambda ax: op.plots.bench(MALUS, ax),
        lambda ax: op.plots.geometry(MALUS, ax),
        lambda ax: op.plots.hemisphere(measured("mirror"), "S0", ax),
    ],
)
def test_a_flat_picture_refuses_axes_in_space_and_of_angles_and_leaves_them_empty(draw, projection):
    ax = Figure().add_subplot(projection=projection)
    with pytest.raises(op.OptipathError, match="give flat Axes"):
        draw(ax)
    assert not [*ax.lines, *ax.patches, *ax.collections]
    with pytest.raises(op.OptipathError, match="ax is 3; give flat Axes, as"):
        draw(3)


@rows(
    "made",
    [
        lambda: own_axes(None, (3.0, 3.0)),
        lambda: own_panel(None, (1, 2), (3.0, 3.0))[0, 1],
        lambda: sphere_axes(None, (3.0, 3.0)),
    ],
)
def test_lines_are_solid_where_matplotlib_is_told_to_dash_them(made):
    with mpl.rc_context({"axes.prop_cycle": cycler(color=["k"], linestyle=[":"])}):
        (line,) = made().plot([0, 1], [0, 1], color="r")
    assert line.get_linestyle() == "-"


@rows("draw", ["mueller_hemisphere", "differences", "beside_facets"])
def test_axes_of_another_shape_and_in_space_are_no_panel(draw):
    silver, figure = measured("silver", events=1), Figure()
    with pytest.raises(op.OptipathError, match=r"give \d x \d Axes of Matplotlib, as figure.subpl"):
        getattr(op.plots, draw)(silver, figure.subplots(1, 2))
    panel = [figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="3d")]
    with pytest.raises(op.OptipathError, match="give 1 x 2 Axes of Matplotlib"):
        own_panel(panel, (1, 2), (1.0, 1.0))
    assert np.shape(own_panel(panel[:1], (1, 1), (1.0, 1.0))) == (1, 1)


# Texts.

NAMED = ("S0", "S1", "S2", "S3", "DoP", "DoLP")
WAVES = {"x_values": "400 nm:700 nm:9", "y_values": "0 deg:90 deg:9"}
ROW = op.Light([[1.0, np.cos(a), np.sin(a), 0.0] for a in range(6)])
UNREAD, FAINT = op.Light([1.0, NAN, NAN, NAN]), op.Light([1e-300, 0.0, 0.6e-300, 0.3e-300])
STATES = op.Light([[1, -0.6, 0, 0.8], [1, -0.2, -0.9, 0.1], [0, 0, 0, 0], [1, 0, 0, 0]])
ANGLES = np.radians(np.arange(0.0, 181.0, 10.0))
TRAIL = op.Retarder(ANGLES, "10 deg") @ op.Light([1.0, 0.0, 0.95, 0.0])
LIGHTS = {
    "elliptical": op.Light([2.0, 0.6, 0.9, 0.8]),
    "linear": op.Light([1.0, 0.9, 0.1, 0.0]),
    "circular": op.Light([1.0, 0.0, 0.0, -1.0]),
    "unpolarised": op.Light([1.0, 0.0, 0.0, 0.0]),
    "dark": op.Light(np.zeros(4)),
    "down": op.Light([1.0, -0.5, -0.6, -0.3]),
}
OTHERS = [
    op.Light(np.array([1.0, 0.6, 0.0, 0.8], np.float32)),
    op.Light([1.0, 0.9, 0.3, 0.6], physical=False),
    op.Light([1.0, 0.01, 0.0, 0.01]),
    op.Light([-1.0, 0.0, 0.0, 0.0], physical=False),
]
NUMBERS = np.diag([1.0, 0.5, 0.5, -0.5])
NUMBERS[1, 2] = NAN
GOLD = op.Interface(0.17 + 3.15j, "70 deg").mueller("in", "reflected")
MATRICES = [GOLD, *map(op.Mueller, (NUMBERS, np.zeros((4, 4)), 1e-300 * np.eye(4)))]


def case_of(preset, case):
    """The light of a case, and what is published of it, some in long numbers."""
    path = op.load_preset(preset, case=case)
    (published,) = path.cases[case].published.values()
    return path.trace(), {"published": published}


PATH, PUBLISHED = case_of("npgr026", "8")
TWO = {"first": PATH, "second": 0.5 * PATH}, {"published": {"first": PUBLISHED["published"]}}


DRAWN = [
    (1, "curve", (6.4, 4.2), [("npgr026", "rho", NAMED), ("dichroic-sheet", "retardance", NAMED)]),
    (0, "curve", (6.4, 4.2), [("lyot-depolarizer", "wavelength", NAMED)]),
    (
        1,
        "quantity_map",
        (6.4, 4.8),
        [("copper-gold-spectrum", "wavelength", "delta", "AoP", WAVES)],
    ),
    (1, "reflection", (6.4, 4.4), [(1.00000001, {"outside": 1.00000002})]),
    (0, "reflection", (6.4, 4.4), [("gold", {"outside": "water", "wavelength": "516 nm"})]),
    (2, "ellipse", (5.0, 5.8), [*LIGHTS.values(), *OTHERS, UNREAD, FAINT]),
    (1, "ellipse", (5.0, 7.3), [LIGHTS]),
    (1, "stokes", (5.6, 4.4), [(PATH, PUBLISHED), case_of("achromatic-rhomb", "green"), TWO]),
    (0, "stokes", (5.6, 4.4), [case_of("npgr026", "7"), {"b" * 60: ROW[1], "$x_2$": ROW[2]}]),
    (
        1,
        "stokes",
        (5.6, 4.4),
        [(FAINT, {"published": [1e-300, 0, 5e-301, NAN]}), UNREAD],
    ),
    (1, "mueller", (5.2, 4.6), MATRICES),
    (1, "poincare", (5.4, 5.6), [STATES, TRAIL[0], TRAIL, TRAIL[:9]]),
    (1, "poincare", (6.4, 5.6), [(TRAIL, {"by": np.degrees(ANGLES), "label": "retardance (deg)"})]),
    (1, "poincare_path", (5.4, 6.8), ["senarmont", "npgr026", "faraday-isolator", "two-panes"]),
    (1, "energy", (6.4, 4.8), ["glass-slab", "pile-of-plates", "faraday-isolator"]),
    (1, "geometry", (8.0, 6.0), ["two-panes", "npgr026", "lyot-filter", "faraday-isolator"]),
]
"""Of each kind, how many of several are drawn each time."""
FIRST = [(*kind, several[:few]) for few, *kind, several in DRAWN if few]
OTHER = [(*kind, several[few:]) for few, *kind, several in DRAWN if several[few:]]


@pytest.mark.parametrize(
    ("name", "size", "several"),
    [*FIRST, *(pytest.param(*row, marks=pytest.mark.report) for row in OTHER)],
)
@rows("scale", [1.0, 0.5])
def test_no_text_is_over_another_or_cut_at_either_size(name, size, several, scale):
    for each in several:
        first, *more = each if isinstance(each, tuple) else (each,)
        keys = more.pop() if more and isinstance(more[-1], dict) else {}
        preset = isinstance(first, str) and name != "reflection"
        space = {"projection": "3d"} if name.startswith("poincare") else {}
        figure = Figure(figsize=np.multiply(size, scale), layout="constrained")
        shown = op.load_preset(first) if preset else first
        getattr(op.plots, name)(shown, *more, ax=figure.add_subplot(**space), **keys)
        assert faults_of(figure) == [], first


# Where the power of the light goes.


def message_of(ax):
    """What becomes of light in each row, by its name."""
    texts = [text.get_text() for text in ax.texts]
    return dict(zip(texts[::2], texts[1::2], strict=False))


def ribbons_of(ax, *, named=True):
    """The ribbons of links; or else the spikes of what is taken."""
    shapes = [patch for patch in ax.patches if isinstance(patch, Polygon)]
    return [each for each in shapes if bool(each.get_gid()) is named]


def widths(ax):
    """How wide each ribbon is where it begins, by its link."""
    return {
        each.get_gid(): abs(each.get_xy()[-2, 0] - each.get_xy()[0, 0]) for each in ribbons_of(ax)
    }


def test_ribbons_are_as_wide_as_the_intensity_and_rows_say_what_becomes_of_it():
    ax = energy(MALUS, angle="60 deg")
    assert message_of(ax) == {
        "lamp": "gives 1",
        "polarizer": "takes 0.5 (50 %)",
        "analyzer": "takes 0.375 (37.5 %)",
        "eye": "gets 0.125 (12.5 %)",
    }
    assert [*widths(ax).values()] == pytest.approx([1.0, 0.5, 0.125])
    found = widths(energy(op.load_preset("glass-slab"), theta=0.0))
    assert found["front -> down"] == pytest.approx(0.96 / (1.0 - 0.04**2))
    assert found["up -> front"] == pytest.approx(0.04 * 0.96 / (1.0 - 0.04**2))
    ax = energy(op.load_preset("glass-slab"))
    assert ax.texts[-1].get_text().startswith("light goes round")
    ax.figure.draw_without_rendering()
    boxes = [patch.get_window_extent() for patch in ax.patches]
    names, told = ax.texts[:-1:2], [text for text in ax.texts[1:-1:2] if text.get_text()]
    assert max(text.get_window_extent().x1 for text in names) <= min(box.x0 for box in boxes)
    assert min(text.get_window_extent().x0 for text in told) >= max(box.x1 for box in boxes)
    # Faint and bright light is drawn as any other.
    plain = widths(energy(op.load_preset("npgr026")))
    for power in (1e-300, 1e300):
        ax = energy(op.load_preset("npgr026"), intensity=power)
        assert widths(ax) == pytest.approx(plain, rel=1e-9)
        assert max(plain.values()) == pytest.approx(1.0)
        assert f"gives {power:.3g}" in message_of(ax).values()
        assert faults_of(ax.figure) == []
    # Spikes of what is taken lie over no ribbon.
    ax = energy(op.load_preset("absorbing-pile"))
    ribbons, spikes = ribbons_of(ax), ribbons_of(ax, named=False)
    assert spikes
    for spike in spikes:
        (left, top), *_, (right, _) = spike.get_xy()[:5]
        tip = (left + right) / 2.0, spike.get_xy()[:, 1].min() + 0.01
        within = [(left + share * (right - left), top - 0.1) for share in (0.05, 0.5, 0.95)]
        for point in (*within, tip):
            assert not any(ribbon.get_path().contains_point(point) for ribbon in ribbons)


def test_rounding_gains_darkness_several_sources_and_taps_are_told():
    assert message_of(energy(op.load_preset("senarmont")))["eye"] == "gets 0 (0 %)"
    gain = op.MuellerElement(2.0 * np.eye(4), physical=False)
    ax = energy(op.Source() >> gain.named("laser") >> op.Detector())
    assert message_of(ax)["laser"] == "adds 1 (100 %)"
    assert "'laser' gives more light than it gets" in ax.texts[-1].get_text()
    ax = energy(MALUS, intensity=0.0)
    assert message_of(ax)["eye"] == "gets 0"
    assert faults_of(ax.figure) == []
    found = message_of(energy(op.load_preset("sky-and-window")))
    assert (found["heaven"], found["lamp"]) == ("gives 10", "gives 2")
    with pytest.raises(
        op.OptipathError, match=r"energy draws one path, but .*angle has the shape \(2,\)"
    ):
        energy(MALUS, angle=[0.1, 0.2])
    with pytest.raises(op.OptipathError, match="energy draws a path"):
        energy(op.Polarizer())
    # Taps are dotted and only read.
    found = message_of(energy(op.load_preset("ellipsometer-pcsa"), n=1.5, k=0.0, theta=0.0))
    # The polariser lets half through, and glass of 1.5 reflects 4 % of that.
    assert (found["S.transmitted"], found["state"]) == ("leaves 0.48 (48 %)", "reads 0.02 (2 %)")
    path = op.Source() >> op.Polarizer("0 deg") >> op.Detector()
    path.add("splitter", op.BeamSplitter())
    path.add("probe", op.Detector())
    path.connect("polarizer.out", "splitter.in", tap=True)
    path.connect("splitter.transmitted", "probe.in")
    ax = energy(path)
    found = message_of(ax)
    assert found["splitter"] == "reads 0.5 (50 %)"
    assert found["probe"] == found["splitter.reflected"] == "reads 0.25 (25 %)"
    dotted = [line.get_gid() for line in ax.lines if line.get_linestyle() == ":"]
    assert sorted(dotted) == ["polarizer", "splitter", "splitter"]
    assert [*widths(ax)] == ["source -> polarizer", "polarizer -> detector"]
    assert faults_of(ax.figure) == []


# Files.


@pytest.mark.parametrize(
    ("form", "begins", "holds"),
    [
        ("png", b"\x89PNG", b""),
        ("svg", b"<?xml", b">angle of polarisation (\xc2\xb0)</text>"),
        slow(("pdf", b"%PDF", b"/FontFile2")),  # TrueType, no outlines
    ],
)
def test_a_picture_is_saved_in_every_form_with_texts_as_such(form, begins, holds, tmp_path):
    file = tmp_path / f"map.{form}"
    op.plots.save(op.plots.hemisphere(measured("glass on glass"), "AoP"), file, 60)
    content = file.read_bytes()
    assert content.startswith(begins)
    assert holds in content
    figure = Figure()
    figure.text(0.5, 0.5, "\u5149")  # A letter that the font lacks.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        op.plots.save(figure, tmp_path / f"x.{form}")
    if form == "svg":  # A picture that is drawn anew has the same bits.
        files = [tmp_path / "a.svg", tmp_path / "b.svg"]
        for each in files:
            op.plots.save(op.plots.in_plane(measured("silver"), "S1"), each)
        assert files[0].read_bytes() == files[1].read_bytes()


@rows(
    "drawn, name, told",
    [
        *((Figure(), f"map{end}", "one of: .png, .svg, .pdf") for end in (".jpg", "", ".svg.gz")),
        (Figure(), "none/x.png", r"none/x.png' cannot be written: No such file"),
        (Figure(), "a.png/b.png", r"a.png/b.png' cannot be written: "),
        (Figure(), "folder.png", r"folder.png' cannot be written: "),
        *((drawn, "map.png", "give what a function of plots returned") for drawn in (None, [])),
    ],
)
def test_what_cannot_be_saved_is_told_by_the_name_that_was_given(drawn, name, told, tmp_path):
    (tmp_path / "a.png").write_bytes(b"")
    (tmp_path / "folder.png").mkdir(exist_ok=True)
    with pytest.raises(op.OptipathError, match=told) as error:
        op.plots.save(drawn, tmp_path / name)
    assert type(error.value) is op.OptipathError, "no fault of a surface"
    assert "draft" not in str(error.value)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a.png", "folder.png"]
    for nameless in (3, b"map.png", ""):
        with pytest.raises(op.OptipathError, match="name of a file"):
            op.plots.save(Figure(), nameless)


def test_pictures_need_no_window_and_a_name_and_matplotlib(monkeypatch):
    names = "; ".join(f"op.plots.{name}" for name in op.plots.__all__)
    code = f"import sys, optipath as op; {names}; print('matplotlib.pyplot' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
    with pytest.raises(AttributeError, match="'hemispher'; did you mean 'hemisphere'"):
        _ = op.plots.hemispher
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(op.OptipathError, match=r'pip install "optipath\[plot\]"'):
        op.plots.__getattr__("save")


# Charts.

DOCS = Path(__file__).parents[2] / "docs"


@functools.cache
def panel_of(name):
    return op.plots.chart(DOCS / name)


def words_of(panel):
    texts = texts_of(panel[0].figure)
    return " ".join(text.get_text() for text in texts).replace("\n", " ")


def recorded(name="chart.json"):
    return read_chart((DOCS / name).read_text("utf-8"), name)


def assert_clear(panel):
    """That a chart is readable; its words."""
    figure = panel[0].figure
    texts = texts_of(figure)
    assert faults_of(figure, texts) == []
    assert texts_over_marks(figure, texts) == []
    return " ".join(text.get_text() for text in texts).replace("\n", " ")


@pytest.mark.slow  # Of those that were measured it is told each time.
@settings(max_examples=6, deadline=None, phases=[Phase.reuse, Phase.generate])
@given(charts())
def test_no_text_of_any_chart_is_over_another_or_over_a_mark_or_cut(chart):
    assert_clear(op.plots.chart(chart))


def marked(ax):
    return [line for line in ax.get_lines() if line.get_marker() in "osD"]


@pytest.mark.parametrize("name", ["chart-interface.json", slow("chart.json")])
def test_every_contender_has_a_mark_in_each_panel_clear_of_texts(name):
    panel = panel_of(name)
    assert_clear(panel)
    count = len(recorded(name)["contenders"])
    assert [len(marked(ax)) for ax in panel] == [count] * len(panel)


def test_methods_precisions_engines_limits_and_what_fails_are_told_in_readable_texts():
    panel = panel_of("chart.json")
    texts = texts_of(panel[0].figure)
    assert min(text.get_fontsize() for text in texts) >= 14
    looks = {}
    for line in marked(panel[0]):
        looks.setdefault(line.get_color(), set()).add(line.get_marker())
    assert [*looks.values()] == [{"o", "s", "D"}] * 4
    words = [text.get_text() for text in texts]
    assert {"frontier: best that fails nowhere", "memory: 2.37 ns"} <= {*words}
    told = words_of(panel)
    words = words_of(panel_of("chart-interface.json"))
    assert "all but: near the critical angle;" in words
    assert "n near 1, grazing" in words
    # The unit of what fails is explained, and neither is told where nothing fails.
    assert "fails (over 1000 ulp*) in so many regions" in told
    assert "units in the last place, divided by 1 + the condition number" in told
    chart = recorded()
    chart["fails_above"] = 1e29
    for entry in chart["contenders"]:
        for kind in KINDS:
            for error in entry["errors"][kind].values():
                error.update(worst=9.0, median=1.0)
    words = assert_clear(op.plots.chart(chart))
    assert not any(each in words for each in ("ulp", "fails (", "last place"))


def near(**more):
    stable, textbook = [1.0, 1.0, 2.0], [1.0, 1e6, float("inf")]
    errors = {"stable": dict.fromkeys(KINDS, stable), "textbook": dict.fromkeys(KINDS, textbook)}
    places = [
        {"name": name, "called": name, "distances": [1e-1, 1e-3, 1e-5], "errors": errors}
        for name in ("brewster", "normal", "grazing")
    ]
    told = {"format": 1, "drawn": "errors next to critical places", "title": "glass"}
    numbers = {"dtype": "float64", "eps": 2.0**-52, "fails_above": 1000.0, "samples": 4}
    return {**told, **numbers, "places": places, **more}


def test_errors_near_critical_places_are_a_panel_a_place_and_what_was_left_out_is_said():
    panel = op.plots.chart(near())
    for ax, name in zip(panel, ("brewster", "normal", "grazing"), strict=True):
        assert ax.get_xlabel() == f"distance from {name} (rad)"
        curves = [line for line in ax.get_lines() if len(line.get_xdata()) == 3]
        assert len(curves) == 4
        # A lost number is drawn where no digit is right, and none of them is beyond.
        assert max(max(line.get_ydata()) for line in curves) == 1.0
    assert_clear(panel)
    one = near(title="long title " * 20, regions={"measured": 3, "of": 9})
    words = assert_clear(op.plots.chart(one | {"places": one["places"][:1]}))
    assert "interrupted: 3 of 9 distances" in words
    # What was left out is said, and what is no chart refused.
    effort = {"samples": 3, "rounds": 3, "left_out": "of Numba only stable"}
    chart = {**recorded(), "effort": effort, "regions": {"measured": 5, "of": 21}}
    words = words_of(op.plots.chart(chart))
    for told in ("3 samples a region", effort["left_out"], "interrupted: 5 of 21 regions"):
        assert told in words
    for draw, told in (
        (lambda: op.plots.chart({"format": 1}), "what is given is no chart"),
        (lambda: op.plots.chart("nowhere.json"), r"'nowhere\.json' cannot be read"),
        (lambda: op.plots.chart(near(), peers="race.json"), "peers stand beside"),
    ):
        with pytest.raises(op.OptipathError, match=told):
            draw()
