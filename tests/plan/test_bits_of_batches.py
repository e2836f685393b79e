"""Whatever a path is made of, it comes to the same bits alone and in any batch."""

import numpy as np
import pytest

import optipath as op
from batch_paths import SEVERAL, BatchDraw, at, one_by_one
from batches_of_chains import random_batch
from chains import COMPILED, random_chains
from optipath.values.curve_value import curve_values
from spectral_paths import Ramps, SpectralDraw, run_by_run, wavelengths
from tables import rows, slow, slow_except
from wired import wired

SEEDS = range(4)
MORE = pytest.mark.parametrize("more", [0, *map(slow, range(4, 80, 4))])
METALS = 1.5, 1.12 + 2.16j, 0.608 + 2.12j
TURNS = np.array([0.0, -0.0, np.pi / 2, np.pi, -3.0, 1e12])
ANGLES = np.array([0.0, np.pi / 2, 0.982793723247329, 0.3, 1e-9, 1.2])


def drawn(seed, options=(), *, loops=False):
    """A random path, its values, and its light one by one; where there can be light."""
    path, values = BatchDraw(seed).batch(loops=loops)
    try:
        plan = op.Composer(**dict(options)).compose(path)
        # By the second time a function of floats has been made.
        alone, again = one_by_one(plan, values), one_by_one(plan, values)
    except op.OptipathError as error:
        pytest.skip(f"no such path: {error}")
    assert_same(again, alone)
    return path, values, alone


def assert_same(found, expected, where=...):
    for name, stokes in expected.items():
        np.testing.assert_array_equal(getattr(found[name], "stokes", found[name]), stokes[where])


def compare(path, values, alone=None, engine="auto", **options):
    """Compare a batch, a part, one path, and many with the paths one by one."""
    plan = op.Composer(engine=engine, **options).compose(path)
    count = len(next(iter(values.values())))
    if alone is None:
        alone = one_by_one(op.Composer(**options).compose(path), values, count)
    many = np.tile(np.arange(count), 300)
    for part in (slice(None), slice(2, 5), slice(1, 2), many, many):
        assert_same(plan.run_all(**{n: value[part] for n, value in values.items()}), alone, part)


@rows("dtype", ["float64", "float32"])
@rows("seed", SEEDS)
@MORE
def test_random_paths_are_the_same_alone_and_among_others(seed, dtype, more):
    found = drawn(seed + more, {"dtype": dtype})
    for engine in ("auto", "numpy"):
        compare(*found, engine, dtype=dtype)


@pytest.mark.slow  # Numba compiles for long.
@pytest.mark.skipif("numba" not in COMPILED, reason="not installed")
@pytest.mark.parametrize("seed", range(8))
def test_random_paths_are_the_same_by_numba(seed):
    compare(*drawn(seed), "numba")


@rows("seed", SEEDS)
@MORE
def test_loops_are_the_same_alone_and_among_others(seed, more):
    compare(*drawn(1000 + seed + more, loops=True))


METHODS = [{"method": method} for method in ("textbook", "amplitude", "compensated")]


@rows("options", [*METHODS, {"composing": "jones"}, {"tolerance": 0.1}])
@pytest.mark.parametrize("seed", slow_except([1], SEEDS[:3]))
def test_each_way_of_composing_is_the_same_alone_and_among_others(seed, options):
    compare(*drawn(2000 + seed, options), **options)


@rows("seed", SEEDS)
def test_a_number_for_all_is_the_same_as_an_array_of_it(seed):
    path, values, _ = drawn(3000 + seed)
    fixed = sorted(values)[::2]
    repeated = {n: np.full(SEVERAL, v[1]) if n in fixed else v for n, v in values.items()}
    try:
        alone = one_by_one(path.compose(), repeated)
    except op.errors.ParameterError:
        pytest.skip("no light can be there")
    for repeats in (1, 300):
        many = np.tile(np.arange(SEVERAL), repeats)
        some = {n: v[1].item() if n in fixed else v[many] for n, v in values.items()}
        for name, light in path.compose().run_all(**some).items():
            found = np.broadcast_to(light.stokes, (len(many), 4))
            np.testing.assert_array_equal(found, alone[name][many])


@rows("seed", SEEDS)
def test_a_grid_by_axes_has_the_paths_of_a_batch(seed):
    path, values, alone = drawn(4000 + seed)
    first = sorted(values)[::2]
    axes = {n: v[:, np.newaxis] if n in first else v for n, v in values.items()}
    try:
        lights = path.compose().run_all(**axes)
    except op.errors.ParameterError:
        pytest.skip("no light can be at other places of the grid")
    for name, light in lights.items():
        cells = np.broadcast_to(light.stokes, (SEVERAL, SEVERAL, 4))
        np.testing.assert_array_equal(cells[range(SEVERAL), range(SEVERAL)], alone[name])


@pytest.mark.parametrize("dtype", ["float64", slow("float32")])
def test_points_in_space_are_the_same_alone_and_among_others(dtype):
    path = op.path_from_vertices(op.Parameter("points"), METALS)
    for engine in COMPILED:
        points = random_chains(3, 3, (6,), extreme=True)
        compare(path, {"points": points}, engine=engine, dtype=dtype)


def test_chains_of_several_histories_are_the_same_alone_and_among_others():
    batch = random_batch(3, 3, several=6, each=2)
    which = {"ids": batch.ids, "events": batch.texts}
    path = op.path_from_vertices(op.Parameter("points"), batch.palette, **which)
    points = np.array([batch.points, 2.0 * batch.points, batch.points + 0.1])
    plan = path.compose()
    alone = [plan.run(points=own).stokes for own in points]
    np.testing.assert_array_equal(plan.run(points=points).stokes, alone)
    np.testing.assert_array_equal(plan.run(points=points[1:2]).stokes, alone[1:2])


@rows("n", [ANGLES + 1.0, ANGLES + 1.0 + 0j, ANGLES + 1.0 + 1j * (TURNS > 0)])
@rows("k", [0.0 * TURNS, np.maximum(np.sign(TURNS), 0.0)])
@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
def test_a_medium_without_absorption_is_computed_as_its_neighbours_are(n, k):
    metal = op.Interface(op.Material(op.Parameter("m"), op.Parameter("k")), op.Parameter("t"))
    path = op.Source(1.0, [1.0, 0.3, 0.2, 0.1]) >> op.Interface(op.Parameter("n"), 0.4) >> metal
    path = path >> op.Rotator(op.Parameter("turn")) >> op.Polarizer(0.3) >> op.Detector()
    compare(path, {"n": n, "k": k, "m": 0.3 + ANGLES, "t": ANGLES, "turn": TURNS})


FAINT = {
    "float64": [1e-103, 0.5, 0.0, 1e-110, 1e-200, 1.0],
    "float32": [1e-13, 0.5, 0.0, 1e-11, 1e-20, 1.0],
}


@rows("dtype", FAINT)
@rows("reading", ["stokes", "intensity"])
@pytest.mark.parametrize("engine", ["auto", "numpy", slow("numba")])
def test_light_too_faint_beside_other_light_leaves_that_as_it_is(reading, dtype, engine):
    if engine not in ("auto", *COMPILED):
        pytest.skip("not installed")
    grey = op.Attenuator(op.Parameter("share"))
    path = op.Source() >> grey >> op.Interface(1.5, op.Parameter("t"))
    path = path >> grey >> op.Interface(METALS[1], 0.8) >> grey >> op.Detector(reading)
    values = {"share": np.array(FAINT[dtype]), "t": ANGLES}
    compare(path, values, engine=engine, dtype=dtype)


def test_an_element_that_is_there_for_some_is_the_same_alone_and_among_others():
    path, deltas = op.load_preset("npgr026"), np.linspace(0.1, 1.4, 4)
    for word in ("none", "horizontal", "diagonal"):
        alone = [path.trace(delta=float(delta), filter=word).stokes for delta in deltas]
        for count in (1, 300):
            found = path.trace(delta=np.tile(deltas, count), filter=word).stokes
            np.testing.assert_array_equal(found, np.tile(alone, (count, 1)))


def test_a_tap_and_several_detectors_are_the_same_alone_and_among_others():
    nodes = {"lamp": op.Source(stokes=[1.0, 0.5, 0.2, 0.1]), "splitter": op.BeamSplitter(0.3)}
    nodes["metal"] = op.Interface(METALS[1], op.Parameter("t"))
    nodes |= {name: op.Detector() for name in ("eye", "other", "tapped")}
    links = "lamp -> splitter, splitter.reflected -> metal, splitter.transmitted -> other, "
    path = wired(nodes, links + "metal.reflected -> eye")
    path.connect("splitter.reflected", "tapped.in", tap=True)
    compare(path, {"t": ANGLES})


def test_parts_of_a_stream_are_the_batch():
    path, values, alone = drawn(5000)
    many = np.tile(np.arange(SEVERAL), 100)
    ((name, expected),) = alone.items()
    for part in path.compose().stream(64, **{n: v[many] for n, v in values.items()}):
        np.testing.assert_array_equal(part.light.stokes, expected[many][part.where], name)


def test_matrices_are_the_same_alone_and_among_others():
    plate = op.Waveplate(1e-3, 0.01, 5e-7, angle=op.Parameter("turn"))
    path = op.Source() >> op.Interface(METALS[1], op.Parameter("t")) >> plate >> op.Detector()
    plan, values = path.compose(), {"t": ANGLES, "turn": np.linspace(-1.0, 1.0, 6)}
    alone = [plan.mueller(**at(values, place)).matrix for place in range(6)]
    many = np.tile(np.arange(6), 300)
    found = plan.mueller(**{name: value[many] for name, value in values.items()}).matrix
    np.testing.assert_array_equal(found, np.array(alone)[many])


FLOATS = np.linspace(0.0, np.pi / 2, 4)
THETA, WAVELENGTH = op.Parameter("theta"), op.Wavelength()

# Absorbing layers are thin here, so that light comes through.
THIN = pytest.mark.filterwarnings("ignore::optipath.errors.CoherenceWarning")


def ramp(low, high, period=1.1e-7):
    return curve_values(Ramps(low, high, period), WAVELENGTH)[0]


# Its absorption is exactly 0 at a third of all wavelengths.
ABSORPTION = ramp(0.0, 3.0, 1.7e-7)
METAL = op.Interface(op.Material(ramp(0.3, 2.5), ABSORPTION), THETA)
PLATE = op.Waveplate(1e-3, ramp(-0.01, 0.02), WAVELENGTH, angle=0.4)


def combined():
    """Everything in which elementary functions are taken of what follows from the wavelength."""
    indices = [1.0, op.Material(ramp(1.4, 1.7), ramp(0.0, 1e-2)), 1.5, 1.0]
    stack = op.LayerStack(indices, THETA, lengths=[1e-6, 1e-3], wavelength=WAVELENGTH)
    turned = {"rotation": ramp(-5.0, 5.0), "retardance": 30.0}
    medium = op.Medium(0.1, ramp(20.0, 30.0), dichroism=ramp(-10.0, 10.0), **turned)
    path = op.Source(2.0, [1.0, 0.5, 0.2, 0.1]) >> METAL >> PLATE >> op.Rotator(ramp(-3, 3, 9e-8))
    return path >> medium >> op.Polarizer(THETA) >> stack >> op.Detector()


def assert_grid_is_its_runs(path, *, engine="auto", dtype="float64", runs=1, **axis):
    """Compare the light of a grid with that of each of its paths by a run of its own."""
    (values,) = (axis := axis or {"theta": FLOATS}).values()
    given = {"wavelength": wavelengths(5)[:, None], **axis}
    alone = run_by_run(op.Composer(dtype=dtype).compose(path), given, (5, len(values)))
    plan = op.Composer(engine=engine, dtype=dtype).compose(path)
    for _ in range(runs):
        lights = plan.run_all(**given)
    assert alone.keys() == lights.keys()
    for name, light in lights.items():
        np.testing.assert_array_equal(alone[name], light.stokes)
    return lights


@pytest.mark.parametrize("dtype", ["float64", slow("float32")])
@rows("engine", COMPILED)
def test_a_grid_is_its_runs_one_by_one_by_every_engine(engine, dtype):
    path = op.Source() >> METAL >> op.Medium(0.1, ramp(0.0, 9.0)) >> op.Rotator(ramp(-3.0, 3.0))
    assert_grid_is_its_runs(path >> op.Polarizer(0.3) >> op.Detector(), engine=engine, dtype=dtype)


@THIN
@rows("dtype", ["float64", "float32"])
@rows("runs", [1, 5])
def test_a_grid_is_its_runs_step_by_step_and_by_a_formula(runs, dtype):
    assert_grid_is_its_runs(combined(), runs=runs, dtype=dtype)


@THIN
@rows("seed", range(8))
@pytest.mark.parametrize("more", [0, slow(8), slow(16)])
def test_random_paths_of_a_wavelength_are_the_same_alone_and_among_others(seed, more):
    path, given = SpectralDraw(seed + more).spectral_path()
    plan = path.compose()
    try:
        alone = run_by_run(plan, {**given, "wavelength": wavelengths(7)}, (7,))
    except op.errors.ParameterError:
        pytest.skip("no light can be where it has been drawn")
    for count in (1, 300):
        lights = plan.run_all(**given, wavelength=np.tile(wavelengths(7), count))
        for name, light in lights.items():
            assert np.array_equal(alone[name], light.stokes[:7], equal_nan=True)


@THIN
def test_at_wavelengths_the_first_run_is_the_tenth_and_parts_of_a_stream_are_the_batch():
    plan = combined().compose()
    lights = [plan.run(wavelength=5.1e-7, theta=0.7).stokes for _ in range(10)]
    assert all(np.array_equal(lights[0], light) for light in lights)
    plan, given = combined().compose(), {"wavelength": wavelengths(50)[:, None], "theta": FLOATS}
    whole = plan.run(**given).stokes
    for part in plan.stream(7, **given):
        assert np.array_equal(whole[part.where], part.light.stokes)


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
def test_no_absorption_faint_light_and_huge_angles_leave_their_neighbours_as_they_are():
    k = np.array([ABSORPTION.curve.evaluated(w)[0] for w in wavelengths(5)])
    assert set(k == 0.0) == {True, False}
    assert_grid_is_its_runs(op.Source() >> METAL >> op.Detector())
    black = op.Medium(1.0, ramp(0.0, 1900.0))
    (light,) = assert_grid_is_its_runs(op.Source() >> black >> METAL >> op.Detector()).values()
    assert np.any(light.intensity < 1e-290)
    path = op.Source(1.0, [1, 1, 0, 0]) >> op.Rotator(op.Parameter("turn")) >> PLATE
    assert_grid_is_its_runs(
        path >> op.Polarizer(0.2) >> op.Detector(), turn=np.array([0.3, 3e5, -2.0, 1e12])
    )


def test_a_loop_of_a_wavelength_is_the_same_alone_and_among_others():
    nodes = {"lamp": op.Source(), "splitter": op.BeamSplitter(ramp(0.0005, 0.9))}
    links = "lamp -> splitter.in, splitter.transmitted -> eye, splitter.reflected -> mirror, "
    nodes |= {"mirror": METAL, "eye": op.Detector()}
    assert_grid_is_its_runs(wired(nodes, links + "mirror.reflected -> splitter.back", loops="sum"))


@THIN
def test_matrices_of_a_wavelength_are_the_same_alone_and_among_others():
    path, w = combined(), wavelengths(400)
    plan, single = path.compose(), path.compose()
    found = plan.mueller(wavelength=w[:, None], theta=FLOATS[1:]).matrix
    angles = FLOATS[1:].tolist()
    alone = [[single.mueller(wavelength=a, theta=t).matrix for t in angles] for a in w[:5]]
    assert np.array_equal(found[:5], alone)


def test_a_cosine_and_a_sine_in_place_of_an_angle_are_the_same_alone_and_among_others():
    path = op.Source() >> op.Rotator(op.Parameter("turn")) >> PLATE >> op.Polarizer(0.1)
    plan = (path >> op.Detector()).compose()
    pair = op.CosSin(np.cos(0.7), np.sin(0.7))
    alone = [plan.run(wavelength=float(w), turn=pair).stokes for w in wavelengths(7)]
    for count in (1, 300):
        together = plan.run(wavelength=np.tile(wavelengths(7), count), turn=pair).stokes
        assert np.array_equal(alone, together[:7])
