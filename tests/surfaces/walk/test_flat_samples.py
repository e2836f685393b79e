"""Photons on flat interfaces do what a stack of layers does, which is known in closed form.

Statistical tests have fixed seeds, and would fail by chance once in a million of other seeds.
"""

import math

import numpy as np
import pytest

import optipath as op
from optipath import surfaces

pytest.importorskip("numba")

SEVERAL_SIGMA = 5.0


def reflected(sample, incidence, stokes=(1.0, 0.0, 0.0, 0.0)):
    """The light that a stack of layers reflects, over all ways to and fro."""
    return sample.smooth(incidence).mueller("in", "reflected").matrix @ stokes


def test_glass_on_diamond_is_as_published():
    sample = op.Sample([(1.5, 0), (2.4, 0)])
    found = surfaces.energy(sample, "65 deg", photons=400_000)
    assert abs(found.R - 0.16024) < SEVERAL_SIGMA * found.R_se + 5e-6
    assert abs(found.scalar.R - 0.16548) < SEVERAL_SIGMA * found.scalar.R_se + 5e-6
    assert abs(found.difference.R - (0.16024 - 0.16548)) < SEVERAL_SIGMA * found.difference.R_se
    assert found.difference.R_se < 0.2 * found.R_se


def test_the_reflected_light_is_polarised_as_published():
    ends = surfaces.photon_ends(op.Sample([(1.5, 0), (2.4, 0)]), "65 deg", photons=200_000)
    s0, s1, s2, s3 = ends.stokes[ends.ends == "up"].sum(axis=0)
    assert math.hypot(s1, s2) / s0 == pytest.approx(0.766, abs=5e-3)
    assert s1 > 0.0
    assert abs(s2) < 1e-12 * s0
    assert s3 == 0.0


@pytest.mark.parametrize("incidence", [0.0, 0.9, 1.4])
@pytest.mark.parametrize(
    ("outside", "indices"),
    [
        (1.0, (1.5,)),
        (1.7, (1.2, 2.0)),
        (1.0, (1.3, 1.5, 0.2 + 3.4j)),
        (1.33, (2.4, 1.1, 1.8)),
        (1.5, (1.2, 1j)),
    ],
)
def test_stokes_vectors_are_those_of_a_stack_of_layers(outside, indices, incidence):
    sample = op.Sample([(index, 0) for index in indices], outside=outside)
    source = np.array([1.0, 0.3, -0.4, 0.5])
    ends = surfaces.photon_ends(sample, incidence, 50_000, azimuth=0.7, stokes=source, seed=2)
    light = np.where((ends.ends == "up")[:, np.newaxis], ends.stokes, 0.0)
    error = light.std(axis=0) / math.sqrt(len(light))
    apart = light.mean(axis=0) - reflected(sample, incidence, source)
    assert np.all(np.abs(apart) < SEVERAL_SIGMA * error + 1e-12)


def test_slightly_rough_is_nearly_flat():
    rough, flat = op.Sample([(1.5, 1e-3), (2.4, 1e-3)], surfaces=1), op.Sample([(1.5, 0), (2.4, 0)])
    found = surfaces.energy(rough, 1.0, photons=200_000)
    assert abs(found.R - reflected(flat, 1.0)[0]) < SEVERAL_SIGMA * found.R_se + 1e-5


def test_the_smallest_and_the_largest_samples_reflect_alike():
    heights = np.random.default_rng(0).normal(size=(16, 16))
    shares = [
        surfaces.energy(
            op.Sample([(1.5, surfaces.HeightField(size * heights, 16 * size, periodic=True))]),
            0.8,
            photons=20_000,
        ).R
        for size in (2.0**-20, 1.0, 2.0**20)
    ]
    assert shares[0] == shares[1] == shares[2]
