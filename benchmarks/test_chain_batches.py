"""Chains of one to eight reflections and refractions in any order; a million with -m long."""

import numpy as np
import pytest

import optipath as op
from subjects import finished, long, needs_numba, traced

PALETTE = [
    1.0,
    1.2,
    1.33,
    1.5,
    1.77,
    2.42,
    *(0.2 + 0.3 * i + (3.0 - 0.3 * i) * 1j for i in range(8)),
]


@pytest.fixture(scope="session", params=[100_000, *long(1_000_000)])
def chains(request):
    """The arguments of chains, 100,000 of which differ: light is reflected off what absorbs."""
    rng = np.random.default_rng(1)
    refracted = rng.random((100_000, 8)) < 0.5
    ids = np.where(
        refracted, rng.integers(0, 6, refracted.shape), rng.integers(6, 14, refracted.shape)
    )
    points = traced(refracted, np.real(PALETTE)[ids], seed=1)
    times = request.param // len(ids)
    several = {"ids": ids, "events": np.where(refracted, "T", "R")}
    several["lengths"] = rng.integers(1, 9, len(ids))
    many = {name: np.concatenate([value] * times) for name, value in several.items()}
    return many | {"vertices": np.concatenate([points] * times)}


@pytest.fixture
def timed(benchmark, chains):
    benchmark.group = f"{len(chains['lengths']):,} chains of one to eight events"
    return benchmark


def path_of(chains, bad="mask"):
    return op.path_from_vertices(materials=PALETTE, bad=bad, **chains)


@needs_numba
def test_a_path_that_is_there(timed, chains):
    plan = op.Composer(engine="numba").compose(path_of(chains))
    finished(plan.run().stokes)
    timed(lambda: finished(plan.run().stokes))


@pytest.mark.parametrize("bad", ["mask", "refuse"])
def test_the_making_of_a_path(timed, chains, bad):
    timed.pedantic(path_of, (chains, bad), rounds=3)


@needs_numba
def test_a_path_of_its_own_for_new_points(timed, chains):
    def light():
        finished(op.Composer(engine="numba").compose(path_of(chains)).run().stokes)

    timed.pedantic(light, rounds=3, warmup_rounds=1)


@needs_numba
def test_new_chains_given_to_a_plan(timed, chains):
    parts = {name: op.Parameter(name) for name in chains}
    path = op.path_from_vertices(materials=PALETTE, bad="mask", count=8, **parts)
    plan = op.Composer(engine="numba").compose(path)
    finished(plan.run(**chains).stokes)
    timed(lambda: finished(plan.run(**chains).stokes))
