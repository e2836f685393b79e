"""One path of plain floats: its first runs, step after step, and the later ones, compiled."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from random_paths import Draw
from tables import rows

EXTREME = (5e-324, 1e-310, 1e-150, 1e-20, 1.0, 1e20, 1e150)


def runs(path, values, times=5):
    """Return the light at every end, run by run, or the words in which a run is refused."""
    plan, found = op.Composer().compose(path), []
    for _ in range(times):
        try:
            found.append(dict(plan.run_all(**values)))
        except op.OptipathError as fault:
            found.append(str(fault))
    return found


def assert_alike(found):
    first, *others = found
    for other in others:
        assert type(other) is type(first), (first, other)
        if isinstance(first, str):
            assert other == first
            continue
        for end, light in first.items():
            power = other[end].exponent - light.exponent
            mantissa = np.ldexp(other[end].mantissa, power)
            size = max(abs(light.mantissa[0]), 5e-324)
            np.testing.assert_allclose(mantissa / size, light.mantissa / size, rtol=0, atol=1e-13)


@rows("name", op.preset_names())
def test_the_later_runs_of_every_preset_are_the_first(name):
    assert_alike(runs(op.load_preset(name), {}))


@rows("seed", range(40))
def test_the_later_runs_of_random_paths_with_several_detectors_are_the_first(seed):
    draw = Draw(seed, arrays=False)
    path = draw.path(loops=seed % 3 == 0)
    assert_alike(runs(path, draw.values))


def splitters(count):
    """Beam splitters one behind another, a dimmed detector at each and one behind them all."""
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1.0, 0.6, 0.0, 0.8]))
    leaves = "lamp.out"
    for number in range(count):
        path.add(f"split{number}", op.BeamSplitter(op.Parameter(f"r{number}")))
        path.add(f"dim{number}", op.Attenuator(op.Parameter("t", 0.5)))
        path.add(f"side{number}", op.Detector())
        path.connect(leaves, f"split{number}.in")
        path.connect(f"split{number}.reflected", f"dim{number}.in")
        path.connect(f"dim{number}.out", f"side{number}.in")
        leaves = f"split{number}.transmitted"
    path.add("end", op.Detector())
    path.connect(leaves, "end.in")
    return path


@rows("count", [1, 2, 4])
def test_every_run_brings_each_of_several_detectors_its_own_light(count):
    path = splitters(count)
    for run in range(8):
        shares = [0.1 * (run + 1) / (number + 1) for number in range(count)]
        lights = path.trace_all(**{f"r{number}": share for number, share in enumerate(shares)})
        left = 1.0
        for number, share in enumerate(shares):
            # A mirror turns y over, and the attenuator lets half of the light through.
            expected = 0.5 * share * left * np.array([1.0, 0.6, 0.0, -0.8])
            np.testing.assert_allclose(lights[f"side{number}"].stokes, expected, rtol=1e-15)
            left *= 1.0 - share
        np.testing.assert_allclose(
            lights["end"].stokes, left * np.array([1.0, 0.6, 0.0, 0.8]), rtol=1e-15
        )


@rows("size", [(), (5,), (3000,)])
@rows("composing", ["stokes", "jones"])
def test_every_run_brings_each_of_several_detectors_its_own_exponent(composing, size):
    plan = op.Composer(composing=composing).compose(splitters(2))
    for run in range(1, 9):
        second = np.full(size, 10.0**-run) if size else 10.0**-run
        lights = plan.run_all(r0=1e-250, r1=second, t=1e-100)
        found = [lights[end].log10_intensity for end in ("side0", "side1")]
        for power, expected in zip(found, (-350.0, -100.0 - run), strict=True):
            np.testing.assert_allclose(power, np.full(size, expected), rtol=1e-14)
        np.testing.assert_allclose(lights["end"].intensity, 1.0 - 10.0**-run, rtol=1e-15)


@rows("shapes", [((1,), ()), ((10,), (10,)), ((3, 1), (4,)), ((40, 1), (1, 30))])
def test_batches_of_any_size_bring_each_detector_its_own_light(rng, shapes):
    path, state = splitters(2), np.array([1.0, 0.6, 0.0, 0.8])
    over = state * [1.0, 1.0, -1.0, -1.0]
    for _ in range(4):
        first, second = (rng.uniform(0.1, 0.9, shape) for shape in shapes)
        lights = path.trace_all(r0=first, r1=second, t=0.25)
        r0, r1 = (share[..., np.newaxis] for share in np.broadcast_arrays(first, second))
        for end, expected in (
            ("side0", 0.25 * r0 * over),
            ("side1", 0.25 * (1.0 - r0) * r1 * over),
            ("end", (1.0 - r0) * (1.0 - r1) * state),
        ):
            assert lights[end].stokes.shape == expected.shape
            np.testing.assert_allclose(lights[end].stokes, expected, rtol=2e-15)


def test_of_a_few_each_may_be_faint_named_by_words_and_out_of_range():
    path = splitters(1)
    for _ in range(6):
        path.trace_all(r0=np.array([0.1, 0.2, 0.3]))
        with pytest.raises(op.ParameterError, match=r"'r0' .* is 1\.5 at 1; give"):
            path.trace_all(r0=np.array([0.1, 1.5, 0.3]))
    for _ in range(6):
        light = splitters(1).trace_all(r0=np.array([0.5, 1e-250, 0.25]), t=1e-100)["side0"]
        expected = np.log10([0.5, 1.0, 0.25]) - [100.0, 350.0, 100.0]
        np.testing.assert_allclose(light.log10_intensity, expected, rtol=1e-14)
    path = op.load_preset("npgr026")
    for _ in range(6):
        for word in ("none", "horizontal", "diagonal"):
            one = path.trace(filter=word, delta=0.4).stokes
            few = path.trace(filter=word, delta=np.full(3, 0.4)).stokes
            np.testing.assert_allclose(few, [one] * 3, rtol=0, atol=1e-13)


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


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
@rows("element", ELEMENTS)
@rows("value", EXTREME)
def test_the_later_runs_of_extreme_values_are_the_first(element, value):
    state = (1.0, 0.5, 0.3, 0.4)
    assert_alike(runs(chain([ELEMENTS[element]], state), {"v": value}))


@rows("intensity", EXTREME)
def test_the_later_runs_of_any_intensity_are_the_first(intensity):
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(op.Parameter("v"), [1.0, 0.5, 0.3, 0.4]))
    lamp >> path.add("metal", op.Interface(0.2 + 3j, 0.7)) >> path.add("eye", op.Detector())
    assert_alike(runs(path, {"v": intensity}))


def test_several_detectors_are_given_their_own_light_by_every_run():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 0.6, 0.0, 0.3]))
    lamp >> path.add("pane", op.Interface(1.5, op.Parameter("theta")))
    for port in ("reflected", "transmitted"):
        path.add(port, op.Detector())
        path.connect(f"pane.{port}", f"{port}.in")
    plan = path.compose()
    runs_of_one = [plan.run_all(theta=0.4) for _ in range(6)]
    batch = plan.run_all(theta=np.linspace(0.4, 0.5, 3))
    for end in ("reflected", "transmitted"):
        for found in runs_of_one:
            stokes = found[end].stokes
            np.testing.assert_allclose(stokes, runs_of_one[0][end].stokes, rtol=1e-13)
            np.testing.assert_allclose(stokes, batch[end].stokes[0], rtol=1e-13)
    total = sum(light.intensity for light in runs_of_one[-1].values())
    np.testing.assert_allclose(total, 1.0, rtol=1e-13)


def test_an_index_on_both_sides_does_without_steps_though_it_absorbs_nothing():
    # Indices in front of a boundary are never 0, which says nothing of what they absorb.
    plan = op.load_preset("glass-slab").compose()
    for _ in range(5):
        plan.run_all(theta=0.5)
    assert plan.answers.ran_by == ("floats",)


def boundary(**values):
    """Return the path of light that a boundary reflects."""
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(stokes=[1.0, 0.6, 0.2, 0.3]))
    lamp >> path.add("pane", op.Interface(**values)) >> path.add("eye", op.Detector())
    return path


OPEN = {"index": 1.7, "incidence": 0.5, "outside": 1.25, "incidence_in": 1.125}


@rows("name", ["index", "outside", "incidence_in"])
def test_an_open_index_costs_what_a_known_one_does_where_it_is_real(name):
    known = op.Composer().compose(boundary(**OPEN))
    plan = op.Composer().compose(boundary(**OPEN | {name: op.Parameter("m", OPEN[name])}))
    lights = [plan.run(**given) for given in [{}, {"m": OPEN[name]}] * 4]
    assert {tuple(light.stokes) for light in lights} == {tuple(known.run().stokes)}
    single = plan.answers.light.single
    assert single.fast_path({"m": OPEN[name]}) is not None
    assert all("imag" not in name for name in next(iter(single.functions.values())).names)


@rows("count", [(), 3])
@rows("name", ["index", "outside", "incidence_in"])
def test_a_complex_index_between_real_ones_is_taken_as_it_is(name, count):
    plan = op.Composer().compose(boundary(**OPEN | {name: op.Parameter("m", OPEN[name])}))
    for _ in range(6):
        for value in (OPEN[name], OPEN[name] + 0.01j, OPEN[name] + 0j):
            found = plan.run(m=np.full(count, value) if count else value).stokes
            known = op.Composer().compose(boundary(**OPEN | {name: value})).run().stokes
            np.testing.assert_allclose(found, np.broadcast_to(known, found.shape), rtol=1e-14)
