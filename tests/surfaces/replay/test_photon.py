"""What is known of one photon, by closed forms."""

import numpy as np
import pytest

import optipath as op
from rough_samples import drawn_sample, rough

pytest.importorskip("numba")

ANGLE = np.radians(50.0)
WAVELENGTHS = ["450 nm", "550 nm", "650 nm"]


def fresnel(n1, n2, angle):
    """The shares of s and p that are reflected, as textbooks have them."""
    c1 = np.cos(angle)
    c2 = np.sqrt(1.0 - (n1 * np.sin(angle) / n2) ** 2)
    s = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2)
    p = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2)
    return s**2, p**2


def test_a_photon_in_a_flat_film_is_that_of_a_sum_by_hand():
    """Into the film, off the mirror below it, and out again: 1 / (1 - share) for each way through.

    Without a turn, since all planes of incidence are one.
    """
    sample = op.Sample([(1.5, 0.0), (1j, 0.0)])
    photons = (sample.photon(number, ANGLE) for number in range(100))
    photon = next(each for each in photons if len(each.events) == 3)
    s, p = fresnel(1.0, 1.5, ANGLE)
    through = 1.0 - 0.5 * (s + p)
    intensities = ((1.0 - s) / through) ** 2, ((1.0 - p) / through) ** 2
    assert photon.end == "up"
    assert photon.stokes[0] == pytest.approx(0.5 * sum(intensities), rel=1e-13)
    assert photon.stokes[1] == pytest.approx(0.5 * (intensities[0] - intensities[1]), rel=1e-11)
    assert photon.stokes[2:] == pytest.approx(0.0, abs=1e-13)
    assert photon.scalar == pytest.approx(1.0, rel=1e-13)
    assert photon.weight == pytest.approx(through**-2, rel=1e-13)


def test_a_photon_that_a_flat_mirror_reflects_goes_up_as_it_came_down():
    photon = op.Sample([(1j, 0.0)]).photon(0, ANGLE)
    down, up = photon.start.z, photon.frame.z
    assert down[2] == pytest.approx(-np.cos(ANGLE))
    assert up == pytest.approx(down * [1.0, 1.0, -1.0])
    assert photon.frame.x == pytest.approx(photon.start.x)


@pytest.mark.parametrize("azimuth", ["0 deg", "130 deg"])
def test_light_comes_from_the_azimuth_that_is_given(azimuth):
    photon = op.Sample([(1.5, rough(0.3, 0.2))]).photon(0, ANGLE, azimuth=azimuth)
    a = np.radians(float(azimuth.split()[0]))
    along = [np.sin(ANGLE) * np.cos(a), np.sin(ANGLE) * np.sin(a), -np.cos(ANGLE)]
    assert photon.start.z == pytest.approx(along)
    assert photon.start.x == pytest.approx([-np.sin(a), np.cos(a), 0.0], abs=1e-15)


def test_photons_on_an_isotropic_sample_come_from_azimuths_of_their_own():
    sample = op.Sample([(1.5, rough(0.3))])
    first, second = (sample.photon(number, ANGLE).start.z for number in range(2))
    assert abs(first @ second) < 0.999


def test_the_frame_at_the_end_has_s_of_the_last_facet():
    sample, incidence = drawn_sample(3)
    for number in range(50):
        photon = sample.photon(number, incidence)
        last = photon.events[-1]
        assert photon.frame.z == pytest.approx(last.onwards, abs=1e-12)
        across = np.cross(last.normal, last.direction)
        assert photon.frame.x == pytest.approx(across / np.linalg.norm(across), abs=1e-7)


def test_several_wavelengths_ride_on_one_photon_and_its_path():
    gold = op.Material.cauchy([0.3, 0.05]).n
    base = op.Material(gold, 2.5)
    sample = op.Sample([(1.5, rough(0.3)), (base, rough(0.4, seed=1))])
    photon = sample.photon(4, ANGLE, wavelength=WAVELENGTHS)
    assert photon.stokes.shape == (3, 4)
    assert photon.path().trace().stokes == pytest.approx(photon.stokes, rel=1e-12, abs=1e-13)
    for place, wavelength in enumerate(WAVELENGTHS):
        one = photon.path(place).trace().stokes
        alone = sample.photon(4, ANGLE, wavelength=wavelength)
        assert one == pytest.approx(photon.stokes[place], rel=1e-12, abs=1e-13)
        assert np.array_equal(alone.stokes, photon.stokes[place])


@pytest.mark.parametrize("which", [3, True, slice(0, 2), "550 nm", 1.0])
def test_a_wavelength_that_is_not_there_is_refused(which):
    base = op.Material(op.Material.cauchy([0.3, 0.05]).n, 2.5)
    photon = op.Sample([(base, 0.0)]).photon(0, ANGLE, wavelength=WAVELENGTHS)
    with pytest.raises(op.SurfaceError, match=r"which is .*shape \(3,\); .* such as 2$"):
        photon.path(which)


def test_a_place_among_wavelengths_is_refused_where_there_is_one_light():
    photon = op.Sample([(1.5, 0.0)]).photon(0, ANGLE)
    with pytest.raises(op.SurfaceError, match="one light; leave it out"):
        photon.path(0)


def test_a_photon_is_printed_with_a_line_for_each_event():
    photon = op.Sample([(1.5, 0.0), (0.5 + 2.1j, 0.0)]).photon(0, ANGLE)
    lines = str(photon).splitlines()
    assert lines[0].startswith(f"Photon 0 of seed 0: {photon.end} after {len(photon.events)} event")
    assert len(lines) == 3 + len(photon.events)
    assert lines[2].split() == ["layer", "media", "incidence", "turn", "probability", "x", "y", "z"]
