"""Composing and running against path length, and npgr026 against batch size.

    pytest benchmarks --benchmark-only

Only ratios within one run mean anything; pin OPENBLAS_NUM_THREADS and OMP_NUM_THREADS to 1.
"""

import numpy as np
import pytest

import optipath as op
from optipath.kernels import METHODS


def chain(length):
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for number in range(length):
        node = node >> path.add(f"e{number}", op.Interface(1.5, 0.3, azimuth=0.1))
    node >> path.add("eye", op.Detector())
    return path


@pytest.mark.benchmark(group="build a chain")
@pytest.mark.parametrize("length", [100, 1_000, 10_000])
def test_build(benchmark, length):
    benchmark(chain, length)


@pytest.mark.benchmark(group="compose a chain")
@pytest.mark.parametrize("length", [100, 1_000, 10_000])
def test_compose(benchmark, length):
    benchmark(op.Composer().compose, chain(length))


@pytest.mark.benchmark(group="run a chain")
@pytest.mark.parametrize("length", [100, 1_000, 10_000])
def test_run(benchmark, length):
    benchmark(op.Composer().compose(chain(length)).run)


@pytest.mark.benchmark(group="npgr026, horizontal filter, random angles")
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("size", [1, 1_000, 100_000])
def test_npgr026(benchmark, method, size):
    plan = op.Composer(method=method).compose(op.load_preset("npgr026", filter="horizontal"))
    angles = np.random.default_rng(1).uniform(0, np.pi / 2, size=(3, size))
    benchmark(plan.run, delta=angles[0], rho=angles[1], phi=angles[2])


@pytest.mark.benchmark(group="load npgr026")
def test_load(benchmark):
    benchmark(op.load_preset, "npgr026")
