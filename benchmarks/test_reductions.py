"""Reduced plans against the full 4x4 composition: two interfaces and an intensity, and a grid."""

import numpy as np
import pytest

import optipath as op
from subjects import COMPILED, ENGINES, METAL, finished, long

COUNT = 1_000_000
MEDIA = {"dielectric": (1.5, 1.65), "metal": (0.6 + 2.1j, 0.66 + 2.31j)}


def two_interfaces(media, turn):
    """Return an unpolarised lamp, two interfaces, and a detector of the intensity."""
    path = op.PathGraph()
    first, second = MEDIA[media]
    lamp = path.add("lamp", op.Source(intensity=100.0))
    x2 = path.add("x2", op.Interface(first, op.Parameter("phi")))
    x1 = path.add("x1", op.Interface(second, op.Parameter("delta"), azimuth=turn))
    lamp >> x2 >> x1 >> path.add("eye", op.Detector(reads="intensity"))
    return path


@pytest.mark.parametrize("engine", COMPILED)
@pytest.mark.parametrize("media", [*long("dielectric"), "metal"])
@pytest.mark.parametrize("turn", [0.0, 0.4])
@pytest.mark.parametrize("model", ["full", "auto"])
def test_an_intensity_behind_two_interfaces(benchmark, engine, media, turn, model):
    benchmark.group = f"two interfaces, {media}, turned by {turn}, {engine}"
    plan = op.Composer(engine=engine, model=model).compose(two_interfaces(media, turn))
    draw = np.random.default_rng(1).uniform
    given = {name: draw(0.0, np.pi / 2, COUNT) for name in ("delta", "phi")}
    plan.run(**given)
    benchmark(lambda: plan.run(**given).intensity)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("model", ["full", "auto"])
def test_a_grid_of_angles(benchmark, engine, model):
    benchmark.group = f"a grid of 1,000 x 1,000 angles, {engine}"
    plan = op.Composer(engine=engine, model=model).compose(op.load_preset("npgr026", **METAL))
    axis = np.linspace(0.0, np.pi / 2, 1000)
    given = {"delta": axis[:, np.newaxis], "phi": axis, "rho": 0.5}
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))


def mirrors(count):
    """Return an unpolarised lamp, silver mirrors turned by any angles, and an intensity."""
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for number in range(count):
        turn = op.Parameter(f"turn{number}") if number else 0.0
        mirror = op.Interface(0.05 + 3.858j, op.Parameter("angle"), azimuth=turn)
        node = node >> path.add(f"m{number}", mirror)
    node >> path.add("eye", op.Detector(reads="intensity"))
    return path


@pytest.mark.parametrize("engine", COMPILED)
@pytest.mark.parametrize("count", [2, 5, *long(10)])
@pytest.mark.parametrize("tolerance", [None, 0.05])
def test_a_tolerance_for_mirrors(benchmark, engine, count, tolerance):
    benchmark.group = f"{count} mirrors, {engine}"
    plan = op.Composer(engine=engine, tolerance=tolerance).compose(mirrors(count))
    draw = np.random.default_rng(1).uniform
    given = {"angle": draw(0.0, 1.2, COUNT // 10)}
    given |= {f"turn{number}": draw(-3.0, 3.0, COUNT // 10) for number in range(1, count)}
    plan.run(**given)
    benchmark(lambda: plan.run(**given).intensity)
