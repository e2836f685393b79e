"""The chart: what is measured, what is drawn, and that the one can be had without the other."""

import json

import numpy as np
import pytest

import optipath as op
from optipath.kernels.catalogue import REFLECTION
from optipath.lab.accuracy.chart import interface_chart, path_chart
from optipath.lab.accuracy.chart_effort import FULL, QUICK, Effort, expected
from optipath.lab.accuracy.chart_file import KINDS, chart_text, read_chart
from optipath.lab.accuracy.contenders import contenders
from optipath.lab.accuracy.error_measures import Errors
from optipath.lab.accuracy.many_paths import many_paths
from optipath.lab.accuracy.path_errors import AS_GIVEN, path_errors, trials
from optipath.lab.accuracy.region_path import in_region
from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.slow_operations import kernel_operations
from paths import chain

LITTLE = Effort(samples=2, rounds=1, engines=("numpy",))


@pytest.fixture(scope="module")
def chart():
    steps, kept = [], []
    path = op.load_preset("npgr026", case="8")
    found = path_chart(
        path,
        "npgr026",
        LITTLE,
        lambda *step: steps.append(step),
        lambda so_far: kept.append(json.loads(chart_text(so_far))),
    )
    return found, steps, kept


def worst(contender, kind="componentwise"):
    return max(error["worst"] for error in contender["errors"][kind].values())


def by_words(chart, *words):
    for contender in chart["contenders"]:
        if (contender["method"], contender["dtype"], contender["composing"]) == words:
            return contender
    raise AssertionError(words)


def test_every_way_to_compute_the_path_is_there(chart):
    found = chart[0]["contenders"]
    assert len(found) == len(contenders(engines=("numpy",)))
    regions = {AS_GIVEN, *(region.name for region in REGIONS)}
    for contender in found:
        assert set(contender["errors"]["componentwise"]) == regions
        assert contender["ns"]["median"] >= contender["ns"]["least"] > 0


def test_stable_holds_and_textbook_fails_on_the_path(chart):
    assert worst(by_words(chart[0], "stable", "float64", "stokes")) <= 100
    assert not worst(by_words(chart[0], "textbook", "float64", "stokes")) <= 1e6
    assert worst(by_words(chart[0], "stable", "float64", "jones"), "normwise") <= 100


def test_progress_is_told_from_the_beginning_to_the_end(chart):
    shares = [share for _, share in chart[1]]
    assert shares == sorted(shares)
    told = {what.partition(",")[0] for what, _ in chart[1]}
    assert told == {"composing and compiling", "times", "errors"}
    assert 0 <= shares[0] < 0.1
    assert 0.9 < shares[-1] <= 1


def test_what_is_measured_so_far_is_a_whole_chart_after_every_region(chart):
    found, _, kept = chart
    assert len(kept) == 1 + len(REGIONS)
    for number, so_far in enumerate(kept, start=1):
        assert so_far["regions"] == {"measured": number, "of": len(kept)}
        (errors, *_) = read_chart(json.dumps(so_far), "x.json")["contenders"]
        assert len(errors["errors"]["normwise"]) == number
    assert json.loads(chart_text(found)) == kept[-1]


def test_longdouble_has_its_digits_on_a_path(chart):
    assert worst(by_words(chart[0], "stable", "longdouble", "stokes"), "normwise") <= 30


def test_a_quick_chart_measures_less_and_says_what_it_leaves_out():
    assert QUICK.samples < FULL.samples
    assert FULL.told()["left_out"] == ""
    assert "Numba" in QUICK.told()["left_out"]
    measured = [runner for runner in contenders() if QUICK.measures(runner)]
    assert {runner.engine for runner in measured} == {runner.engine for runner in contenders()}
    assert sum(runner.engine == "numba" for runner in measured) <= 1
    assert "--quick" in expected(FULL)


def test_the_kinds_of_errors_in_files_are_those_that_are_measured():
    assert Errors._fields == KINDS


def test_the_limits_of_the_machine_are_below_what_was_measured(chart):
    limits = chart[0]["limits_ns"]
    assert set(limits) == {"sqrt and division", "memory"}
    assert all(
        0 < ns < min(c["ns"]["least"] for c in chart[0]["contenders"]) for ns in limits.values()
    )


def test_json_can_be_drawn_again_without_measuring(chart, tmp_path):
    text = chart_text(chart[0])
    assert json.loads(text)["title"] == "npgr026"
    again = read_chart(text, "chart.json")
    for name, found in (("a.svg", chart[0]), ("b.svg", again)):
        op.plots.save(op.plots.chart(found), tmp_path / name)
    a, b = ((tmp_path / name).read_text("utf-8") for name in ("a.svg", "b.svg"))
    assert len(a) > 10_000
    assert a.count("<path") == b.count("<path")


def test_the_chart_of_one_interface_has_all_methods():
    found = interface_chart(LITTLE)
    assert {c["method"] for c in found["contenders"]} == set(REFLECTION.methods)
    assert worst(by_words(found, "compensated", "float64", "stokes")) <= 1.5
    assert len(op.plots.chart(found)) == 2


# npgr026 is charted above, and those that are like it, or take long, are left out.
CHARTED = ["coated-metal", "glass-slab", "malus", "npgr026-3d", "senarmont", "sky-and-window"]


@pytest.mark.parametrize("name", CHARTED)
def test_presets_can_be_charted(name):
    found = path_chart(op.load_preset(name), name, LITTLE._replace(samples=1))
    # By Jones columns, where there are any: Stokes vectors lose a light that is nearly
    # extinguished, as here.
    ways = {contender["composing"] for contender in found["contenders"]}
    composing = "jones" if "jones" in ways else "stokes"
    assert worst(by_words(found, "stable", "float64", composing), "normwise") <= 100


def test_a_path_with_an_own_matrix_is_charted_without_jones():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source())
    lamp >> path.add("foil", op.MuellerElement(np.eye(4))) >> path.add("eye", op.Detector())
    found = path_chart(path, "foil", LITTLE)
    assert {c["composing"] for c in found["contenders"]} == {"stokes"}


@pytest.mark.parametrize("text", ["", "[]", '{"format": 99}', '{"format": 1}', "nonsense"])
def test_what_is_no_chart_is_refused(text):
    with pytest.raises(op.OptipathError, match="optipath chart --data"):
        read_chart(text, "x.json")


def test_interfaces_in_world_frames_keep_their_incidence():
    meets = op.plane_of_incidence((1, 0, -1), (0, 0, 1))
    frames = {"in": meets.arriving, "reflected": meets.reflected}
    path = op.PathGraph()
    path.add("lamp", op.Source(), frames={"out": meets.arriving})
    path.add("glass", op.Interface(1.5, float(meets.incidence)), frames=frames)
    path["lamp"] >> path["glass"] >> path.add("eye", op.Detector())
    graph = in_region(path, REGIONS[0], 4, "float64")
    assert graph.nodes["glass"]["element"].incidence == float(meets.incidence)
    assert op.Composer().compose(graph).run().stokes.shape == (4, 4)


def test_a_path_is_made_many_for_timing():
    graph, values = many_paths(op.load_preset("npgr026"), 6)
    light = op.Composer().compose(graph).run(**values)
    assert light.stokes.shape == (6, 4)


def test_roots_and_divisions_of_a_kernel_are_counted():
    lossless = REFLECTION.by_method("stable").without[1]
    assert kernel_operations(lossless, 4)["sqrt"] == 1
    assert kernel_operations(REFLECTION.by_method("stable"), 5)["sqrt"] == 2


STATE = (1.0, 0.3, 0.2, 0.1)


def test_components_that_are_not_read_have_no_error():
    path = chain([op.Interface(1.5, 0.9)], STATE, reads="intensity")
    (trial,) = trials(path, (), "float64", 1)
    off = path_errors(op.Composer(), trial, "float64")
    assert off.normwise.max() <= 10
    assert off.componentwise.max() <= 10


def test_light_that_a_precision_cannot_hold_is_lost():
    path = op.PathGraph()
    path.add("lamp", op.Source(1e-60)) >> path.add("eye", op.Detector())
    (trial,) = trials(path, (), "float64", 1)
    assert np.isinf(path_errors(op.Composer(dtype="float32"), trial, "float32").normwise).all()
    assert path_errors(op.Composer(), trial, "float64").normwise.max() == 0.0


def test_a_chart_is_of_one_path_and_not_of_a_batch():
    with pytest.raises(op.ParameterError, match=r"batch of shape \(3,\)"):
        path_chart(chain([op.Attenuator([0.1, 0.2, 0.3])], STATE), "three", LITTLE)


def test_equal_computations_are_measured_once_and_limits_of_nothing_are_left_out():
    found = path_chart(chain([op.Attenuator(0.5)], STATE), "grey", LITTLE)
    assert {c["method"] for c in found["contenders"]} == {"stable"}
    assert set(found["limits_ns"]) == {"memory"}


def test_a_contender_that_cannot_hold_the_light_is_left_out():
    path = op.PathGraph()
    path.add("lamp", op.Source(1e60)) >> path.add("eye", op.Detector())
    dtypes = {c["dtype"] for c in path_chart(path, "bright", LITTLE)["contenders"]}
    assert "float64" in dtypes
    assert "float32" not in dtypes


@pytest.mark.parametrize(
    "spoil",
    [
        lambda chart: chart.update(format=True),
        lambda chart: chart.update(contenders=[]),
        lambda chart: chart.update(title=None),
        lambda chart: chart["limits_ns"].update(memory=-1.0),
        lambda chart: chart["contenders"][0].pop("ns"),
        lambda chart: chart["contenders"][0]["ns"].update(least="fast"),
        lambda chart: chart["contenders"][0]["errors"].update(normwise={}),
        lambda chart: chart["contenders"][0].update(engine=3),
        lambda chart: chart["contenders"][0]["ns"].update(least=10**400),
        lambda chart: chart["contenders"][0]["ns"].update(least=1e300),
    ],
)
def test_a_chart_that_lacks_something_is_refused(chart, spoil):
    text = json.loads(chart_text(chart[0]))
    spoil(text)
    with pytest.raises(op.OptipathError, match="no whole chart"):
        read_chart(json.dumps(text), "x.json")


@pytest.mark.filterwarnings("ignore:Glyph")
def test_an_engine_of_a_later_version_and_letters_without_glyphs_are_drawn(chart, tmp_path):
    later = json.loads(chart_text(chart[0]))
    later["contenders"][0].update(engine="quantum", dtype="float128")
    later["title"] = r"光路 $\frac{$"
    panel = op.plots.chart(read_chart(json.dumps(later), "x.json"))
    op.plots.save(panel, tmp_path / "later.svg")
