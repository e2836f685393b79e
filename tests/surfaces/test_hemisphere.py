"""What follows from a hemisphere: light of pixels, maps of differences, a dataset, the model."""

import gc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from optipath.surfaces import single_scattering
from optipath.surfaces.smooth import smooth_exit
from tables import rows, slow

pytest.importorskip("numba")
pytest.importorskip("xarray")

SILVER = op.Sample([(0.5 + 2.1j, 0.3)], cells=200, surfaces=4)
GLASS = op.Sample([(1.5, 0.3)], cells=200, surfaces=4)
SOURCE = (2.0, 0.6, -0.8, 1.0)


@pytest.fixture(scope="module")
def silver():
    return op.measure(SILVER, "40 deg", 30_000, sensor=16, symmetric=False)


@pytest.fixture(scope="module")
def glass():
    return op.measure(GLASS, "60 deg", 30_000, sensor=16)


def test_stokes_vectors_are_those_of_the_mueller_matrices_but_for_their_errors(silver):
    value, error = silver.mueller
    for source in (SOURCE, [1, 0, 0, 0], np.array([1.0, 0, 0, 1])):
        found = silver.stokes(source)
        expected = np.einsum("...ij,j->...i", value, np.array(source, float))
        assert np.allclose(found, expected, rtol=1e-14, atol=1e-18)
        assert found.dims == ("side", "y", "x", "wavelength", "out")
        assert found.attrs["source"].tolist() == [*map(float, source)]
    # S0 and S1 of one photon go together: with x-polarised light M00 + M01 is no sum of two noises.
    light = silver.stokes([1, 1, 0, 0])
    naive = np.hypot(error[..., 0, 0], error[..., 0, 1])
    lit = silver.dataset["count"].values[..., np.newaxis] > 100
    assert np.median(light.se.values[..., 0][lit] / naive[lit]) > 1.05
    assert np.allclose(silver.stokes().se.values, error[..., 0], rtol=1e-9, atol=1e-20)


def test_brdf_is_light_over_solid_angle_and_cosine(glass):
    area = (glass.dataset.solid_angle * np.cos(glass.dataset.theta)).values[..., np.newaxis]
    inside = ~np.isnan(glass.sensor.theta)
    for array, (value, error), over in (
        (glass.brdf(), glass.mueller, area[..., np.newaxis, np.newaxis]),
        (glass.brdf(polarized=False), glass.scalar, area),
    ):
        assert np.allclose((array * over).values[:, inside], value[:, inside], rtol=1e-13)
        assert np.allclose((array.se * over).values[:, inside], error[:, inside], rtol=1e-9)
        assert np.isnan(array.values[:, ~inside]).all()
        assert array.units == array.se.units == "1/sr"
    one, other = (
        op.measure(SILVER, "40 deg", 100, sensor=8, polarized=kind)
        for kind in ("scalar", "polarized")
    )
    assert one.brdf(polarized=False).name == "brdf"
    for ask in (one.brdf, one.stokes, one.dop, one.dolp, one.aop):
        with pytest.raises(
            op.errors.SurfaceError, match="the Mueller matrix has not been measured"
        ):
            ask()
    with pytest.raises(
        op.errors.SurfaceError, match="light without polarisation has not been measured"
    ):
        other.brdf(polarized=False)


@rows("source", [SOURCE, (1, 0, 0, 0)])
def test_degrees_and_angles_are_those_of_the_stokes_vectors(silver, source):
    s0, s1, s2, s3 = np.moveaxis(silver.stokes(source).values, -1, 0)
    lit = s0 > 0.0
    s0, s1, s2, s3 = (each[lit] for each in (s0, s1, s2, s3))
    assert np.allclose(silver.dolp(source).values[lit], np.hypot(s1, s2) / s0, atol=1e-12)
    assert np.allclose(silver.dop(source).values[lit], np.sqrt(s1**2 + s2**2 + s3**2) / s0)
    aop = silver.aop(source).values[lit]
    assert np.allclose(np.exp(2j * aop), (s1 + 1j * s2) / np.hypot(s1, s2), atol=1e-7)
    assert np.all((aop > -np.pi / 2.0) & (aop <= np.pi / 2.0))
    assert (silver.aop().units, silver.dop().units, silver.dolp().units) == ("rad", "1", "1")


@given(st.floats(0.0, 1.0), st.floats(0.0, np.pi), st.floats(-np.pi, np.pi))
@settings(max_examples=20)
def test_no_light_is_polarised_by_more_than_all_of_it(silver, degree, latitude, longitude):
    level = degree * np.sin(latitude)
    state = [1.0, level * np.cos(longitude), level * np.sin(longitude), degree * np.cos(latitude)]
    lit = silver.mueller[0][..., 0, 0] > 0.0
    dop, dolp = (each.values[lit] for each in (silver.dop(state), silver.dolp(state)))
    assert np.all(dop <= 1.0 + 1e-12)
    assert np.all(dolp <= dop + 1e-12)


def test_where_no_light_falls_there_is_no_degree_and_errors_go_along_with_what_is_chosen(silver):
    dark = silver.dataset["count"].values[..., np.newaxis] == 0
    assert dark.any()
    for array in (silver.dop(), silver.dolp(), silver.aop()):
        assert np.array_equal(np.isnan(array.values), dark)
    assert np.all(silver.stokes().values[dark] == 0.0)
    chosen = silver.dolp().sel(side="reflected").isel(wavelength=0)
    assert chosen.se.dims == chosen.dims == ("y", "x")
    assert {"theta", "phi", "x", "y"} <= {*chosen.coords}
    # Of a difference they would be wrong, and xarray leaves them out.
    assert "se" not in (silver.dolp() - silver.dop(SOURCE)).coords


def test_angles_of_light_turned_by_a_right_angle_have_the_same_errors():
    # In the plane of incidence light along y stays so, but for a little noise of either sign: its
    # angles are next to a right angle, and those of light that is turned about 0.
    one = op.measure(SILVER, "40 deg", 30_000, sensor=17, symmetric=False)
    sums = one.parts.sums.copy()
    sums[..., 4:12] *= -1.0  # S1 and S2 of the Mueller matrices.
    parts = one.parts._replace(sums=sums)
    other = op.surfaces.Hemisphere(one.seen, parts, one.wavelengths, symmetric=False)
    for source in ([1.0, -1.0, 0.0, 0.0], SOURCE):
        found, expected = other.aop(source), one.aop(source)
        assert np.allclose(found.se, expected.se, rtol=1e-6, atol=1e-12, equal_nan=True)
        apart = (found - expected).values % np.pi
        assert np.allclose(apart[~np.isnan(apart)], np.pi / 2.0, atol=1e-12)
    row = {"y": 8, "x": slice(10, None), "side": 0}
    bright = one.dataset["count"].isel(row).values > 100
    aop = one.aop([1.0, -1.0, 0.0, 0.0]).isel(wavelength=0, **row)
    angles = aop.values[bright]
    assert bright.sum() >= 5
    assert angles.min() < 0.0 < angles.max()
    assert np.abs(angles).min() > np.radians(80.0)
    assert aop.se.values[bright].max() < np.radians(5.0)


@rows(
    "source, told",
    [
        ([1, 1, 1, 0], r"give S0 > 0 and S1\^2"),
        ([0, 0, 0, 0], "give S0 > 0 and"),
        ([1, 0, 0], r"must have shape \(..., 4\)"),
        ([[1, 0, 0, 0], [1, 1, 0, 0]], "give one Stokes vector"),
        ([1, np.nan, 0, 0], "finite Stokes vector"),
        (op.Light([1.0, 0, 0, 0]), "light.stokes"),
    ],
)
def test_what_is_no_source_is_told(silver, source, told):
    for ask in (silver.stokes, silver.dop, silver.dolp, silver.aop):
        with pytest.raises(op.errors.SurfaceError, match=told):
            ask(source)


def test_what_follows_comes_of_a_function_that_returns_real_numbers(glass):
    for estimate in (glass.own.estimate, lambda found: glass.estimate_toward(found, "56 deg")):
        for value in (None, 1j, True):
            with pytest.raises(
                op.errors.SurfaceError, match="let the function return real numbers"
            ):
                estimate(lambda _, value=value: value)
    assert glass.estimate_toward(lambda _: 2, "56 deg") == (2, 0.0)


def test_maps_are_of_both_and_of_enough_photons():
    for options, sentence in (
        ({"polarized": "scalar"}, "with polarized='both'"),
        ({"polarized": "polarized"}, "with polarized='both'"),
        ({}, "measure with more photons$"),
    ):
        few = op.measure(GLASS, 0.5, 100, sensor=8, **options)
        with pytest.raises(op.errors.SurfaceError, match=sentence):
            few.adm()
    # Noise that is not known masks nothing silently.
    assert np.isfinite(few.adm(noise=None)).any()


def test_everything_has_a_name_a_unit_and_the_dimensions_that_are_told():
    sample = op.Sample([(1.5, (0.3, 0.2))], cells=200, surfaces=2, description="ground")
    ground = op.measure(sample, "30 deg", 5000, sensor=8, azimuth="90 deg", seed=7)
    data, told = ground.dataset, ground.dataset.attrs
    for name in [*data, "x", "y", "wavelength", "theta", "phi"]:
        assert data[name].attrs["long_name"]
        assert data[name].attrs["units"] in ("1", "sr", "rad", "m")
    assert data.side.values.tolist() == ["reflected", "transmitted"]
    assert ground.side("transmitted") == 1
    assert data["in"].values.tolist() == data["out"].values.tolist() == ["S0", "S1", "S2", "S3"]
    assert np.isnan(data.wavelength.values).tolist() == [True]
    assert (told["incidence"], told["azimuth"]) == pytest.approx((np.pi / 6.0, np.pi / 2.0))
    assert (told["photons"], told["seed"], told["events"]) == (5000, 7, "any number")
    assert 'description = "ground"' in told["sample"]
    assert "perpendicular" in told["frame"]
    pixels = ("side", "y", "x", "wavelength")
    expected = {"mueller": (*pixels, "out", "in"), "scalar": pixels, "difference": pixels}
    expected |= {f"{name}_se": dims for name, dims in expected.items()}
    expected |= {"count": pixels[:3], "solid_angle": ("y", "x")}
    assert {name: data[name].dims for name in data} == expected
    assert data.theta.dims == data.phi.dims == ("y", "x")
    heights = op.surfaces.HeightField(np.eye(4), 4.0, periodic=True)
    data = op.measure(op.Sample([(1j, heights)]), "30 deg", 100, sensor=4).dataset
    assert "no form in TOML" in data.attrs["sample"]


PUBLISHED = {50: 0.165, 56: 0.19, 60: 0.205, 65: 0.215}
"""Simulation 1 of M. Wang et al., Optics Express 25(19), 2017: the largest ADM at each angle."""
LAYERED = op.Sample([(1.5, 0.1), (2.4, 0.1)], cells=240, surfaces=4)


PUBLISHED = {50: 0.165, 56: 0.19, 60: 0.205, 65: 0.215}
"""Simulation 1 of M. Wang et al., Optics Express 25(19), 2017: the largest ADM at each angle."""


LAYERED = op.Sample([(1.5, 0.1), (2.4, 0.1)], cells=240, surfaces=4)


@pytest.fixture(scope="module", params=[LAYERED, slow(op.load_sample("glass-on-glass"))])
def layered(request):
    return op.measure(request.param, "60 deg", 50_000, sensor=32)


@pytest.fixture(scope="module", params=[slow(640), 240])
def gold(request):
    layers, lights = op.load_sample("glass-on-gold").layers, ["450 nm", "550 nm", "650 nm"]
    sample = op.Sample(layers, cells=request.param, surfaces=16 if request.param == 640 else 4)
    return op.measure(sample, "60 deg", 50_000, lights, sensor=32)


def relative(hemisphere, side="reflected"):
    found = hemisphere.dataset.sel(side=side)
    with np.errstate(invalid="ignore", divide="ignore"):
        return (found.mueller.values[..., 0, 0] - found.scalar.values) / found.scalar.values


def expect_where_it_counts(found, expected):
    counts = ~np.isnan(found.values)
    np.testing.assert_allclose(found.values[counts], expected[counts], rtol=1e-12)
    return counts.sum()


def test_the_signed_map_is_the_difference_over_what_there_is_without_polarisation(layered):
    found = layered.relative_difference()
    assert found.dims == ("y", "x", "wavelength")
    expect_where_it_counts(found, relative(layered))
    # One wavelength has one measure; the lower hemisphere has a map of its own.
    np.testing.assert_array_equal(layered.adm(), layered.mdm())
    found = layered.adm("transmitted")
    assert found.attrs["side"] == "transmitted"
    expect_where_it_counts(found, np.abs(relative(layered, "transmitted"))[..., 0])


def test_adm_is_the_mean_over_wavelengths_and_mdm_the_largest(gold):
    sizes = np.abs(relative(gold))
    for found, expected in ((gold.adm(), sizes.mean(-1)), (gold.mdm(), sizes.max(-1))):
        assert found.dims == ("y", "x")
        assert expect_where_it_counts(found, expected) == found.attrs["pixels_left"] > 100


def test_a_mask_is_what_it_says(layered):
    found = layered.adm(brighter_than=0.5, noise=0.1, known_to=0.0)
    light = layered.dataset.scalar.sel(side="reflected").values[..., 0]
    mean = light[~np.isnan(layered.sensor.theta)].mean()
    counts = ~np.isnan(found.values)
    assert (light[counts] > 0.5 * mean).all()
    assert (found.se.values[counts] <= 0.1 * found.values[counts]).all()
    assert "above 0.5 of the mean" in found.attrs["mask"]
    assert found.attrs["largest_se"] == np.nanmax(found.se)
    assert counts.sum() < (~np.isnan(layered.adm().values)).sum()


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


def test_light_that_is_reflected_once_has_no_difference_and_no_circular_part():
    found = op.measure(op.Sample([(1.5, 0.3)]), "60 deg", 50_000, sensor=16, events=1)
    assert float(found.adm().max()) < 1e-12
    assert found.adm().attrs["pixels_left"] > 30
    once = op.measure(SILVER, "40 deg", 30_000, sensor=16, events=1)
    assert np.all(once.stokes().sel(out="S3") == 0.0)
    assert np.array_equal(once.dop(), once.dolp(), equal_nan=True)
    assert np.any(op.measure(SILVER, "40 deg", 30_000, sensor=16).stokes().sel(out="S3") != 0.0)


def test_pixels_are_told_as_the_projection_has_them():
    # Between the axes of the sensor and 1 / 32 of its radius, nearly square; polar angles
    # 2 arcsin(r / sqrt(2)), and the whole pixels of an area of 2 pi on a disc of pi.
    for projection, width, area, rel in (
        ("equidistant", 180.0 / 32, (np.pi / 32) ** 2, 3e-3),
        ("equal-area", np.degrees(2**0.5 / 16), 8 / 32**2, 1e-12),
    ):
        sensor = op.surfaces.Sensor(32, projection)
        told = op.measure(op.Sample([(1.5, 0.0)]), 0.5, sensor=sensor).adm(noise=None).attrs
        assert told["pixel_degrees_at_normal"] == pytest.approx(width, rel=1e-12)
        assert told["largest_pixel_solid_angle"] == pytest.approx(area, rel=rel)


def test_a_paired_run_needs_300_times_fewer_photons_than_two_separate_ones():
    paired, polarised, scalar = (
        op.measure(LAYERED, "60 deg", 32_768, sensor=16, seed=seed, polarized=kind)
        for seed, kind in enumerate(("both", "polarized", "scalar"))
    )
    counts = ~np.isnan(paired.relative_difference().values)
    together = paired.difference[1][0][counts]
    apart = polarised.mueller[1][0][..., 0, 0][counts], scalar.scalar[1][0][counts]
    assert 2.0 * np.square(apart).sum() / np.square(together).sum() > 300


@pytest.mark.slow
@rows("seed", [0, 1])
@rows("angle", PUBLISHED)
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


@pytest.mark.slow
@rows("angle", PUBLISHED)
@rows("at", [80, 85])
def test_simulation_1_tends_to_nearly_smooth_interfaces_off_the_lobe(angle, at):
    sample = op.load_sample("glass-on-glass")
    value, error = off_the_lobe(sample, f"{angle} deg", at)
    smooth = smooth_exit(sample, np.radians(angle), np.radians(at))
    assert smooth - 2.0 * error[0] < value[0] < 0.85 * smooth + 2.0 * error[0]


@pytest.mark.slow
def test_half_the_roughness_is_nearer_and_simulation_7_tends_to_it_where_light_is_taken_away():
    sample = op.Sample([(1.5, 0.05), (2.4, 0.05)])
    value, error = off_the_lobe(sample, "60 deg", 80)
    assert abs(value[0] - smooth_exit(sample, *np.radians([60, 80]))) < 0.01 + 2.0 * error[0]
    sample, lights = op.load_sample("wang-2017-simulation-07"), 1e-9 * np.arange(380, 501, 40)
    value, error = off_the_lobe(sample, "60 deg", 80, lights)
    smooth = smooth_exit(sample, *np.radians([60, 80]), wavelengths=lights)
    assert (smooth - 2.0 * error < value).all()
    assert (value < 0.85 * smooth + 2.0 * error).all()


# The analytic model in pixels, beside photons that have met one facet.
METAL, GOLD = 0.5 + 2.1j, 0.16 + 3.6j


def once(layer, incidence, photons=100, *, sensor=16, seed=0, **given):
    sample = op.Sample([layer], cells=given.pop("cells", 320), seed=seed, **given)
    given = {"sensor": sensor, "seed": seed, "events": 1, "polarized": "polarized"}
    return op.measure(sample, incidence, photons, **given)


def apart(found):
    """The Stokes vectors of photons less the model's, and their errors, over the largest S0.

    For an unpolarised source, further than 30 deg from grazing, and of the lit half of y.
    """
    model = found.single_scattering(points=8).values[0, ..., 0, :, 0]
    value, error = (each[0, ..., 0, :, 0] for each in found.mueller)
    there = found.sensor.theta < np.radians(60.0)
    there[: len(there) // 2] = False
    largest = model[..., 0].max()
    return (value - model)[there] / largest, error[there] / largest


@pytest.mark.parametrize(
    ("layer", "incidence"),
    [((METAL, 0.3), "40 deg"), slow(((GOLD, 0.25), "60 deg")), slow(((1.5, 0.2), "30 deg"))],
)
def test_photons_that_met_one_facet_are_as_the_model_says(layer, incidence):
    off, error = apart(once(layer, incidence, 60_000, cells=640, surfaces=8))
    assert np.all(off[..., 3] == 0.0)
    assert np.all(np.abs(off) < 6.0 * error + 5e-3)
    bright = error[:, 0] > 1e-4
    assert bright.sum() > 20
    # Of the errors of 8 parts, 0.5.
    assert 0.1 < np.median((off[bright][:, :3] / error[bright][:, :3]) ** 2) < 1.5


@pytest.mark.slow
def test_the_model_is_within_2e_3_of_the_largest_light():
    given = {"cells": 960, "surfaces": 16}
    total = once((METAL, 0.3), "40 deg", 1 << 19, seed=1000, **given)
    for seed in range(1001, 1130):
        total.parts.add(once((METAL, 0.3), "40 deg", 1 << 19, seed=seed, **given).parts)
        gc.collect()
    off, _ = apart(total)
    assert np.all(off[..., 3] == 0.0)
    assert np.abs(off).max() < 2e-3


def along(degrees):
    return np.sin(np.radians(degrees)), 0.0, -np.cos(np.radians(degrees))


@rows("projection", ["equidistant", "equal-area"])
def test_all_pixels_together_are_the_model_over_the_hemisphere(projection):
    found = once((METAL, 0.3), "40 deg", sensor=op.surfaces.Sensor(32, projection))
    nodes, weights = np.polynomial.legendre.leggauss(200)
    theta, azimuth = np.pi / 4.0 * (nodes + 1.0), np.pi * nodes
    s, c, turn = np.sin(theta)[:, None], np.cos(theta)[:, None] + 0.0 * azimuth, np.cos(azimuth)
    up = np.stack([s * turn, s * np.sin(azimuth), c], axis=-1)
    brdf = single_scattering(METAL, 0.3, along(40.0), up).matrix
    shares = np.pi**2 / 4.0 * weights[:, None] * weights * s * c
    expected = np.einsum("ij,ijkl->kl", shares, brdf)
    summed = found.single_scattering().sum(("side", "y", "x", "wavelength")).values
    assert np.allclose(summed, expected, rtol=0, atol=1e-5 * expected[0, 0])


def test_a_small_pixel_has_the_model_of_its_centre_and_more_points_change_nothing():
    found = once((GOLD, 0.3), "50 deg", sensor=64)
    model, sensor = found.single_scattering().values[0, ..., 0, :, :], found.sensor
    near = np.abs(sensor.theta - np.radians(40.0)) < np.radians(30.0)
    expected = single_scattering(GOLD, 0.3, along(50.0), sensor.directions[near]).matrix
    area = (sensor.solid_angle * np.cos(sensor.theta))[near][:, None, None]
    assert np.allclose(model[near], expected * area, rtol=0, atol=1e-2 * model.max())
    found = once((METAL, 0.3), "40 deg")
    usual, more = (
        found.single_scattering(points=points).values[0, ..., 0, :, :] for points in (6, 16)
    )
    inside, off = found.sensor.theta < np.radians(75.0), np.abs(usual - more) / usual.max()
    assert off[inside][:, 0, 0].max() < 1e-6
    # About the normal the frames of directions next to each other differ.
    assert off.max() < 1e-3


def test_arrays_of_the_model_go_with_what_has_been_measured_of_clear_bases_reflected_alone():
    for layer in ((METAL, 0.3), (1.5, 0.2)):
        found = once(layer, "40 deg", 20_000)
        model = found.single_scattering()
        beside = found.dataset.mueller - model
        assert model.dims == found.dataset.mueller.dims
        assert beside.shape == model.shape
        assert beside.side.values.tolist() == model.side.values.tolist() == ["reflected"]
        assert found.single_scattering("none").sum() > model.sum()


def test_each_wavelength_has_its_index_and_of_layers_the_topmost_is_modelled():
    gold, lengths = op.Material.named("gold"), ["450 nm", "650 nm"]
    sample, given = op.Sample([(gold, 0.3)]), {"sensor": 8, "events": 1}
    found = op.measure(sample, "40 deg", 100, lengths, **given).single_scattering()
    pairs = [
        (found.isel(wavelength=[place]), complex(sample.indices(length).base))
        for place, length in enumerate(lengths)
    ]
    layers = op.measure(op.Sample([(1.5, 0.3), (GOLD, 0.1)]), "40 deg", 100, **given)
    for model, index in (*pairs, (layers.single_scattering(), 1.5)):
        expected = once((index, 0.3), "40 deg", sensor=8).single_scattering()
        assert np.allclose(model.values, expected.values, rtol=1e-12, atol=1e-18)


@rows("incidence", ["45 deg", 0.0])
def test_a_sample_with_a_direction_is_modelled_in_the_frame_of_the_light(incidence):
    sample = op.Sample([(METAL, (0.3, 0.15))], cells=320, surfaces=8)
    found = op.measure(sample, incidence, 40_000, sensor=8, azimuth=0.7, events=1)
    model = found.single_scattering().values[0, ..., 0, :, :]
    value, error = (each[0, ..., 0, :, :] for each in found.mueller)
    largest = model[..., 0, 0].max()
    assert np.all(np.abs(value - model) < 6.0 * error + 0.01 * largest)
    assert np.abs(model[..., 0, 2]).max() > 5e-3 * largest


@rows("heights", [0.0, op.surfaces.HeightField(np.eye(3), 3.0, periodic=True)])
def test_surfaces_without_a_density_of_slopes_are_told_with_all_else(heights):
    found = op.measure(op.Sample([(METAL, heights)]), "40 deg", 100, sensor=8)
    with pytest.raises(op.errors.SurfaceError, match="no alpha above 0") as caught:
        found.single_scattering("smooth", points=0)
    assert len(caught.value.faults) == 3
