"""One path of plain floats: its first runs, step after step, and the later ones, compiled."""

import numpy as np
import pytest

import optipath as op
from optipath.lab.composition import LIGHT, mixed_path, walked
from optipath.plan.interpreter import Interpreter
from paths import chain
from random_paths import Draw
from tables import rows
from wired import wired

EXTREME = (5e-324, 1e-310, 1e-150, 1e-20, 1.0, 1e20, 1e150)
STATE = np.array([1.0, 0.6, 0.0, 0.8])
# A mirror turns y over.
OVER = STATE * [1.0, 1.0, -1.0, -1.0]


def assert_later_runs_are_the_first(path, **values):
    """The light at every end, run by run, or the words in which a run is refused."""
    plan, found = op.Composer().compose(path), []
    for _ in range(5):
        try:
            found.append(dict(plan.run_all(**values)))
        except op.OptipathError as fault:
            found.append(str(fault))
    first, *others = found
    for other in others:
        assert type(other) is type(first), (first, other)
        if isinstance(first, str):
            assert other == first
            continue
        for end, light in first.items():
            size = max(abs(light.stokes[0]), 5e-324)
            found, expected = other[end].stokes / size, light.stokes / size
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13)


@rows("name", op.preset_names())
def test_the_later_runs_of_every_preset_are_the_first(name):
    assert_later_runs_are_the_first(op.load_preset(name))


@rows("seed", range(20))
def test_the_later_runs_of_random_paths_with_several_detectors_are_the_first(seed):
    draw = Draw(seed, arrays=False)
    assert_later_runs_are_the_first(draw.path(loops=seed % 3 == 0), **draw.values)


def test_one_value_of_a_path_of_a_thousand_elements_is_not_run_step_by_step(monkeypatch):
    monkeypatch.setattr(Interpreter, "lights", None)
    path, graph = mixed_path(1000)
    values = {"incidence": 0.55, "axis": 0.05, "turn": -0.05}
    light = path.compose().run(**values).stokes
    np.testing.assert_allclose(light, walked(graph, values, LIGHT)[:, 0], rtol=1e-12, atol=1e-15)


VALUE = op.Parameter("v")
ELEMENTS = {
    "reflection": op.Interface(VALUE, 0.7),
    "metal": op.Interface(op.Material(1.2, VALUE), 0.7),
    "outside": op.Interface(1.5, 0.7, outside=VALUE),
    "layer": op.LayerStack([1.0, VALUE, 1.5], 0.7),
    "medium": op.Medium(VALUE, 1e-3, rotation=2.0),
    "absorption": op.Medium(1e-3, VALUE, retardance=2.0, angle=0.3),
    "rotation": op.Medium(1e-3, 1.0, rotation=VALUE),
    "retardance": op.Retarder(VALUE, 0.4),
    "transmittance": op.Attenuator(VALUE),
    "leakage": op.Polarizer(0.4, leakage=VALUE),
    "amplitude": op.Mirror(VALUE, 0.5),
    "depolarization": op.Depolarizer(VALUE),
}
LIT = (1.0, 0.5, 0.3, 0.4)
PATHS = {name: chain([element], LIT) for name, element in ELEMENTS.items()}
PATHS["intensity"] = op.Source(VALUE, LIT) >> op.Interface(0.2 + 3j, 0.7) >> op.Detector()


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
@rows("of", PATHS)
@rows("value", EXTREME)
def test_the_later_runs_of_extreme_values_are_the_first(of, value):
    assert_later_runs_are_the_first(PATHS[of], v=value)


def test_an_angle_that_looks_like_degrees_is_warned_of_by_later_runs_too():
    plan = chain([op.Retarder(VALUE, 0.3)], LIT).compose()
    for value in (0.1, 0.2, 0.3, 0.4, 0.5):
        plan.run(v=value)
    with pytest.warns(op.errors.AngleWarning, match="parameter 'v' is a plain number"):
        plan.run(v=45.0)


def splitters(count):
    """Beam splitters one behind another, a dimmed detector at each and one behind them all."""
    nodes, links, leaves = {"lamp": op.Source(stokes=STATE), "end": op.Detector()}, "", "lamp"
    for i in range(count):
        nodes[f"split{i}"] = op.BeamSplitter(op.Parameter(f"r{i}"))
        nodes[f"dim{i}"] = op.Attenuator(op.Parameter("t", 0.5))
        nodes[f"side{i}"] = op.Detector()
        links += f"{leaves} -> split{i}.in, split{i}.reflected -> dim{i}, dim{i} -> side{i}, "
        leaves = f"split{i}.transmitted"
    return wired(nodes, f"{links}{leaves} -> end")


@rows(
    "shapes",
    [[()], [(), ()], [()] * 4, [(1,), ()], [(10,)] * 2, [(3, 1), (4,)], [(40, 1), (1, 30)]],
)
def test_every_run_brings_each_of_several_detectors_its_own_light(rng, shapes):
    path = splitters(len(shapes))
    for _ in range(8):
        shares = [
            rng.uniform(0.1, 0.9, shape) if shape else rng.uniform(0.1, 0.9) for shape in shapes
        ]
        lights = path.trace_all(t=0.25, **{f"r{i}": share for i, share in enumerate(shares)})
        left, expected = 1.0, {}
        for i, share in enumerate(np.broadcast_arrays(*shares)):
            expected[f"side{i}"] = np.multiply.outer(0.25 * share * left, OVER)
            left = left * (1.0 - share)
        for end, stokes in (expected | {"end": np.multiply.outer(left, STATE)}).items():
            assert lights[end].stokes.shape == stokes.shape
            np.testing.assert_allclose(
                lights[end].stokes, stokes, rtol=2e-15 if any(shapes) else 1e-15
            )


@rows("size", [(), (5,), (3000,)])
@rows("composing", ["stokes", "jones"])
def test_faint_light_at_one_of_several_detectors_leaves_the_others_as_they_are(composing, size):
    plan = op.Composer(composing=composing).compose(splitters(2))
    for run in range(1, 9):
        second = np.full(size, 10.0**-run) if size else 10.0**-run
        lights = plan.run_all(r0=1e-200, r1=second, t=1e-100)
        found = [lights[end].log10_intensity for end in ("side0", "side1")]
        for power, expected in zip(found, (-300.0, -100.0 - run), strict=True):
            np.testing.assert_allclose(power, np.full(size, expected), rtol=1e-14)
        np.testing.assert_allclose(lights["end"].intensity, 1.0 - 10.0**-run, rtol=1e-15)


def test_of_a_few_each_may_be_faint_named_by_words_and_out_of_range():
    path, preset = splitters(1), op.load_preset("npgr026")
    for _ in range(6):
        path.trace_all(r0=np.array([0.1, 0.2, 0.3]))
        with pytest.raises(op.errors.ParameterError, match=r"'r0' .* is 1\.5 at 1; give"):
            path.trace_all(r0=np.array([0.1, 1.5, 0.3]))
        light = splitters(1).trace_all(r0=np.array([0.5, 1e-200, 0.25]), t=1e-100)["side0"]
        expected = np.log10([0.5, 1.0, 0.25]) - [100.0, 300.0, 100.0]
        np.testing.assert_allclose(light.log10_intensity, expected, rtol=1e-14)
        for word in ("none", "horizontal", "diagonal"):
            one = preset.trace(filter=word, delta=0.4).stokes
            few = preset.trace(filter=word, delta=np.full(3, 0.4)).stokes
            np.testing.assert_allclose(few, [one] * 3, rtol=0, atol=1e-13)


def test_an_index_on_both_sides_does_without_steps_though_it_absorbs_nothing():
    # Indices in front of a boundary are never 0, which says nothing of what they absorb.
    plan = op.load_preset("glass-slab").compose()
    for _ in range(5):
        plan.run_all(theta=0.5)
    assert plan.answers.ran_by == ("floats",)


OPEN = {"index": 1.7, "incidence": 0.5, "outside": 1.25, "incidence_in": 1.125}


def boundary(**values):
    """A plan of light that a boundary reflects."""
    return op.Composer().compose(chain([op.Interface(**OPEN | values)], [1.0, 0.6, 0.2, 0.3]))


@rows("name", ["index", "outside", "incidence_in"])
def test_an_open_index_costs_what_a_known_one_does_where_it_is_real(name):
    plan = boundary(**{name: op.Parameter("m", OPEN[name])})
    lights = [plan.run(**given) for given in [{}, {"m": OPEN[name]}] * 4]
    assert {tuple(light.stokes) for light in lights} == {tuple(boundary().run().stokes)}
    single = plan.answers.light.single
    assert single.fast_path({"m": OPEN[name]}, 0) is not None
    assert all("imag" not in name for name in next(iter(single.functions.values())).names)


@rows("count", [(), 3])
@rows("name", ["index", "outside", "incidence_in"])
def test_a_complex_index_between_real_ones_is_taken_as_it_is(name, count):
    plan = boundary(**{name: op.Parameter("m", OPEN[name])})
    for _ in range(6):
        for value in (OPEN[name], OPEN[name] + 0.01j, OPEN[name] + 0j):
            found = plan.run(m=np.full(count, value) if count else value).stokes
            known = boundary(**{name: value}).run().stokes
            np.testing.assert_allclose(found, np.broadcast_to(known, found.shape), rtol=1e-14)
