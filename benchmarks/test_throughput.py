"""Batches of 1 to 1e7 paths, Stokes vectors and Mueller matrices out."""

import pytest

import optipath as op
from subjects import ENGINES, angles, assignment, finished

SIZES = [10**power for power in range(8)]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("size", SIZES)
def test_stokes(benchmark, engine, size):
    benchmark.group = f"Stokes vectors, {size:,} paths"
    plan, given = op.Composer(engine=engine).compose(assignment()), angles(size)
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("size", SIZES[:-1])
def test_mueller(benchmark, engine, size):
    benchmark.group = f"Mueller matrices, {size:,} paths"
    plan, given = op.Composer(engine=engine).compose(assignment()), angles(size)
    finished(plan.mueller(**given).matrix)
    benchmark(lambda: finished(plan.mueller(**given).matrix))


@pytest.mark.benchmark(group="a grid of 4,000 x 2,500, part by part")
@pytest.mark.parametrize("engine", [engine for engine in ENGINES if engine != "jax"])
def test_stream(benchmark, engine):
    plan, given = op.Composer(engine=engine).compose(assignment()), angles(4000)
    axes = {"delta": given["delta"][:, None], "phi": given["phi"][:2500]}
    benchmark(lambda: sum(part.light.stokes[0, 0] for part in plan.stream(**axes)))
