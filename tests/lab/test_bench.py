"""The measurements behind ``optipath bench``: what is compiled for them, and what is refused."""

from collections import Counter

import pytest

import optipath as op
from optipath.engines.numpy_engine import NumpyEngine
from optipath.lab.bench import report
from optipath.lab.bench.report import bench


def test_no_formula_is_compiled_twice(monkeypatch):
    compiled, texts = NumpyEngine.compiled, Counter()

    def counted(engine, formula):
        texts[tuple(map(repr, formula.steps)), formula.dtype.name] += 1
        return compiled(engine, formula)

    monkeypatch.setattr(NumpyEngine, "compiled", counted)
    monkeypatch.setattr(report, "race", lambda contenders, **_: run_once(contenders))
    bench(op.load_preset("npgr026"), lambda: None, largest=10_000, engines=["numpy"])
    assert len(texts) > 2
    assert set(texts.values()) == {1}


def run_once(contenders):
    for name, action in contenders.items():
        if "import" not in name:
            action()
    return {}


def test_an_engine_that_is_not_installed_is_told(monkeypatch):
    monkeypatch.setattr(report, "is_installed", lambda engine: engine != "jax")
    with pytest.raises(op.OptipathError, match="need JAX, which is not installed"):
        bench(op.load_preset("malus"), lambda: None, engines=["numpy", "jax"])
