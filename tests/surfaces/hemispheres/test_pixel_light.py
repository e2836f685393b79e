import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op

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


@pytest.mark.parametrize("source", [SOURCE, [1, 0, 0, 0], np.array([1.0, 0, 0, 1])])
def test_stokes_vectors_are_those_of_the_mueller_matrices(silver, source):
    found = silver.stokes(source)
    expected = np.einsum("...ij,j->...i", silver.mueller[0], np.array(source, float))
    assert np.allclose(found, expected, rtol=1e-14, atol=1e-18)
    assert found.dims == ("side", "y", "x", "wavelength", "out")
    assert found.attrs["source"].tolist() == [*map(float, source)]


def test_the_error_of_a_sum_is_not_that_of_its_parts(silver):
    # S0 and S1 of one photon go together: with x-polarised light M00 + M01 is no sum of two noises.
    light, (_, each) = silver.stokes([1, 1, 0, 0]), silver.mueller
    naive = np.hypot(each[..., 0, 0], each[..., 0, 1])
    lit = silver.dataset["count"].values[..., np.newaxis] > 100
    assert np.median(light.se.values[..., 0][lit] / naive[lit]) > 1.05
    unpolarised = silver.stokes().se.values
    assert np.allclose(unpolarised, each[..., 0], rtol=1e-9, atol=1e-20)


def test_brdf_is_light_over_solid_angle_and_cosine(glass):
    found, scalar = glass.brdf(), glass.brdf(polarized=False)
    area = (glass.dataset.solid_angle * np.cos(glass.dataset.theta)).values[..., np.newaxis]
    inside = ~np.isnan(glass.sensor.theta)
    for array, value, error in (
        (found, *glass.mueller),
        (scalar, *glass.scalar),
    ):
        over = area[..., np.newaxis, np.newaxis] if array is found else area
        assert np.allclose((array * over).values[:, inside], value[:, inside], rtol=1e-13)
        assert np.allclose((array.se * over).values[:, inside], error[:, inside], rtol=1e-9)
        assert np.isnan(array.values[:, ~inside]).all()
        assert array.units == array.se.units == "1/sr"


def test_the_brdf_of_what_has_not_been_measured_is_told():
    one = op.measure(SILVER, "40 deg", 100, sensor=8, polarized="scalar")
    assert one.brdf(polarized=False).name == "brdf"
    for ask in (one.brdf, one.stokes, one.dop, one.dolp, one.aop):
        with pytest.raises(op.SurfaceError, match="the Mueller matrix has not been measured"):
            ask()
    other = op.measure(SILVER, "40 deg", 100, sensor=8, polarized="polarized")
    with pytest.raises(op.SurfaceError, match="light without polarisation has not been measured"):
        other.brdf(polarized=False)


@pytest.mark.parametrize("source", [SOURCE, (1, 0, 0, 0)])
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


@given(
    degree=st.floats(0.0, 1.0),
    angles=st.tuples(st.floats(0.0, np.pi), st.floats(-np.pi, np.pi)),
)
@settings(max_examples=20)
def test_no_light_is_polarised_by_more_than_all_of_it(silver, degree, angles):
    latitude, longitude = angles
    level = degree * np.sin(latitude)
    state = [1.0, level * np.cos(longitude), level * np.sin(longitude), degree * np.cos(latitude)]
    matrices = silver.mueller[0]
    lit = matrices[..., 0, 0] > 0.0
    assert np.all(silver.dop(state).values[lit] <= 1.0 + 1e-12)
    assert np.all(silver.dolp(state).values[lit] <= silver.dop(state).values[lit] + 1e-12)


def test_where_no_light_falls_there_is_no_degree_and_no_angle(silver):
    dark = silver.dataset["count"].values[..., np.newaxis] == 0
    assert dark.any()
    for array in (silver.dop(), silver.dolp(), silver.aop()):
        assert np.array_equal(np.isnan(array.values), dark)
    assert np.all(silver.stokes().values[dark] == 0.0)


def test_unpolarised_light_scattered_once_has_no_circular_part_at_all():
    once = op.measure(SILVER, "40 deg", 30_000, sensor=16, events=1)
    assert np.all(once.stokes().sel(out="S3") == 0.0)
    assert np.array_equal(once.dop(), once.dolp(), equal_nan=True)
    assert np.any(op.measure(SILVER, "40 deg", 30_000, sensor=16).stokes().sel(out="S3") != 0.0)


def test_angles_next_to_a_right_angle_have_small_errors():
    # In the plane of incidence light along y stays so, but for a little noise of either sign.
    found = op.measure(SILVER, "40 deg", 30_000, sensor=17, symmetric=False)
    aop = found.aop([1.0, -1.0, 0.0, 0.0]).isel(y=8, x=slice(10, None), side=0, wavelength=0)
    bright = found.dataset["count"].values[0, 8, 10:] > 100
    angles, errors = aop.values[bright], aop.se.values[bright]
    assert bright.sum() >= 5
    assert angles.min() < 0.0 < angles.max()
    assert np.all(np.abs(angles) > np.radians(80.0))
    assert errors.max() < np.radians(5.0)


def test_angles_of_light_turned_by_a_right_angle_have_the_same_errors():
    one = op.measure(SILVER, "40 deg", 30_000, sensor=8, symmetric=False)
    numbers = one.parts.sums
    turned = numbers[..., :16].reshape(*numbers.shape[:-1], 4, 4).copy()
    turned[..., 1:3, :] *= -1.0
    sums = np.concatenate([turned.reshape(*numbers.shape[:-1], 16), numbers[..., 16:]], axis=-1)
    other = op.surfaces.Hemisphere(
        one.seen, one.parts._replace(sums=sums), one.wavelengths, symmetric=False
    )
    found, expected = other.aop(SOURCE), one.aop(SOURCE)
    assert np.allclose(found.se, expected.se, rtol=1e-6, atol=1e-12, equal_nan=True)
    apart = (found - expected).values % np.pi
    assert np.allclose(apart[~np.isnan(apart)], np.pi / 2.0, atol=1e-12)


def test_errors_go_along_with_what_is_chosen(silver):
    chosen = silver.dolp().sel(side="reflected").isel(wavelength=0)
    assert chosen.se.dims == chosen.dims == ("y", "x")
    assert {"theta", "phi", "x", "y"} <= {*chosen.coords}
    # Of a difference they would be wrong, and xarray leaves them out.
    assert "se" not in (silver.dolp() - silver.dop(SOURCE)).coords


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ([1, 1, 1, 0], "polarised by more than 100 %"),
        ([0, 0, 0, 0], "has no intensity; give S0 > 0"),
        ([-1, 0, 0, 0], "intensity"),
        ([1, 0, 0], r"must have shape \(..., 4\)"),
        ([[1, 0, 0, 0], [1, 1, 0, 0]], "give one Stokes vector"),
        ([1, np.nan, 0, 0], "finite Stokes vector"),
        (op.Light([1.0, 0, 0, 0]), "light.stokes"),
        ("unpolarised", "source"),
    ],
)
def test_what_is_no_source_is_told(silver, source, told):
    for ask in (silver.stokes, silver.dop, silver.dolp, silver.aop):
        with pytest.raises(op.SurfaceError, match=told):
            ask(source)
