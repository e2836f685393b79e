"""Pictures of where the power of the light of a path goes."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

import optipath as op
from optipath.errors import OptipathError
from optipath.plots import energy
from pictures import faults_of


def rows(ax):
    """What becomes of light in each row, by its name."""
    texts = [text.get_text() for text in ax.texts]
    return dict(zip(texts[::2], texts[1::2], strict=False))


def widths(ax):
    """How wide each ribbon is where it begins, by its link."""
    ribbons = [patch for patch in ax.patches if isinstance(patch, Polygon) and patch.get_gid()]
    return {each.get_gid(): abs(each.get_xy()[-2, 0] - each.get_xy()[0, 0]) for each in ribbons}


def test_ribbons_are_as_wide_as_the_intensity_and_rows_say_what_becomes_of_it():
    assert rows(energy(op.load_preset("malus"), angle="60 deg")) == {
        "lamp": "gives 1",
        "polarizer": "takes 0.5 (50 %)",
        "analyzer": "takes 0.375 (37.5 %)",
        "eye": "gets 0.125 (12.5 %)",
    }
    found = widths(energy(op.load_preset("malus"), angle="60 deg"))
    assert [*found.values()] == pytest.approx([1.0, 0.5, 0.125])
    found = widths(energy(op.load_preset("glass-slab"), theta=0.0))
    assert found["front -> down"] == pytest.approx(0.96 / (1.0 - 0.04**2))
    assert found["up -> front"] == pytest.approx(0.04 * 0.96 / (1.0 - 0.04**2))
    ax = energy(op.load_preset("glass-slab"))
    ax.figure.draw_without_rendering()
    ribbons = [patch.get_window_extent() for patch in ax.patches]
    left, right = min(box.x0 for box in ribbons), max(box.x1 for box in ribbons)
    names, told = ax.texts[:-1:2], ax.texts[1:-1:2]
    assert all(text.get_window_extent().x1 <= left for text in names)
    assert all(text.get_window_extent().x0 >= right for text in told if text.get_text())
    ax = energy(op.load_preset("absorbing-pile"))
    spikes = [each for each in ax.patches if isinstance(each, Polygon) and not each.get_gid()]
    ribbons = [each for each in ax.patches if isinstance(each, Polygon) and each.get_gid()]
    assert spikes
    for spike in spikes:
        (left, top), *_, (right, _) = spike.get_xy()[:5]
        tip = (left + right) / 2.0, spike.get_xy()[:, 1].min() + 0.01
        within = [(left + share * (right - left), top - 0.1) for share in (0.05, 0.5, 0.95)]
        for point in (*within, tip):
            assert not any(ribbon.get_path().contains_point(point) for ribbon in ribbons)


def test_loops_rounding_and_gains_are_told():
    ax = energy(op.load_preset("glass-slab"))
    assert ax.texts[-1].get_text().startswith("light goes round")
    assert rows(energy(op.load_preset("senarmont")))["eye"] == "gets 0 (0 %)"
    gain = op.MuellerElement(2.0 * np.eye(4), physical=False)
    ax = energy(op.Source() >> gain.named("laser") >> op.Detector())
    assert rows(ax)["laser"] == "adds 1 (100 %)"
    assert "'laser' gives more light than it gets" in ax.texts[-1].get_text()


def test_taps_are_dotted_and_only_read():
    found = rows(energy(op.load_preset("ellipsometer-pcsa"), n=1.5, k=0.0, theta=0.0))
    # The polariser lets half through, and glass of 1.5 reflects 4 % of that.
    assert found["S.transmitted"] == "leaves 0.48 (48 %)"
    assert found["state"] == "reads 0.02 (2 %)"
    path = op.Source() >> op.Polarizer("0 deg") >> op.Detector()
    path.add("splitter", op.BeamSplitter())
    path.add("probe", op.Detector())
    path.connect("polarizer.out", "splitter.in", tap=True)
    path.connect("splitter.transmitted", "probe.in")
    ax = energy(path)
    found = rows(ax)
    assert found["splitter"] == "reads 0.5 (50 %)"
    assert found["probe"] == found["splitter.reflected"] == "reads 0.25 (25 %)"
    dotted = [line.get_gid() for line in ax.lines if line.get_linestyle() == ":"]
    assert sorted(dotted) == ["polarizer", "splitter", "splitter"]
    assert [*widths(ax)] == ["source -> polarizer", "polarizer -> detector"]
    assert faults_of(ax.figure) == []


def test_dark_paths_and_several_sources_are_drawn():
    ax = energy(op.load_preset("malus"), intensity=0.0)
    assert rows(ax)["eye"] == "gets 0"
    assert faults_of(ax.figure) == []
    found = rows(energy(op.load_preset("sky-and-window")))
    assert (found["heaven"], found["lamp"]) == ("gives 10", "gives 2")


@pytest.mark.parametrize("name", ["pile-of-plates", "glass-slab", "faraday-isolator"])
@pytest.mark.parametrize("size", [None, (3.2, 2.4)])
def test_no_text_is_over_another_or_cut_at_either_size(name, size):
    ax = None if size is None else Figure(size, layout="constrained").add_subplot()
    ax = energy(op.load_preset(name), ax)
    assert faults_of(ax.figure) == []


def test_many_values_and_what_is_no_path_are_told():
    with pytest.raises(OptipathError, match=r"a batch of shape \(2,\), and a picture is of one"):
        energy(op.load_preset("malus"), angle=[0.1, 0.2])
    with pytest.raises(OptipathError, match="energy is that of a path"):
        energy(op.Polarizer())
    with pytest.raises(OptipathError, match="ax is 3"):
        energy(op.load_preset("malus"), 3)


@pytest.mark.parametrize("power", [1e-300, 1e300])
def test_faint_and_bright_light_is_drawn_as_any_other(power):
    plain = energy(op.load_preset("npgr026"))
    ax = energy(op.load_preset("npgr026"), intensity=power)
    assert widths(ax) == pytest.approx(widths(plain), rel=1e-9)
    assert max(widths(ax).values()) == pytest.approx(1.0)
    assert f"gives {power:.3g}" in rows(ax).values()
    assert faults_of(ax.figure) == []
