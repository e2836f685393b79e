"""Whatever a path is made of, it comes to the same bits alone and in any batch."""

import numpy as np
import pytest

import optipath as op
from batch_paths import SEVERAL, BatchDraw, at, one_by_one
from batches_of_chains import random_batch
from chains import COMPILED, random_chains
from tables import rows, slow

SEEDS = range(8)
MORE = pytest.mark.parametrize("more", [0, *map(slow, range(8, 80, 8))])
METALS = 1.5, 1.12 + 2.16j, 0.608 + 2.12j
TURNS = np.array([0.0, -0.0, np.pi / 2, np.pi, -3.0, 1e12])
ANGLES = np.array([0.0, np.pi / 2, 0.982793723247329, 0.3, 1e-9, 1.2])


def drawn(seed, options, *, loops=False):
    """A random path, its values, and its light one by one; where there can be light."""
    path, values = BatchDraw(seed).batch(loops=loops)
    try:
        plan = op.Composer(**options).compose(path)
        alone = one_by_one(plan, values)
        # By now a function of floats has been made.
        again = one_by_one(plan, values)
    except op.OptipathError as error:
        pytest.skip(f"no such path: {error}")
    assert_same(again, alone)
    return path, values, alone


def assert_same(found, expected, where=...):
    for name, stokes in expected.items():
        np.testing.assert_array_equal(found[name], stokes[where])


def stokes(lights):
    return {name: light.stokes for name, light in lights.items()}


def compare(path, values, alone, engine, options, repeats=300):
    """Compare a batch, a part, one path, and many with the paths one by one."""
    plan = op.Composer(engine=engine, **options).compose(path)
    count = len(next(iter(values.values())))
    for part in (slice(None), slice(2, 5), slice(1, 2)):
        some = {name: value[part] for name, value in values.items()}
        assert_same(stokes(plan.run_all(**some)), alone, part)
    many = np.tile(np.arange(count), repeats)
    for _ in range(2):
        lights = plan.run_all(**{name: value[many] for name, value in values.items()})
        assert_same(stokes(lights), alone, many)


@rows("dtype", ["float64", "float32"])
@rows("seed", SEEDS)
@MORE
def test_random_paths_are_the_same_alone_and_among_others(seed, dtype, more):
    path, values, alone = drawn(seed + more, {"dtype": dtype})
    for engine in ("auto", "numpy"):
        compare(path, values, alone, engine, {"dtype": dtype})


@pytest.mark.slow  # Numba compiles for long.
@pytest.mark.skipif("numba" not in COMPILED, reason="not installed")
@pytest.mark.parametrize("seed", SEEDS)
def test_random_paths_are_the_same_by_numba(seed):
    compare(*drawn(seed, {}), "numba", {})


@rows("seed", SEEDS)
@MORE
def test_loops_are_the_same_alone_and_among_others(seed, more):
    compare(*drawn(1000 + seed + more, {}, loops=True), "auto", {})


@rows(
    "options",
    [
        {"method": "textbook"},
        {"method": "amplitude"},
        {"method": "compensated"},
        {"composing": "jones"},
        {"tolerance": 0.1},
    ],
)
@rows("seed", SEEDS[:3])
def test_each_way_of_composing_is_the_same_alone_and_among_others(seed, options):
    compare(*drawn(2000 + seed, options), "auto", options)


@pytest.mark.parametrize("seed", SEEDS[:6])
def test_a_number_for_all_is_the_same_as_an_array_of_it(seed):
    path, values, _ = drawn(3000 + seed, {})
    fixed = sorted(values)[::2]
    repeated = {n: np.full(SEVERAL, v[1]) if n in fixed else v for n, v in values.items()}
    single = {n: v[1].item() if n in fixed else v for n, v in values.items()}
    try:
        alone = one_by_one(path.compose(), repeated)
    except op.ParameterError:
        pytest.skip("no light can be there")
    for repeats in (1, 300):
        many = np.tile(np.arange(SEVERAL), repeats)
        some = {n: v[many] if n not in fixed else v for n, v in single.items()}
        for name, light in path.compose().run_all(**some).items():
            found = np.broadcast_to(light.stokes, (len(many), 4))
            np.testing.assert_array_equal(found, alone[name][many])


@pytest.mark.parametrize("seed", SEEDS[:6])
def test_a_grid_by_axes_has_the_paths_of_a_batch(seed):
    path, values, alone = drawn(4000 + seed, {})
    first = sorted(values)[::2]
    rows = {n: v[:, np.newaxis] if n in first else v for n, v in values.items()}
    try:
        lights = path.compose().run_all(**rows)
    except op.ParameterError:
        pytest.skip("no light can be at other places of the grid")
    for name, light in lights.items():
        cells = np.broadcast_to(light.stokes, (SEVERAL, SEVERAL, 4))
        found = cells[range(SEVERAL), range(SEVERAL)]
        np.testing.assert_array_equal(found, alone[name])


@pytest.mark.parametrize("dtype", ["float64", slow("float32")])
def test_points_in_space_are_the_same_alone_and_among_others(dtype):
    path = op.path_from_vertices(op.Parameter("points"), METALS)
    values = {"points": random_chains(3, 3, (6,), extreme=True)}
    alone = one_by_one(op.Composer(dtype=dtype).compose(path), values, 6)
    for engine in COMPILED:
        compare(path, values, alone, engine, {"dtype": dtype})


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
@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_a_medium_without_absorption_is_computed_as_its_neighbours_are(n, k):
    path = op.Source(1.0, [1.0, 0.3, 0.2, 0.1]) >> op.Interface(op.Parameter("n"), 0.4)
    path = path >> op.Interface(
        op.Material(op.Parameter("m"), op.Parameter("k")), op.Parameter("t")
    )
    path = path >> op.Rotator(op.Parameter("turn")) >> op.Polarizer(0.3) >> op.Detector()
    values = {"n": n, "k": k, "m": 0.3 + ANGLES, "t": ANGLES, "turn": TURNS}
    compare(path, values, one_by_one(path.compose(), values, 6), "auto", {})


@rows("dtype", ["float64", "float32"])
@rows("reading", ["stokes", "intensity"])
@pytest.mark.parametrize("engine", ["auto", "numpy", slow("numba")])
def test_light_too_faint_beside_other_light_leaves_that_as_it_is(reading, dtype, engine):
    if engine not in ("auto", *COMPILED):
        pytest.skip("not installed")
    grey = op.Attenuator(op.Parameter("share"))
    path = op.Source() >> grey >> op.Interface(1.5, op.Parameter("t"))
    path = path >> grey >> op.Interface(METALS[1], 0.8) >> grey >> op.Detector(reading)
    shares = [1e-103, 0.5, 0.0, 1e-110, 1e-200, 1.0]
    if dtype == "float32":
        shares = [1e-13, 0.5, 0.0, 1e-11, 1e-20, 1.0]
    values = {"share": np.array(shares), "t": ANGLES}
    alone = one_by_one(op.Composer(dtype=dtype).compose(path), values, 6)
    compare(path, values, alone, engine, {"dtype": dtype})


def test_an_element_that_is_there_for_some_is_the_same_alone_and_among_others():
    path, deltas = op.load_preset("npgr026"), np.linspace(0.1, 1.4, 4)
    for word in ("none", "horizontal", "diagonal"):
        alone = [path.trace(delta=float(delta), filter=word).stokes for delta in deltas]
        for count in (1, 300):
            found = path.trace(delta=np.tile(deltas, count), filter=word).stokes
            np.testing.assert_array_equal(found, np.tile(alone, (count, 1)))


def test_a_tap_and_several_detectors_are_the_same_alone_and_among_others():
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=[1.0, 0.5, 0.2, 0.1]))
    path.add("splitter", op.BeamSplitter(0.3))
    path.add("metal", op.Interface(METALS[1], op.Parameter("t")))
    for name in ("eye", "other", "tapped"):
        path.add(name, op.Detector())
    path.connect("lamp.out", "splitter.in")
    path.connect("splitter.reflected", "metal.in")
    path.connect("splitter.transmitted", "other.in")
    path.connect("metal.reflected", "eye.in")
    path.connect("splitter.reflected", "tapped.in", tap=True)
    values = {"t": ANGLES}
    compare(path, values, one_by_one(path.compose(), values, 6), "auto", {})


def test_parts_of_a_stream_are_the_batch():
    path, values, alone = drawn(5000, {})
    many = np.tile(np.arange(SEVERAL), 100)
    (name, expected), *_ = alone.items()
    if len(alone) > 1:
        pytest.skip("a stream has one detector")
    for part in path.compose().stream(64, **{n: v[many] for n, v in values.items()}):
        np.testing.assert_array_equal(part.light.stokes, expected[many][part.where], name)


def test_matrices_are_the_same_alone_and_among_others():
    path = (
        op.Source()
        >> op.Interface(METALS[1], op.Parameter("t"))
        >> op.Waveplate(1e-3, 0.01, 5e-7, angle=op.Parameter("turn"))
    )
    plan = (path >> op.Detector()).compose()
    values = {"t": ANGLES, "turn": np.linspace(-1.0, 1.0, 6)}
    alone = [plan.mueller(**at(values, place)).matrix for place in range(6)]
    many = np.tile(np.arange(6), 300)
    found = plan.mueller(**{name: value[many] for name, value in values.items()}).matrix
    np.testing.assert_array_equal(found, np.array(alone)[many])
