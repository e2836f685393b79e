"""Batches by every engine: Stokes vectors, Mueller matrices and float32 out."""

import pytest

import optipath as op
from subjects import COMPILED, ENGINES, angles, assignment, finished, long

SIZES = [1, 1_000, 1_000_000, *long(10, 100, 10_000, 100_000, 10_000_000)]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("size", SIZES)
def test_stokes(benchmark, engine, size):
    benchmark.group = f"Stokes vectors, {size:,} paths"
    plan, given = op.Composer(engine=engine).compose(assignment()), angles(size)
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("size", [*long(1, 1_000), 1_000_000])
def test_mueller(benchmark, engine, size):
    benchmark.group = f"Mueller matrices, {size:,} paths"
    plan, given = op.Composer(engine=engine).compose(assignment()), angles(size)
    finished(plan.mueller(**given).matrix)
    benchmark(lambda: finished(plan.mueller(**given).matrix))


@pytest.mark.benchmark(group="Stokes vectors in float32, 1,000,000 paths")
@pytest.mark.parametrize("engine", ENGINES)
def test_float32(benchmark, engine):
    plan = op.Composer(engine=engine, dtype="float32").compose(assignment())
    given = angles(1_000_000, "float32")
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))


@pytest.mark.benchmark(group="a grid of 2,000 x 1,000, part by part")
@pytest.mark.parametrize("engine", COMPILED)
def test_stream(benchmark, engine):
    plan, given = op.Composer(engine=engine).compose(assignment()), angles(2000)
    axes = {"delta": given["delta"][:, None], "phi": given["phi"][:1000]}
    benchmark(lambda: sum(part.light.stokes[0, 0] for part in plan.stream(**axes)))
