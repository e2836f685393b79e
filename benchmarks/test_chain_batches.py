"""A million chains of one to eight reflections and refractions in any order, in one batch."""

import numpy as np
import pytest

import optipath as op
from subjects import finished, needs_numba, traced

COUNT = 1_000_000
PALETTE = [
    1.0,
    1.2,
    1.33,
    1.5,
    1.77,
    2.42,
    *(0.2 + 0.3 * i + (3.0 - 0.3 * i) * 1j for i in range(8)),
]
GROUP = "a million chains of one to eight events"


@pytest.fixture(scope="session")
def chains():
    """The arguments of chains, 100,000 of which differ: light is reflected off what absorbs."""
    rng = np.random.default_rng(1)
    refracted = rng.random((COUNT // 10, 8)) < 0.5
    ids = np.where(
        refracted, rng.integers(0, 6, refracted.shape), rng.integers(6, 14, refracted.shape)
    )
    points = traced(refracted, np.real(PALETTE)[ids], seed=1)
    several = {"ids": ids, "events": np.where(refracted, "T", "R")}
    several["lengths"] = rng.integers(1, 9, len(ids))
    many = {name: np.concatenate([value] * 10) for name, value in several.items()}
    return many | {"vertices": np.concatenate([points] * 10)}


def path_of(chains, bad="mask"):
    return op.path_from_vertices(materials=PALETTE, bad=bad, **chains)


@needs_numba
@pytest.mark.benchmark(group=GROUP)
def test_a_path_that_is_there(benchmark, chains):
    plan = op.Composer(engine="numba").compose(path_of(chains))
    finished(plan.run().stokes)
    benchmark(lambda: finished(plan.run().stokes))


@pytest.mark.benchmark(group=GROUP)
@pytest.mark.parametrize("bad", ["mask", "refuse"])
def test_the_making_of_a_path(benchmark, chains, bad):
    benchmark.pedantic(path_of, (chains, bad), rounds=3)


@needs_numba
@pytest.mark.benchmark(group=GROUP)
def test_a_path_of_its_own_for_new_points(benchmark, chains):
    def light():
        finished(op.Composer(engine="numba").compose(path_of(chains)).run().stokes)

    benchmark.pedantic(light, rounds=3, warmup_rounds=1)
