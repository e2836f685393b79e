"""The analytic model beside photons that have met one facet of a surface of heights."""

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import single_scattering

SILVER, ALPHA, INCIDENCE, PHOTONS = 0.5 + 2.1j, 0.3, np.radians(40.0), 60_000
LOW, HIGH = np.radians(25.0), np.radians(65.0)


def modelled(first, last):
    """The Stokes vector of what goes into an interval of azimuths, by Gauss and Legendre."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    theta = (0.5 * (LOW + HIGH) + 0.5 * (HIGH - LOW) * nodes)[:, None]
    azimuth = 0.5 * (first + last) + 0.5 * (last - first) * nodes
    s, c = np.sin(theta), np.cos(theta) + 0.0 * azimuth
    up = np.stack([s * np.cos(azimuth), s * np.sin(azimuth), c], axis=-1)
    down = (np.sin(INCIDENCE), 0.0, -np.cos(INCIDENCE))
    stokes = single_scattering(SILVER, ALPHA, down, up).matrix[..., 0]
    shares = weights[:, None] * weights * s * c * 0.25 * (HIGH - LOW) * (last - first)
    return np.einsum("ij,ijk->k", shares, stokes)


def test_photons_that_met_one_facet_have_its_stokes_vectors():
    pytest.importorskip("numba")
    from optipath.surfaces.ends.photon_ends import photon_ends  # noqa: PLC0415 - compiled

    sample = op.Sample([(SILVER, ALPHA)], cells=400, surfaces=4)
    found = photon_ends(sample, INCIDENCE, PHOTONS, seed=1)
    once = (found.ends == "up") & (found.events == 1)
    x, y, z = found.directions.T
    inside = once & (np.cos(HIGH) < z) & (z < np.cos(LOW))
    azimuth = np.arctan2(y, x)
    for first, last in np.radians([(-70, -20), (-20, 20), (20, 70)]):
        stokes = found.stokes[inside & (first < azimuth) & (azimuth < last)]
        expected, error = modelled(first, last), np.sqrt(np.sum(stokes**2, axis=0)) / PHOTONS
        off = np.abs(np.sum(stokes, axis=0) / PHOTONS - expected)
        # One in a million by chance, and what Smith's masking and these heights differ in.
        assert np.all(off <= 5.0 * error + 0.03 * np.abs(expected) + 1e-15)
