import numpy as np
import pytest

import optipath as op
from optipath import surfaces

pytest.importorskip("numba")

SILVER = op.Sample([(0.5 + 2.1j, 0.3)])


def test_they_are_the_photons_that_energy_counts():
    found = surfaces.photon_ends(SILVER, "40 deg", photons=20_000, seed=3)
    shares = surfaces.energy(SILVER, "40 deg", photons=20_000, seed=3)
    up = found.ends == "up"
    assert found.stokes[up, 0].sum() / 20_000 == pytest.approx(float(shares.R), rel=1e-12)
    assert found.scalar[up].sum() / 20_000 == pytest.approx(float(shares.scalar.R), rel=1e-12)


def test_frames_are_perpendicular_to_the_meridional_plane():
    found = surfaces.photon_ends(SILVER, "40 deg", photons=2000)
    across = np.cross([0.0, 0.0, 1.0], found.directions)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    assert np.allclose(found.x, across, atol=1e-9)
    assert np.allclose(np.linalg.norm(found.directions, axis=-1), 1.0, atol=1e-12)


def test_light_reflected_by_a_flat_mirror_goes_on_along_x():
    found = surfaces.photon_ends(op.Sample([(1j, 0)]), "30 deg", photons=100)
    assert np.allclose(found.directions, [0.5, 0.0, np.sqrt(0.75)], atol=1e-12)
    assert np.allclose(found.x, [0.0, 1.0, 0.0], atol=1e-12)


def test_unpolarised_light_scattered_once_has_no_circular_part():
    found = surfaces.photon_ends(SILVER, "40 deg", photons=20_000)
    assert np.all(found.stokes[found.events == 1, 3] == 0.0)
    assert np.any(found.stokes[found.events > 1, 3] != 0.0)


def test_no_light_is_polarised_by_more_than_all_of_it():
    sample = op.Sample([(1.5, 0.5), (0.5 + 2.1j, 0.7)])
    stokes = surfaces.photon_ends(sample, "70 deg", photons=20_000).stokes
    polarised = np.linalg.norm(stokes[:, 1:], axis=-1)
    assert np.all(stokes[:, 0] >= 0.0)
    assert np.all(polarised <= stokes[:, 0] * (1.0 + 1e-12))


def test_light_at_several_wavelengths_has_an_axis_for_them():
    gold = op.Sample([(op.Material.named("gold"), 0.3)])
    found = surfaces.photon_ends(gold, "40 deg", photons=50, wavelength=[450e-9, 650e-9])
    assert found.stokes.shape == (50, 2, 4)
    assert found.scalar.shape == (50, 2)


def test_too_few_photons_are_told():
    with pytest.raises(op.SurfaceError, match="photons must be a whole number of 1 or more"):
        surfaces.photon_ends(SILVER, "40 deg", photons=0)


def test_light_along_the_normal_is_in_the_frame_of_light_beside_it():
    # A flat face sends polarised light back as it was, however the sample below it lies.
    sample = op.Sample([(1.5, 0.0), (0.5 + 2.1j, (0.3, 0.15))], cells=400)
    found = surfaces.photon_ends(sample, 0.0, 200, azimuth=0.7, stokes=[1, 1, 0, 0])
    once = found.events == 1
    assert np.all(found.x[once] == [0.0, 1.0, 0.0])
    # It vibrates along (-sin 0.7, cos 0.7, 0), and y is (-1, 0, 0).
    along, across = np.cos(0.7), np.sin(0.7)
    expected = [1.0, along**2 - across**2, 2.0 * along * across, 0.0]
    np.testing.assert_allclose(found.stokes[once], [expected] * once.sum(), rtol=0, atol=1e-14)
