"""Photons on flat samples go into one pixel, by matrices that are known in closed form."""

import numpy as np
import pytest

import optipath as op

pytest.importorskip("numba")
pytest.importorskip("xarray")

# Without it, no photon is walked over what is flat.
WALKED = {"most_events": 999}


def reflected(index, cos):
    """Fresnel's matrix of reflection, in the frame of s and p."""
    g = np.sqrt(index**2 - 1.0 + cos**2 + 0j)
    r_s, r_p = (cos - g) / (cos + g), (index**2 * cos - g) / (index**2 * cos + g)
    a, b = (abs(r_s) ** 2 + abs(r_p) ** 2) / 2.0, (abs(r_s) ** 2 - abs(r_p) ** 2) / 2.0
    c = r_s * np.conj(r_p)
    return np.array([[a, b, 0, 0], [b, a, 0, 0], [0, 0, c.real, c.imag], [0, 0, -c.imag, c.real]])


def lit_pixel(found, side=0):
    places = np.argwhere(found.dataset["count"].values[side] > 0)
    assert len(places) == 1
    row, column = places[0]
    return row, column, found.mueller[0][side, row, column, 0]


@pytest.mark.parametrize("index", [0.5 + 2.1j, 0.2 + 3.4j, 1j])
@pytest.mark.parametrize("incidence", [10.0, 47.0, 80.0])
def test_opaque_ones_reflect_by_fresnels_matrix(index, incidence):
    found = op.measure(op.Sample([(index, 0.0)]), f"{incidence} deg", 1000, sensor=33, **WALKED)
    row, column, matrix = lit_pixel(found)
    assert (row, column) == (16, int((incidence / 90.0 + 1.0) * 33 / 2.0))
    assert np.allclose(matrix, reflected(index, np.cos(np.radians(incidence))), atol=1e-13)
    assert np.all(found.mueller[1] < 1e-14)


def test_light_along_the_normal_keeps_its_frame():
    found = op.measure(op.Sample([(0.5 + 2.1j, 0.0)]), 0.0, 1000, sensor=33, **WALKED)
    row, column, matrix = lit_pixel(found)
    assert (row, column) == (16, 16)
    share = abs((0.5 + 2.1j - 1.0) / (0.5 + 2.1j + 1.0)) ** 2
    # y turns over with the direction: S2 and S3 change their signs.
    assert np.allclose(matrix, share * np.diag([1.0, 1.0, -1.0, -1.0]), atol=1e-13)


def test_glass_lets_light_through_into_one_pixel():
    found = op.measure(op.Sample([(1.5, 0.0)]), "50 deg", 60_000, sensor=33, **WALKED)
    _, _, matrix = lit_pixel(found)
    row, column, through = lit_pixel(found, side=1)
    cos = np.cos(np.radians(50.0))
    mirror = reflected(1.5, cos)
    below = np.degrees(np.arcsin(np.sin(np.radians(50.0)) / 1.5))
    assert (row, column) == (16, int((below / 90.0 + 1.0) * 33 / 2.0))
    # T = 1 - F of s and p; between them the square root of the product.
    share, apart = mirror[0, 0], mirror[0, 1]
    t_s, t_p = 1.0 - share - apart, 1.0 - share + apart
    a, b, c = (t_s + t_p) / 2.0, (t_s - t_p) / 2.0, np.sqrt(t_s * t_p)
    expected = np.array([[a, b, 0, 0], [b, a, 0, 0], [0, 0, c, 0], [0, 0, 0, c]])
    for value, closed in ((matrix, mirror), (through, expected)):
        assert np.allclose(value / value[0, 0], closed / closed[0, 0], atol=1e-12)
        error = np.sqrt(share * (1.0 - share) / 60_000)
        assert abs(value[0, 0] - closed[0, 0]) < 5.0 * error
    light = found.dolp().values[0][found.dataset["count"].values[0] > 0]
    assert light == pytest.approx(apart / share, rel=1e-12)


def test_brewsters_angle_has_all_light_polarised_along_s():
    found = op.measure(op.Sample([(1.5, 0.0)]), float(np.arctan(1.5)), 20_000, sensor=33, **WALKED)
    row, column, _ = lit_pixel(found)
    assert found.dolp().values[0, row, column, 0] == pytest.approx(1.0, abs=1e-12)
    assert found.aop().values[0, row, column, 0] == pytest.approx(0.0, abs=1e-12)
