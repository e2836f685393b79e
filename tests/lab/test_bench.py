"""The measurements behind ``optipath bench``: what is compiled for them, and what is refused."""

from collections import Counter

import pytest

import optipath as op
from optipath.engines.numpy_engine import NumpyEngine
from optipath.kernels.catalogue import METHODS
from optipath.lab.bench import report
from optipath.lab.bench.report import bench
from optipath.lab.bench.timing import Timing


@pytest.mark.parametrize("long", [False, True])
def test_no_formula_is_compiled_twice(monkeypatch, long):
    compiled, texts = NumpyEngine.compiled, Counter()

    def counted(engine, formula):
        texts[tuple(map(repr, formula.steps)), formula.dtype.name] += 1
        return compiled(engine, formula)

    monkeypatch.setattr(NumpyEngine, "compiled", counted)
    monkeypatch.setattr(report, "race", lambda contenders, **_: run_once(contenders))
    path = op.load_preset("npgr026")
    found = bench(path, lambda: None, largest=10_000, long=long, engines=["numpy"])
    assert len(texts) > 2 * long
    assert set(texts.values()) == {1}
    assert {run["paths"] for run in found.batches} == (
        {1, 10, 100, 1_000, 10_000} if long else {100, 10_000}
    )
    assert len(found.batches) == (5 * 4 if long else 2)
    assert [run["method"] for run in found.methods] == [*METHODS[: None if long else 1]]


def test_of_several_sources_the_first_gives_the_matrix(monkeypatch):
    monkeypatch.setattr(report, "race", lambda contenders, **_: run_once(contenders))
    path = op.load_preset("sky-and-window")
    found = bench(path, lambda: None, largest=1, long=True, engines=["numpy"])
    assert {run["output"] for run in found.batches} == {"stokes", "mueller"}


def run_once(contenders):
    for name, action in contenders.items():
        if "import" not in name:
            action()
    return dict.fromkeys(contenders, Timing(1.0, 1.0, 1.0))


def test_an_engine_that_is_not_installed_is_told(monkeypatch):
    monkeypatch.setattr(report, "is_installed", lambda engine: engine != "jax")
    with pytest.raises(op.OptipathError, match="need JAX, which is not installed"):
        bench(op.load_preset("malus"), lambda: None, engines=["numpy", "jax"])
