"""Methods by every engine; precisions, ways of composing and materials with -m long."""

import pytest

import optipath as op
from optipath.kernels.catalog import METHODS
from subjects import ENGINES, METAL, angles, assignment, finished, long

COUNT = 100_000
KINDS = ["metal float64 stokes", *long("glass float64 stokes", "metal float32 stokes")]


@pytest.mark.parametrize("kind", [*KINDS, *long("metal float64 jones")])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("engine", ENGINES)
def test_method(benchmark, engine, method, kind):
    benchmark.group = f"{engine}, {kind}, {COUNT:,} paths"
    materials, dtype, composing = kind.split()
    composer = op.Composer(engine=engine, method=method, composing=composing, dtype=dtype)
    path = assignment(**(METAL if materials == "metal" else {}))
    plan, given = composer.compose(path), angles(COUNT, dtype)
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))
