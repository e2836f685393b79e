"""Photons keep the symmetries of the surfaces that they walk over.

Statistical tests have fixed seeds, and would fail by chance once in a million of other seeds.
"""

import math

import numpy as np
import pytest

import optipath as op
from optipath import surfaces

pytest.importorskip("numba")

SEVERAL_SIGMA = 5.5
PHOTONS = 100_000
SAME = np.eye(2)
HEIGHTS = np.random.default_rng(5).normal(size=(12, 9))


def walked(heights, azimuth, *, seed, stokes=(1.0, 0.5, 0.3, 0.4), index=0.5 + 2.1j):
    """Light that goes up, and where it goes."""
    size = np.array(heights.shape[::-1]) * 1.5
    field = surfaces.HeightField(heights, tuple(size), periodic=True)
    return surfaces.photon_ends(
        op.Sample([(index, field)]), 0.9, PHOTONS, azimuth=azimuth, stokes=stokes, seed=seed
    )


def moments(ends, turn=SAME, signs=(1.0, 1.0, 1.0, 1.0)):
    """Means of Stokes vectors, alone and by direction, and their errors."""
    light = np.where((ends.ends == "up")[:, np.newaxis], ends.stokes * signs, 0.0)
    along = ends.directions[:, :2] @ np.transpose(turn)
    found = light[:, :, np.newaxis] * np.column_stack([np.ones(PHOTONS), along])[:, np.newaxis]
    return found.mean(axis=0), found.var(axis=0) / PHOTONS


def expect_same(one, other):
    (first, its), (second, others) = one, other
    assert np.all(np.abs(first - second) < SEVERAL_SIGMA * np.sqrt(its + others) + 1e-12)


@pytest.mark.parametrize("index", [1.5, 0.5 + 2.1j])
def test_a_surface_turned_over_with_the_light_turns_the_result(index):
    one = walked(HEIGHTS, 0.4, seed=1, index=index)
    other = walked(HEIGHTS[::-1, ::-1], 0.4 + math.pi, seed=2, index=index)
    expect_same(moments(one), moments(other, turn=-np.eye(2)))


@pytest.mark.parametrize("index", [1.5, 0.5 + 2.1j])
def test_a_mirrored_surface_mirrors_the_result(index):
    mirror, signs = np.array([[0.0, 1.0], [1.0, 0.0]]), np.array([1.0, 1.0, -1.0, -1.0])
    source = np.array([1.0, 0.5, 0.3, 0.4])
    one = walked(HEIGHTS, 0.4, seed=1, stokes=source, index=index)
    other = walked(HEIGHTS.T, math.pi / 2 - 0.4, seed=2, stokes=signs * source, index=index)
    expect_same(moments(one), moments(other, mirror, signs))


def test_turning_an_anisotropic_sample_and_the_light_changes_nothing():
    one, other = (
        surfaces.energy(
            op.Sample([(0.5 + 2.1j, alpha)], cells=(400, 400), surfaces=4),
            "60 deg",
            photons=4 * 16384,
            azimuth=azimuth,
            seed=seed,
        )
        for alpha, azimuth, seed in (((0.3, 0.1), 0.5, 0), ((0.1, 0.3), 0.5 + math.pi / 2, 1))
    )
    for name in ("R_s", "R_m", "R"):
        error = math.hypot(getattr(one, f"{name}_se"), getattr(other, f"{name}_se"))
        assert abs(getattr(one, name) - getattr(other, name)) < SEVERAL_SIGMA * error
    crossed = surfaces.energy(
        op.Sample([(0.5 + 2.1j, (0.1, 0.3))], cells=(400, 400), surfaces=4),
        "60 deg",
        photons=4 * 16384,
        azimuth=0.5,
    )
    assert abs(crossed.R_m - one.R_m) > SEVERAL_SIGMA * crossed.R_m_se


def test_what_goes_from_here_to_there_goes_from_there_to_here():
    # Helmholtz's reciprocity, by all that goes into rings of 6 degrees.
    sample = op.Sample([(1.5, 0.3), (0.2 + 3.4j, 0.3)], cells=200, surfaces=1)
    here, there = math.radians(25), math.radians(50)
    (one, its), (other, others) = ring(sample, here, there), ring(sample, there, here)
    assert its < 0.02 * one
    assert abs(one - other) < SEVERAL_SIGMA * math.hypot(its, others)


def ring(sample, incidence, at):
    """The radiance about an angle of light that comes at another, and its error."""
    ends = surfaces.photon_ends(sample, incidence, PHOTONS)
    angles, half = np.arccos(np.clip(ends.directions[:, 2], -1.0, 1.0)), math.radians(3)
    light = np.where(np.abs(angles - at) < half, ends.stokes[:, 0], 0.0)
    projected = math.pi * (math.sin(at + half) ** 2 - math.sin(at - half) ** 2)
    return light.mean() / projected, light.std() / math.sqrt(PHOTONS) / projected
