import os

import numpy as np
import pytest

import optipath as op
from optipath.surfaces.decisions.smooth_exit import smooth_exit

pytest.importorskip("numba")
pytest.importorskip("xarray")

LONG = pytest.mark.skipif("OPTIPATH_SETS" not in os.environ, reason="walks many photons")
PUBLISHED = {50: 0.165, 56: 0.19, 60: 0.205, 65: 0.215}
"""Simulation 1 of M. Wang et al., Optics Express 25(19), 2017: the largest ADM at each angle."""


@pytest.fixture(scope="module")
def glass():
    return op.measure(op.load_sample("glass-on-glass"), "60 deg", 50_000, sensor=32)


@pytest.fixture(scope="module")
def gold():
    sample, lights = op.load_sample("glass-on-gold"), ["450 nm", "550 nm", "650 nm"]
    return op.measure(sample, "60 deg", 50_000, lights, sensor=32)


def relative(hemisphere, side="reflected"):
    found = hemisphere.dataset.sel(side=side)
    polarised = found.mueller.values[..., 0, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        return (polarised - found.scalar.values) / found.scalar.values


def test_the_signed_map_is_the_difference_over_what_there_is_without_polarisation(glass):
    found = glass.relative_difference()
    counts = ~np.isnan(found.values)
    assert found.dims == ("y", "x", "wavelength")
    np.testing.assert_allclose(found.values[counts], relative(glass)[counts], rtol=1e-12)


def test_adm_is_the_mean_over_wavelengths_and_mdm_the_largest(gold):
    sizes = np.abs(relative(gold))
    for found, expected in ((gold.adm(), sizes.mean(-1)), (gold.mdm(), sizes.max(-1))):
        counts = ~np.isnan(found.values)
        assert found.dims == ("y", "x")
        assert counts.sum() == found.attrs["pixels_left"] > 100
        np.testing.assert_allclose(found.values[counts], expected[counts], rtol=1e-12)


def test_one_wavelength_has_one_measure(glass):
    np.testing.assert_array_equal(glass.adm(), glass.mdm())


def test_a_mask_is_what_it_says(glass):
    found = glass.adm(brighter_than=0.5, noise=0.1, known_to=0.0)
    light = glass.dataset.scalar.sel(side="reflected").values[..., 0]
    mean = light[~np.isnan(glass.sensor.theta)].mean()
    counts = ~np.isnan(found.values)
    assert (light[counts] > 0.5 * mean).all()
    assert (found.se.values[counts] <= 0.1 * found.values[counts]).all()
    assert "above 0.5 of the mean" in found.attrs["mask"]
    assert found.attrs["largest_se"] == np.nanmax(found.se)
    assert counts.sum() < (~np.isnan(glass.adm().values)).sum()


def test_standard_errors_are_those_of_other_seeds():
    sample = op.Sample([(1.5, 0.3), (2.4, 0.3)], cells=200)
    several = [
        op.measure(sample, "60 deg", 16_384, sensor=8, seed=seed).adm(noise=None)
        for seed in range(12)
    ]
    counts = np.isfinite(np.stack([each.values for each in several])).all(axis=0)
    spread = np.std([each.values[counts] for each in several], axis=0, ddof=1)
    error = np.sqrt(np.mean([each.se.values[counts] ** 2 for each in several], axis=0))
    assert counts.sum() > 15
    assert 0.7 < np.sqrt((spread**2).sum() / (error**2).sum()) < 1.4


def test_light_that_is_reflected_once_has_no_difference():
    found = op.measure(op.Sample([(1.5, 0.3)]), "60 deg", 50_000, sensor=16, events=1)
    assert float(found.adm().max()) < 1e-12
    assert found.adm().attrs["pixels_left"] > 30


@pytest.mark.parametrize(
    ("projection", "width", "area"),
    # Polar angles 2 arcsin(r / sqrt(2)); the whole pixels of an area of 2 pi on a disc of pi.
    [("equidistant", 180.0 / 32, None), ("equal-area", np.degrees(2**0.5 / 16), 8 / 32**2)],
)
def test_pixels_are_told_as_the_projection_has_them(projection, width, area):
    sensor = op.surfaces.Sensor(32, projection)
    told = op.measure(op.Sample([(1.5, 0.0)]), 0.5, sensor=sensor).adm(noise=None).attrs
    assert told["pixel_degrees_at_normal"] == pytest.approx(width, rel=1e-12)
    # Between the axes of the sensor and 1 / 32 of its radius, nearly square.
    nearly = pytest.approx(np.radians(width) ** 2, rel=3e-3)
    assert told["largest_pixel_solid_angle"] == (pytest.approx(area, rel=1e-12) if area else nearly)


def test_the_lower_hemisphere_has_a_map_of_its_own(glass):
    found = glass.adm("transmitted")
    counts = ~np.isnan(found.values)
    assert found.attrs["side"] == "transmitted"
    expected = np.abs(relative(glass, "transmitted"))[..., 0]
    np.testing.assert_allclose(found.values[counts], expected[counts], rtol=1e-12)


@pytest.mark.parametrize("kind", ["scalar", "polarized"])
def test_what_was_not_measured_is_told(kind):
    found = op.measure(op.Sample([(1.5, 0.3)]), 0.5, 1000, sensor=8, polarized=kind)
    with pytest.raises(op.SurfaceError, match="measure with polarized='both'"):
        found.adm()


def test_noise_that_is_not_known_masks_nothing_silently():
    found = op.measure(op.Sample([(1.5, 0.3)]), 0.5, 100, sensor=8)
    with pytest.raises(op.SurfaceError, match="measure with more photons, or give noise=None"):
        found.adm()
    assert np.isfinite(found.adm(noise=None)).any()


def test_a_paired_run_needs_300_times_fewer_photons_than_two_separate_ones():
    sample, given = op.load_sample("glass-on-glass"), {"photons": 32_768, "sensor": 16}
    paired = op.measure(sample, "60 deg", seed=0, **given)
    polarised = op.measure(sample, "60 deg", seed=1, polarized="polarized", **given)
    scalar = op.measure(sample, "60 deg", seed=2, polarized="scalar", **given)
    counts = ~np.isnan(paired.relative_difference().values)
    together = paired.difference[1][0][counts]
    apart = polarised.mueller[1][0][..., 0, 0][counts], scalar.scalar[1][0][counts]
    assert 2.0 * np.square(apart).sum() / np.square(together).sum() > 300


@LONG
@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("angle", PUBLISHED)
def test_simulation_1_has_the_published_differences(angle, seed):
    found = op.measure(op.load_sample("glass-on-glass"), f"{angle} deg", seed=seed).adm()
    largest = found[found.argmax(dim=["y", "x"])]
    assert abs(float(largest) - PUBLISHED[angle]) < 0.015 + 2.0 * float(largest.se)


def off_the_lobe(sample, incidence, at, wavelengths=None):
    """(S0 - U) / U some degrees beside the plane, where no facet on top reflects: value, error."""
    found = op.measure(sample, incidence, wavelengths=wavelengths)
    theta, phi = np.degrees(found.sensor.theta), np.abs(np.degrees(found.sensor.phi))
    beside = (np.abs(theta - at) < 1.5) & (phi > 9.0) & (phi < 12.0)

    def change(light):
        within = light[0][beside].sum(axis=0)
        return within[..., 0] / within[..., 16] - 1.0

    return found.own.estimate(change)


@LONG
@pytest.mark.parametrize("angle", PUBLISHED)
@pytest.mark.parametrize("at", [80, 85])
def test_simulation_1_tends_to_nearly_smooth_interfaces_off_the_lobe(angle, at):
    sample = op.load_sample("glass-on-glass")
    value, error = off_the_lobe(sample, f"{angle} deg", at)
    smooth = smooth_exit(sample, f"{angle} deg", f"{at} deg")
    assert smooth - 2.0 * error[0] < value[0] < 0.85 * smooth + 2.0 * error[0]


@LONG
def test_half_the_roughness_is_nearer_to_nearly_smooth_interfaces():
    sample = op.Sample([(1.5, 0.05), (2.4, 0.05)])
    value, error = off_the_lobe(sample, "60 deg", 80)
    assert abs(value[0] - smooth_exit(sample, "60 deg", "80 deg")) < 0.01 + 2.0 * error[0]


@LONG
def test_simulation_7_tends_to_it_where_polarisation_takes_light_away():
    sample, lights = op.load_sample("wang-2017-simulation-07"), 1e-9 * np.arange(380, 501, 40)
    value, error = off_the_lobe(sample, "60 deg", 80, lights)
    smooth = smooth_exit(sample, "60 deg", "80 deg", wavelengths=lights)
    assert (smooth - 2.0 * error < value).all()
    assert (value < 0.85 * smooth + 2.0 * error).all()
