"""Methods, precisions and ways of composing, by every engine."""

import pytest

import optipath as op
from optipath.kernels.catalogue import METHODS
from subjects import ENGINES, METAL, angles, assignment, finished

COUNT = 100_000


@pytest.mark.parametrize("materials", [{}, METAL], ids=["glass", "metal"])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("composing", ["stokes", "jones"])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("engine", ENGINES)
def test_method(benchmark, engine, method, composing, dtype, materials):
    benchmark.group = f"{engine}, {'metal' if materials else 'glass'}, {COUNT:,} paths"
    composer = op.Composer(engine=engine, method=method, composing=composing, dtype=dtype)
    plan, given = composer.compose(assignment(**materials)), angles(COUNT, dtype)
    finished(plan.run(**given).stokes)
    benchmark(lambda: finished(plan.run(**given).stokes))
