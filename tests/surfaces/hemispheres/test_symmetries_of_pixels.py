"""Hemispheres have the symmetries of their samples, and projections tell the same.

Statistical tests have fixed seeds, and would fail by chance once in a million of other seeds.
"""

import numpy as np
import pytest

import optipath as op

pytest.importorskip("numba")
pytest.importorskip("xarray")

SIGNS = np.outer([1.0, 1.0, -1.0, -1.0], [1.0, 1.0, -1.0, -1.0])
SILVER = op.Sample([(0.5 + 2.1j, 0.3)], cells=320, surfaces=8)
OBLONG = op.Sample([(0.5 + 2.1j, (0.3, 0.15))], cells=320, surfaces=8)


def halves(found):
    """The squares of differences between the halves of a hemisphere over those of their errors."""

    def difference(light):
        matrices = found.matrices(light)
        return matrices - SIGNS * matrices[:, ::-1]

    apart, errors = (each[0, ..., 0, :, :] for each in found.own.estimate(difference))
    lit = np.minimum(found.dataset["count"].values[0], found.dataset["count"].values[0, ::-1]) > 60
    lit[: len(lit) // 2] = False
    return (apart[lit] / np.where(errors[lit] > 0.0, errors[lit], np.inf)) ** 2


@pytest.mark.parametrize(
    ("sample", "incidence", "azimuth"),
    [
        (SILVER, "50 deg", 0.0),
        (op.Sample([(1.5, 0.3), (0.2 + 3.4j, 0.2)], cells=320, surfaces=8), "40 deg", 0.0),
        (OBLONG, "40 deg", 0.0),
        (OBLONG, "40 deg", np.pi),
    ],
)
def test_the_halves_beside_the_plane_of_incidence_are_mirror_images(sample, incidence, azimuth):
    found = op.measure(
        sample, incidence, 60_000, sensor=16, azimuth=azimuth, symmetric=False, seed=3
    )
    squares = halves(found)
    assert len(squares) > 10
    # Of errors by 7 degrees of freedom; 1.4 where nothing is the matter.
    assert 0.5 < squares.mean() < 3.0
    assert squares.max() < 80.0


def test_light_across_the_axes_of_a_sample_has_no_mirror_images():
    found = op.measure(OBLONG, "40 deg", 60_000, sensor=16, azimuth="45 deg", seed=3)
    assert not found.symmetric
    assert halves(found).mean() > 10.0


def test_means_with_mirror_images_are_what_they_say():
    plain, both = (
        op.measure(SILVER, "50 deg", 20_000, sensor=16, symmetric=symmetric)
        for symmetric in (False, True)
    )
    value = plain.mueller[0]
    expected = 0.5 * (value + SIGNS * value[:, ::-1])
    assert np.allclose(both.mueller[0], expected, rtol=1e-13, atol=1e-18)
    assert np.array_equal(both.dataset["count"], plain.dataset["count"])
    lit = plain.dataset["count"].values[0] > 100
    gain = plain.mueller[1][0, ..., 0, 0, 0][lit] / both.mueller[1][0, ..., 0, 0, 0][lit]
    assert 1.1 < np.median(gain) < 1.9


def test_light_along_the_normal_is_the_same_all_round():
    found = op.measure(SILVER, 0.0, 200_000, sensor=16)
    light, aop = found.stokes().isel(side=0, wavelength=0), found.aop().isel(side=0, wavelength=0)
    s0, s1 = light.sel(out="S0"), light.sel(out="S1")
    for array, across in ((s0, 1.0), (s1, 1.0)):
        apart = array.values - across * array.values.T
        errors = np.hypot(array.se.values, array.se.values.T)
        lit = found.dataset["count"].values[0] > 200
        assert np.mean((apart[lit & (errors > 0)] / errors[lit & (errors > 0)]) ** 2) < 1.6
    # Facets polarise along s, perpendicular to the meridional plane.
    far = (found.dataset["count"].values[0] > 200) & (found.sensor.theta > np.radians(30.0))
    assert np.all(np.abs(aop.values[far]) < 5.0 * aop.se.values[far] + np.radians(1.0))


def test_projections_put_the_same_light_into_the_same_quarters():
    one, other = (
        op.measure(
            SILVER, "50 deg", 20_000, sensor=op.surfaces.Sensor(16, projection), symmetric=False
        )
        for projection in ("equidistant", "equal-area")
    )
    quarters = [
        each.mueller[0].reshape(1, 2, 8, 2, 8, 1, 4, 4).sum(axis=(2, 4)) for each in (one, other)
    ]
    assert np.allclose(*quarters, rtol=1e-12, atol=1e-16)


def test_projections_have_the_same_brdf():
    one, other = (
        op.measure(SILVER, "50 deg", 100_000, sensor=op.surfaces.Sensor(20, projection))
        for projection in ("equidistant", "equal-area")
    )
    brdf = other.brdf().isel(side=0, wavelength=0).values.reshape(400, 4, 4)
    value, error = (each.values[0, ..., 0, :, :] for each in (one.brdf(), one.brdf().se))
    lit = (one.dataset["count"].values[0] > 300) & (one.sensor.theta < np.radians(60.0))
    there = brdf[other.sensor.place(one.sensor.directions[lit])]
    largest = np.nanmax(value[..., 0, 0])
    # Neighbouring pixels differ by some per cent.
    assert lit.sum() > 40
    assert np.abs(value[lit] - there).max() < 0.15 * largest
    assert abs(np.mean((value[lit] - there)[:, 0, 0])) < 0.01 * largest + error[lit][:, 0, 0].max()
