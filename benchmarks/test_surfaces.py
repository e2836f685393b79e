"""Photons over rough surfaces, beside a fixed piece of arithmetic written by hand.

A million photons each, with Stokes vector and scalar twin, by one thread or two; the arithmetic
is a million reflections off glass by the amplitudes, so that ratios compare from machine to
machine. The times of meshes of more and more cells tell how the cost of a photon grows.
"""

import math
import warnings

import pytest

import optipath as op
from optipath import surfaces
from subjects import long

numba = pytest.importorskip("numba")

PHOTONS = 1_000_000
ALPHA, INCIDENCE = 0.25, "40 deg"


def field(cells, seed):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", op.errors.MeshWarning)
        return surfaces.HeightField.beckmann(ALPHA, cells=cells, seed=seed)


def walked(benchmark, sample, threads=1):
    surfaces.energy(sample, INCIDENCE, photons=1)
    options = {"threads": threads}
    benchmark.pedantic(surfaces.energy, (sample, INCIDENCE, PHOTONS), options, rounds=3)
    benchmark.extra_info["photons a second"] = round(PHOTONS / benchmark.stats.stats.min)


@numba.njit
def by_hand(count):
    """Reflect polarised light off glass, at one angle after the other."""
    total = 0.0
    for place in range(count):
        c = (place + 0.5) / count
        g = math.sqrt(1.5 * 1.5 - 1.0 + c * c)
        r_s = (c - g) / (c + g)
        r_p = (2.25 * c - g) / (2.25 * c + g)
        A, B, C = 0.5 * (r_s * r_s + r_p * r_p), 0.5 * (r_s * r_s - r_p * r_p), r_s * r_p
        total += A + 0.5 * B + 0.5 * C + math.cos(c) * math.sin(c)
    return total


@pytest.mark.benchmark(group="a million photons")
def test_arithmetic_by_hand(benchmark):
    by_hand(1)
    benchmark(by_hand, PHOTONS)


@pytest.mark.benchmark(group="a million photons")
def test_one_dielectric_layer(benchmark):
    walked(benchmark, op.Sample([(1.5, field(512, 0))]))


@pytest.mark.benchmark(group="a million photons")
def test_two_layers(benchmark):
    walked(benchmark, op.Sample([(1.5, field(512, 0)), (2.4, field(512, 1))]))


@pytest.mark.benchmark(group="a million photons")
def test_one_dielectric_layer_by_two_threads(benchmark):
    walked(benchmark, op.Sample([(1.5, field(512, 0))]), threads=2)


@pytest.mark.benchmark(group="cells of the mesh")
@pytest.mark.parametrize("cells", [256, 1024, *long(2048, 4096)])
def test_cells(benchmark, cells):
    walked(benchmark, op.Sample([(1.5, field(cells, 0))]))
