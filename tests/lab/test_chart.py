"""Charts: what is measured, what is drawn, and each without the other."""

import json
from itertools import pairwise

import numpy as np
import pytest

import optipath as op
from charts import texts_over_marks
from optipath.cli.chart_command import NEAR
from optipath.kernels.catalog import REFLECTION
from optipath.lab import chart as chart_module
from optipath.lab import chart as module
from optipath.lab.chart import (
    FULL,
    QUICK,
    Effort,
    critical_chart,
    expected,
    interface_chart,
    kernel_operations,
    many_paths,
    path_chart,
)
from optipath.lab.chart_file import KINDS, chart_text, contenders, peer_times, read_chart
from optipath.lab.errors import AS_PASSED, Errors, interface_errors, path_errors, trial
from optipath.lab.regions import PLACES, REGIONS, in_region
from paths import chain
from pictures import faults_of, texts_of
from tables import rows, slow

LITTLE = Effort(samples=1, rounds=1, engines=("numpy",))
MORE = Effort(samples=2, rounds=1, engines=("numpy",))
FEW = {"generic", "near the normal", "grazing", "near Brewster's angle", "metals"}
FEW |= {"k = 0, total reflection", "n near 1, k like n - 1"}
STATE = (1.0, 0.3, 0.2, 0.1)


@pytest.fixture(scope="module", params=[LITTLE, pytest.param(MORE, marks=pytest.mark.slow)])
def effort(request):
    """How much is measured: in a few regions, or more in all of them."""
    few = tuple(region for region in REGIONS if region.name in FEW)
    with pytest.MonkeyPatch.context() as patch:
        if request.param is LITTLE:
            patch.setattr(chart_module, "REGIONS", few)
        yield request.param


@pytest.fixture(scope="module")
def chart(effort):
    steps, kept = [], []
    path = op.load_preset("npgr026", case="8")

    def keep(so_far):
        kept.append(json.loads(chart_text(so_far)))

    return path_chart(path, "npgr026", effort, lambda *step: steps.append(step), keep), steps, kept


def worst(contender, kind="componentwise"):
    return max(error["worst"] for error in contender["errors"][kind].values())


def by_words(chart, *words):
    keys = "method", "dtype", "composing"
    return next(c for c in chart["contenders"] if tuple(c[key] for key in keys) == words)


def test_every_way_is_there_slower_than_the_machine_allows_and_stable_holds(chart):
    found = chart[0]["contenders"]
    assert len(found) == len(contenders(engines=("numpy",)))
    regions = {AS_PASSED, *(region.name for region in chart_module.REGIONS)}
    for contender in found:
        assert set(contender["errors"]["componentwise"]) == regions
        assert contender["ns"]["median"] >= contender["ns"]["least"] > 0
    limits, quickest = chart[0]["limits_ns"], min(c["ns"]["least"] for c in found)
    assert set(limits) == {"sqrt and division", "memory"}
    assert all(0 < ns < quickest for ns in limits.values())
    assert worst(by_words(chart[0], "stable", "float64", "stokes")) <= 100
    assert not worst(by_words(chart[0], "textbook", "float64", "stokes")) <= 1e6
    assert worst(by_words(chart[0], "stable", "float64", "jones"), "normwise") <= 100
    assert worst(by_words(chart[0], "stable", "longdouble", "stokes"), "normwise") <= 30


def test_progress_is_told_and_what_is_measured_so_far_is_a_whole_chart_after_every_region(chart):
    found, steps, kept = chart
    shares = [share for _, share in steps]
    assert shares == sorted(shares)
    told = {what.partition(",")[0] for what, _ in steps}
    assert told == {"composing and compiling", "times", "errors"}
    assert 0 <= shares[0] < 0.1
    assert 0.9 < shares[-1] <= 1
    assert len(kept) == 1 + len(chart_module.REGIONS)
    for number, so_far in enumerate(kept, start=1):
        assert so_far["regions"] == {"measured": number, "of": len(kept)}
        (errors, *_) = read_chart(json.dumps(so_far), "x.json")["contenders"]
        assert len(errors["errors"]["normwise"]) == number
    assert json.loads(chart_text(found)) == kept[-1]


def test_interfaces_have_all_methods_and_their_incidence_and_a_quick_chart_says_what_it_lacks():
    found = interface_chart(LITTLE)
    assert {c["method"] for c in found["contenders"]} == set(REFLECTION.methods)
    assert worst(by_words(found, "compensated", "float64", "stokes")) <= 1.5
    assert len(op.plots.chart(found)) == 2
    assert QUICK.samples < FULL.samples
    assert FULL.told()["left_out"] == ""
    assert "Numba" in QUICK.told()["left_out"]
    measured = [runner for runner in contenders() if QUICK.measures(runner)]
    assert {runner.engine for runner in measured} == {runner.engine for runner in contenders()}
    assert sum(runner.engine == "numba" for runner in measured) <= 1
    assert "--quick" in expected(FULL)
    assert Errors._fields == KINDS, "in files, too"
    # Interfaces in world frames keep their incidence.
    meets = op.plane_of_incidence((1, 0, -1), (0, 0, 1))
    frames = {"in": meets.arriving, "reflected": meets.reflected}
    path = op.PathGraph()
    path.add("lamp", op.Source(), frames={"out": meets.arriving})
    path.add("glass", op.Interface(1.5, float(meets.incidence)), frames=frames)
    path["lamp"] >> path["glass"] >> path.add("eye", op.Detector())
    graph = in_region(path, REGIONS[0], 4, "float64")
    assert graph.nodes["glass"]["element"].incidence == float(meets.incidence)
    assert op.Composer().compose(graph).run().stokes.shape == (4, 4)
    # A path is made many for timing, and roots of its kernels are counted.
    graph, values = many_paths(op.load_preset("npgr026"), 6)
    assert op.Composer().compose(graph).run(**values).stokes.shape == (6, 4)
    lossless = REFLECTION.by_method("stable").without[1]
    assert kernel_operations(lossless, 4)["sqrt"] == 1
    assert kernel_operations(REFLECTION.by_method("stable"), 5)["sqrt"] == 2


@pytest.mark.filterwarnings("ignore:Glyph")
def test_json_can_be_drawn_again_without_measuring_and_of_a_later_version_too(chart, tmp_path):
    text = chart_text(chart[0])
    again = read_chart(text, "chart.json")
    assert again["title"] == "npgr026"
    later = json.loads(text)
    later["contenders"][0].update(engine="quantum", dtype="float128")
    later["title"] = r"光路 $\frac{$"
    later = read_chart(json.dumps(later), "x.json")
    for name, found in (("a.svg", chart[0]), ("b.svg", again), ("later.svg", later)):
        op.plots.save(op.plots.chart(found), tmp_path / name)
    a, b = ((tmp_path / name).read_text("utf-8") for name in ("a.svg", "b.svg"))
    assert len(a) > 10_000
    assert a.count("<path") == b.count("<path")


# npgr026 is charted above, and those that are like it, or take long, are left out.
SLOW = ["npgr026-3d", "coated-metal", "glass-slab", "senarmont", "sky-and-window"]


@pytest.mark.parametrize("name", ["malus", *map(slow, SLOW)])
def test_presets_can_be_charted(name, effort):
    found = path_chart(op.load_preset(name), name, effort)
    # By Jones columns, where there are any: Stokes vectors lose a light that is nearly
    # extinguished, as here.
    ways = {contender["composing"] for contender in found["contenders"]}
    composing = "jones" if "jones" in ways else "stokes"
    assert worst(by_words(found, "stable", "float64", composing), "normwise") <= 100


def test_what_is_not_read_has_no_error_and_what_cannot_be_measured_is_lost_left_out_or_refused():
    path = chain([op.Interface(1.5, 0.9)], STATE, reads="intensity")
    as_given = trial(path, None, "float64", 1)
    assert max(kind.max() for kind in path_errors(op.Composer(), as_given, "float64")) <= 10
    for size in (1e-60, 1e60):
        path = op.Source(size) >> op.Detector()
        as_given = trial(path, None, "float64", 1)
        single = path_errors(op.Composer(dtype="float32"), as_given, "float32")
        assert np.isinf(single.normwise).all()
        assert path_errors(op.Composer(), as_given, "float64").normwise.max() == 0.0
    dtypes = {c["dtype"] for c in path_chart(path, "bright", LITTLE)["contenders"]}
    assert "float64" in dtypes
    assert "float32" not in dtypes
    found = path_chart(chain([op.MuellerElement(np.eye(4))]), "foil", LITTLE)
    assert {c["composing"] for c in found["contenders"]} == {"stokes"}
    found = path_chart(chain([op.Attenuator(0.5)], STATE), "grey", LITTLE)
    assert {c["method"] for c in found["contenders"]} == {"stable"}
    assert "memory" in found["limits_ns"]
    with pytest.raises(op.errors.ParameterError, match=r"batch of shape \(3,\)"):
        path_chart(chain([op.Attenuator([0.1, 0.2, 0.3])], STATE), "three", LITTLE)


ERRORS = {kind: {"generic": {"worst": 1.0, "median": 0.5}} for kind in KINDS}
WAY = {"method": "stable", "dtype": "float64", "engine": "numba", "composing": "stokes"}
ENTRY = {**WAY, "eps": 2.2e-16, "ns": {"least": 30.0, "median": 33.0}, "errors": ERRORS}
VERSIONS = {"python": "3.11.7", "optipath": "0.1.0", "numpy": "2.4.6"}
VALUES = {"filter": "horizontal", "n1": "1.12", "k1": "2.16", "delta": "48 deg"}
TOLD = {"title": "npgr026, case 8", "parameters": VALUES, "versions": VERSIONS}
LIMITS = {"limits_ns": {"memory": 2.0}, "fails_above": 1000.0}
OLD_CHART = {"format": 1, "machine": {"model": "EPYC"}, "contenders": [ENTRY], **TOLD, **LIMITS}
NAMES = ["tmm", "mitsuba, llvm", "katsu", "numpy by hand", "jax by hand", "pypolar", "py_pol"]
NO_CHARTS = ["", "[]", '{"format": 99}', '{"format": 1}']


@rows(
    "spoil",
    [
        lambda chart: chart.update(format=99),
        lambda chart: chart.update(contenders=[]),
    ],
)
def test_a_chart_that_lacks_something_is_refused(chart, spoil):
    found = json.loads(chart_text(chart[0]))
    spoil(found)
    with pytest.raises(op.OptipathError, match="no chart of this version"):
        read_chart(json.dumps(found), "x.json")


@rows(
    "read, text, told",
    [
        *((read_chart, text, "optipath chart --data") for text in NO_CHARTS),
        *((peer_times, text, r"race\.py --json") for text in ("", "[]", "{}", '{"contests": 3}')),
    ],
)
def test_what_is_no_chart_or_no_race_is_refused(read, text, told):
    with pytest.raises(op.OptipathError, match=told):
        read(text, "x.json", *([OLD_CHART] if read is peer_times else []))


@rows("distance", [1e-1, 1e-6])
@rows("name", PLACES)
def test_samples_stand_at_the_distance_from_their_angle(name, distance):
    samples = PLACES[name].region(distance).samples(8)
    # cos of the refracted angle is 0 there, the reflection of p, or the angle itself.
    angle = {
        "brewster": np.arctan(samples.n),
        "critical": np.arcsin(np.minimum(samples.n, 1.0)),
        "grazing": np.pi / 2,
        "normal": 0.0,
    }[name]
    assert np.abs(samples.incidence - angle) == pytest.approx(np.full(8, distance), rel=1e-6)
    assert tuple(PLACES) == NEAR, "of the command line"
    nearer = PLACES[name].region(1e-9).samples(8)
    assert name != "grazing" or nearer.n.tolist() == samples.n.tolist()


def test_amplitudes_lose_a_digit_a_decade_near_the_normal_and_stable_none():
    places = [PLACES["normal"].region(distance) for distance in (1e-2, 1e-4, 1e-6)]
    errors = [interface_errors("amplitude", place, count=8).componentwise[:, 1] for place in places]
    # B follows the square of the angle, and the amplitudes keep their absolute error.
    for near, nearer in pairwise(float(off.max()) for off in errors):
        assert 1e2 < nearer / near < 1e6
    assert interface_errors("stable", places[-1], count=8).componentwise.max() <= 20


def test_a_path_and_an_interface_have_all_methods_at_all_distances(monkeypatch):
    monkeypatch.setattr(module, "DISTANCES", (1e-8, 1e-2))
    path = op.load_preset("npgr026", case="8")
    for measured in (path, None):
        kept = []
        found = critical_chart(measured, "x", ["normal", "grazing"], 2, keep=kept.append)
        assert [place["name"] for place in found["places"]] == ["normal", "grazing"]
        for place in found["places"]:
            assert place["distances"] == [1e-2, 1e-8]
            assert set(place["errors"]) == {"stable", "compensated", "amplitude", "textbook"}
            assert max(place["errors"]["stable"]["componentwise"]) <= 100
        assert kept[-1]["regions"] == {"measured": 4, "of": 4}
        text = chart_text(found)
        assert json.loads(chart_text(read_chart(text, "x"))) == json.loads(text)
    kept = []
    critical_chart(None, "x", ["critical"], 1, keep=lambda found: kept.append(chart_text(found)))
    first = read_chart(kept[0], "x.json")  # What is measured so far.
    assert first["places"][0]["distances"] == [1e-2]
    assert first["regions"] == {"measured": 1, "of": 2}
    with pytest.raises(op.OptipathError, match="place 'nirmal' is unknown; did you mean 'normal'"):
        critical_chart(None, "x", ["nirmal"])
    with pytest.raises(op.OptipathError, match="'malus' has no interface"):
        critical_chart(op.load_preset("malus"), "malus", ["normal"])


def race(**changes):
    times = [("optipath, numba", 20.0, 1e-16), ("slow", 1e6, float("nan"))]
    times[1:1] = [(name, 100.0 * 1.3**place, 1e-15) for place, name in enumerate(NAMES)]
    results = [
        {"contender": name, "how": "", "paths": 10, "least": ns, "median": ns, "error": error}
        for name, ns, error in times
    ]
    path = {"filter": "horizontal", "n1": 1.12, "k1": 2.16}
    contests = {"absorbing": {"path": path, "results": results, "left out": {}}}
    software = {**VERSIONS, "tmm": "0.2"}
    found = {"path": {"preset": "npgr026"}, "processor": "EPYC", "software": software}
    return json.dumps({**found, "contests": contests, **changes})


def test_times_are_multiplied_so_that_optipath_is_as_fast_in_both():
    found = peer_times(race(), "race.json", OLD_CHART)
    assert found.shared == "optipath, numba"
    assert found.ratio == pytest.approx(1.5)
    times = {racer.name: racer.ns for racer in found.racers}
    assert (times["optipath, numba"], times["tmm"]) == pytest.approx((30.0, 150.0))
    racer = found.racers[-1]
    assert (racer.error, racer.is_own) == (1.0, False), "without any right digit"


@rows(
    "changes, others, message",
    [
        ({"processor": "Xeon"}, {}, "the processor of 'race.json' is 'Xeon', and that of"),
        ({"software": {"python": "3.12.0"}}, {}, "python of 'race.json' is '3.12.0'"),
        ({"path": {"preset": "malus"}}, {}, "the preset of 'race.json' is 'malus'"),
        ({}, {"machine": {"system": "Linux"}}, "that of the chart None"),
        ({}, {"parameters": {"filter": "none"}}, "no race of the values of the chart"),
        ({}, {"contenders": [{**ENTRY, "dtype": "float32"}]}, "share no contender"),
    ],
)
def test_a_race_of_something_else_than_the_chart_is_refused(changes, others, message):
    with pytest.raises(op.OptipathError, match=message):
        peer_times(race(**changes), "race.json", OLD_CHART | others)


def test_peers_stand_in_a_panel_of_their_own_with_their_names(tmp_path):
    file = tmp_path / "race.json"
    file.write_text(race(), "utf-8")
    panel = op.plots.chart(OLD_CHART, peers=file)
    figure = panel[0].figure
    texts = texts_of(figure)
    words = [text.get_text() for text in texts]
    assert set(NAMES) <= set(words)
    assert any("times x 1.5" in word for word in words)
    assert faults_of(figure) == []
    assert texts_over_marks(figure, texts) == []
    colours = {line.get_color() for line in panel[2].get_lines() if line.get_marker() == "o"}
    assert len(colours) == 2
    op.plots.save(panel, tmp_path / "x.png", 60)
