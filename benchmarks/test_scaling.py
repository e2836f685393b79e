"""Paths of 10 to 100,000 elements: time should grow as they do."""

import numpy as np
import pytest

import optipath as op
from subjects import chain

LENGTHS = [10, 100, 1_000, 10_000, 100_000]


@pytest.mark.benchmark(group="build a chain")
@pytest.mark.parametrize("length", LENGTHS)
def test_build(benchmark, length):
    benchmark.pedantic(chain, (length,), rounds=3)


@pytest.mark.benchmark(group="compose a chain")
@pytest.mark.parametrize("length", LENGTHS)
def test_compose(benchmark, length):
    path = chain(length)
    benchmark.pedantic(op.Composer().compose, (path,), rounds=3)


@pytest.mark.benchmark(group="run a chain, one path")
@pytest.mark.parametrize("length", LENGTHS)
def test_run(benchmark, length):
    plan = op.Composer().compose(chain(length))
    plan.run()
    benchmark.pedantic(plan.run, rounds=3)


@pytest.mark.benchmark(group="run a chain, 1,000 paths")
@pytest.mark.parametrize("length", LENGTHS[:-1])
def test_run_many(benchmark, length):
    path = op.PathGraph()
    node = path.add("lamp", op.Source(op.Parameter("intensity")))
    for number in range(length):
        node = node >> path.add(f"e{number}", op.Interface(1.5, 0.3, azimuth=0.1))
    node >> path.add("eye", op.Detector())
    plan = op.Composer().compose(path)
    benchmark.pedantic(plan.run, kwargs={"intensity": np.linspace(1, 2, 1000)}, rounds=3)
