"""Paths of 10 to 100,000 elements: time should grow as they do."""

import numpy as np
import pytest

import optipath as op
from subjects import chain, long

LENGTHS = [10, 100, 1_000, *long(10_000, 100_000)]


@pytest.mark.benchmark(group="build a chain")
@pytest.mark.parametrize("length", LENGTHS)
def test_build(benchmark, length):
    benchmark.pedantic(chain, (length,), rounds=3)


@pytest.mark.benchmark(group="compose a chain")
@pytest.mark.parametrize("length", LENGTHS)
def test_compose(benchmark, length):
    benchmark.pedantic(op.Composer().compose, (chain(length),), rounds=3)


@pytest.mark.benchmark(group="run a chain, one path")
@pytest.mark.parametrize("length", LENGTHS)
def test_run(benchmark, length):
    plan = op.Composer().compose(chain(length))
    benchmark.pedantic(plan.run, rounds=3, warmup_rounds=1)


@pytest.mark.benchmark(group="run a chain, 1,000 paths")
@pytest.mark.parametrize("length", LENGTHS[:-1])
def test_run_many(benchmark, length):
    plan = op.Composer().compose(chain(length, op.Parameter("intensity")))
    benchmark.pedantic(plan.run, kwargs={"intensity": np.linspace(1, 2, 1000)}, rounds=3)
