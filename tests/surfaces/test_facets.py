"""The analytic single-scattering model, beside 50 digits, elements, known integrals and photons."""

import itertools
import math
from operator import add, sub

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from exact_facets import exact_scattering
from optipath.surfaces import single_scattering
from optipath.surfaces.facet_model import frame_along
from tables import rows

INDICES = [1.5, 0.5 + 2.1j, 1j, 2.4]
MASKINGS = ["smith", "separate", "none"]
MIRRORED = np.diag([1.0, 1.0, -1.0, -1.0])
angles, azimuths = st.floats(0.0, 1.57), st.floats(-math.pi, math.pi)
alphas, indices = st.floats(0.02, 3.0), st.sampled_from(INDICES)


def direction(theta, azimuth=0.0, sign=1.0):
    s = np.sin(theta)
    parts = np.broadcast_arrays(s * np.cos(azimuth), s * np.sin(azimuth), sign * np.cos(theta))
    return np.stack(parts, axis=-1)


def down(theta, azimuth=0.0):
    return direction(theta, azimuth, -1.0)


def reflected(k_in, slope_x, slope_y):
    """The direction that a facet of these slopes sends light to, the facet's normal, its cosine."""
    h = np.stack(np.broadcast_arrays(-slope_x, -slope_y, 1.0), axis=-1)
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    cos = -(h @ k_in)
    return k_in + 2.0 * cos[..., None] * h, h, cos


def albedo(index, alpha, theta, masking="smith", count=60):
    """What is reflected of unpolarised light: the integral of the model over all slopes."""
    nodes, weights = np.polynomial.hermite.hermgauss(count)
    x, y = np.meshgrid(alpha * nodes, alpha * nodes)
    weight = np.outer(weights, weights) * np.exp((x * x + y * y) / alpha**2) * alpha**2
    out, h, cos = reflected(down(theta), x, y)
    up = (out[..., 2] > 1e-12) & (cos > 0.0)
    brdf = single_scattering(index, alpha, down(theta), out[up], masking=masking).matrix
    solid_angle = 4.0 * cos[up] * h[up][:, 2] ** 3
    return np.sum(brdf[:, 0, 0] * out[up][:, 2] * solid_angle * weight[up])


def off(index, alphas_, k_in, k_out, masking, outside=1.0):
    """By how much the matrix is off what 50 digits give, over its M00; None where that is 0."""
    exact, exponent = exact_scattering(index, alphas_, k_in, k_out, masking, outside)
    if exact[0, 0] <= 1e-280:
        return None
    given = {"alpha_y": alphas_[1], "masking": masking, "outside": outside}
    found = single_scattering(index, alphas_[0], k_in, k_out, **given).matrix
    apart = np.max(np.abs(found - np.array(exact.tolist(), float))) / float(exact[0, 0])
    return apart / (1.0 + float(exponent))


@rows("masking", MASKINGS)
@rows("index", INDICES)
def test_the_matrix_is_that_of_fifty_digits(index, masking, rng):
    for _ in range(10):
        theta_in, theta_out = np.arccos(rng.uniform(0.001, 1.0, 2))
        azimuth_in, azimuth_out = rng.uniform(0.0, 7.0, 2)
        k_in, k_out = down(theta_in, azimuth_in), direction(theta_out, azimuth_out)
        found = off(index, 10.0 ** rng.uniform(-1.0, 0.5, 2), k_in, k_out, masking, 1.1)
        assert found is None or found <= 4e-15


# Straight back; the worst that climbing over indices, roughnesses and directions found; and next to
# grazing incidence, where masking has its limit: cos Lambda is alpha / (2 sqrt(pi)).
STEEP = (0.4830447291197731, 0.8755956770505465, -2.039452340618094e-10)
STEEP_OUT = (0.46598802689042607, 0.8446776812536203, 0.2633909140171219)
FLAT = (-0.9821213004888775, 0.18824917297570296, -1.0577245450755998e-10)
FLAT_OUT = (-0.9821213007179435, 0.18824917178061204, 9.31715250389731e-08)


@rows(
    "index, rough, k_in, k_out, masking",
    [
        (1.5, (0.2, 3.0), (0.6, 0.0, -0.8), (-0.6, 0.0, 0.8), "smith"),
        (2.4, (2.20388839, 1.37425173), STEEP, STEEP_OUT, "separate"),
        (0.5 + 2.1j, (0.07168924, 0.27068455), FLAT, FLAT_OUT, "none"),
        (1j, (0.5, 0.5), (1.0, 0.0, -1e-9), (np.sin(np.pi / 4), 0.0, np.cos(np.pi / 4)), "smith"),
    ],
)
def test_the_worst_found_has_its_digits(index, rough, k_in, k_out, masking):
    assert off(index, rough, k_in, k_out, masking) <= 2e-15


def test_an_element_on_the_facet_does_the_same_to_light():
    k_in, k_out = down(0.8, 0.3), direction(0.5, 1.9)
    h = k_out - k_in
    meets = op.plane_of_incidence(k_in, h)
    light = op.Light(np.array([1.0, 0.3, -0.5, 0.2]), frame=meets.arriving.turned(0.4))
    facet = op.Interface(0.5 + 2.1j, meets.incidence).mueller()
    facet = op.Mueller(facet.matrix, meets.arriving, meets.reflected)
    brdf = single_scattering(0.5 + 2.1j, 0.3, k_in, k_out, masking="none")
    n = h / np.linalg.norm(h)
    density = np.exp(-(n[0] ** 2 + n[1] ** 2) / n[2] ** 2 / 0.09) / (np.pi * 0.09) / n[2] ** 4
    expected = (facet @ light).in_frame(brdf.frame_out).stokes * density
    expected = expected / (4.0 * -k_in[2] * k_out[2])
    np.testing.assert_allclose((brdf @ light).stokes, expected, rtol=1e-13)


def test_x_is_across_the_meridional_plane_and_y_of_the_surface_along_its_normal():
    k_in, k_out = [down(0.0), down(0.5, 1.0)], [direction(0.0), direction(1.2)]
    brdf = single_scattering(1.5, 0.3, k_in, k_out)
    x = [[0, 1, 0], [-math.sin(1.0), math.cos(1.0), 0]]
    np.testing.assert_allclose(brdf.frame_in.x, x, atol=1e-16)
    np.testing.assert_array_equal(brdf.frame_out.x, [[0, 1, 0], [0, 1, 0]])
    np.testing.assert_allclose(brdf.frame_in.z[1], k_in[1], rtol=1e-16)
    z = np.array([[0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [0.48, 0.36, 0.8]])
    frame = frame_along("outgoing", z, up=True)
    x = np.cross((0.0, 0.0, 1.0), z)
    np.testing.assert_allclose(frame.x, x / np.linalg.norm(x, axis=-1, keepdims=True), atol=1e-16)
    np.testing.assert_allclose(frame.y, np.cross(z, frame.x), atol=1e-16)
    # Along the normal as beside it towards x.
    for beside, (up, z) in itertools.product((1e-9, 1e-100, 5e-324, 0.0), ((True, 1), (False, -1))):
        frame = frame_along("k", (beside, 0.0, z), up=up)
        np.testing.assert_array_equal(frame.x, (0.0, 1.0, 0.0))
    # A unit vector keeps its digits, and one of single precision becomes one.
    k = (0.48, 0.36, 0.8)
    np.testing.assert_array_equal(frame_along("k", k, up=True).z, k)
    single = frame_along("k", np.array([0.1, 0.2, 0.9746794], np.float32), up=True)
    assert (np.linalg.norm(single.z), single.rounding) == (pytest.approx(1.0, rel=1e-15), 2.0**-23)


def apart_by(there):
    """What rounding of the exponent of a BRDF may take, over 1e-14."""
    return 1e-14 * there[0, 0] * (1.0 + abs(math.log(there[0, 0] + 1e-300)))


@given(angles, angles, azimuths, azimuths, alphas, alphas, indices)
def test_no_light_becomes_circular_and_light_that_goes_back_meets_the_reciprocal_matrix(
    ti, to, a, b, alpha, alpha_y, index
):
    k_in, k_out = down(ti, a), direction(to, b)
    there = single_scattering(index, alpha, k_in, k_out, alpha_y=alpha_y)
    assert np.all(np.isfinite(there.matrix))
    assert (there.matrix[3, 0], there.matrix[0, 3]) == (0.0, 0.0)
    if min(ti, to) >= 1e-3:
        back = single_scattering(index, alpha, -k_out, -k_in, alpha_y=alpha_y).matrix
        # The axes x are opposite to those of the mirrored frames, but for light along the normal.
        atol = apart_by(there.matrix) + 1e-300
        np.testing.assert_allclose(back, there.reversed().matrix, atol=atol)


@given(angles, angles, azimuths, azimuths, alphas, indices)
def test_the_plane_of_incidence_is_a_mirror_and_an_isotropic_surface_may_be_turned(
    ti, to, azimuth, turn, alpha, index
):
    there = single_scattering(index, alpha, down(ti), direction(to, azimuth)).matrix
    mirrored = single_scattering(index, alpha, down(ti), direction(to, -azimuth)).matrix
    np.testing.assert_array_equal(mirrored, MIRRORED @ there @ MIRRORED)
    if min(ti, to) >= 1e-3:
        turned = single_scattering(index, alpha, down(ti, turn), direction(to, azimuth + turn))
        atol = apart_by(there) / min(ti, to) + 1e-300
        np.testing.assert_allclose(turned.matrix, there, atol=atol)


def test_projected_areas_of_all_facets_are_one():
    # Light that goes straight back is reflected by the facet across it.
    nodes, weights = np.polynomial.hermite.hermgauss(20)
    for alpha in (0.05, 0.3, 1.0, 2.0):
        x, y = np.meshgrid(alpha * nodes, alpha * nodes)
        _, h, _ = reflected(down(0.0), x, y)
        brdf = single_scattering(1j, alpha, -h, h, masking="none").matrix[..., 0, 0]
        weight = np.outer(weights, weights) * np.exp((x * x + y * y) / alpha**2) * alpha**2
        areas = brdf * 4.0 * h[..., 2] ** 6 * weight
        assert np.sum(areas) == pytest.approx(1.0, rel=1e-13)


@rows("theta", [0.0, 0.5, 1.2, 1.5])
@rows("alpha", [0.1, 0.5, 1.0])
def test_what_is_seen_of_facets_is_what_the_surface_covers(alpha, theta):
    # The weak white furnace: masked along one direction alone, facets send all light on.
    k_in = down(theta)
    none, masked = (
        single_scattering(1j, alpha, k_in, direction(0.0), masking=masking).matrix[0, 0]
        for masking in ("none", "separate")
    )
    x = np.linspace(-8.0 * alpha, min(8.0 * alpha, 1.0 / np.tan(theta + 1e-300)), 4001)
    _, h, cos = reflected(k_in, -x, 0.0)
    density = np.exp(-((x / alpha) ** 2)) / (alpha * np.sqrt(np.pi))
    area = np.trapezoid(density * cos / h[:, 2], x)
    assert masked / none * area / np.cos(theta) == pytest.approx(1.0, rel=1e-5)


def test_a_perfect_reflector_sends_back_no_more_than_comes_and_a_flat_one_what_an_interface_does():
    for alpha, theta in itertools.product((0.1, 0.5, 1.0), (0.0, 0.7, 1.2, 1.5)):
        smith, separate = (albedo(1j, alpha, theta, masking) for masking in MASKINGS[:2])
        assert 0.3 < separate <= smith <= 1.0
    for theta in (0.0, 0.7, 1.3):
        flat = op.Interface(1.5, theta).mueller().matrix[0, 0]
        assert albedo(1.5, 1e-4, theta, count=8) == pytest.approx(flat, rel=2e-7)


@rows("masking", MASKINGS)
def test_every_number_is_finite_on_the_open_hemisphere(masking):
    near = np.geomspace(3e-16, 1e-3, 7)
    theta = np.concatenate([[0.0], near, np.linspace(0.1, 1.5, 5), np.pi / 2 - near])
    azimuth = np.array([0.0, 1e-16, 1e-8, 1.0, np.pi / 2, np.pi])
    k_in = np.concatenate([down(theta), [(1.0, 0.0, -3e-16)]])[:, None, None]
    index, k_out = np.array([1.5, 1j])[:, None, None, None], direction(theta[:, None], azimuth)
    matrix = single_scattering(index, 0.3, k_in, k_out, alpha_y=0.5, masking=masking).matrix
    assert np.all(np.isfinite(matrix))
    assert np.all(matrix[..., 0, 0] >= 0.0)
    # Light that goes straight back keeps its linear polarisation.
    k = down(np.array([0.0, 1e-9, 0.5, 1.5]), 0.3)
    for matrix in single_scattering(1.5, 1.0, k, -k).matrix:
        np.testing.assert_allclose(matrix / matrix[0, 0], MIRRORED, rtol=1e-14, atol=1e-15)


def test_directions_indices_and_roughnesses_broadcast():
    metal, rough = op.Material([0.5, 0.2, 0.1], 2.0), np.array([0.1, 0.2])[:, None]
    several = single_scattering(metal, rough, down(0.5), direction(np.ones((4, 1, 1))))
    assert several.shape == (4, 2, 3)
    one = single_scattering(0.2 + 2.0j, 0.1, down(0.5), direction(1.0))
    np.testing.assert_array_equal(several[2, 0, 1].matrix, one.matrix)
    assert several[2, 0, 1].frame_out == one.frame_out
    # A material is asked for its index at the wavelength.
    glass, ways = op.Material.cauchy([1.5, 0.004]), (down(0.5), direction(0.5))
    found = single_scattering(glass, 0.3, *ways, wavelength="500 nm")
    same = single_scattering(1.516, 0.3, *ways)
    np.testing.assert_allclose(found.matrix, same.matrix, rtol=1e-13)


def test_slopes_by_index_and_roughness_are_those_of_fifty_digits(jax):
    k_in, k_out = down(0.8, 0.2), direction(0.4, 1.5)

    def figure(index, alpha, alpha_y):
        return single_scattering(index, alpha, k_in, k_out, alpha_y=alpha_y).matrix[2, 1]

    def exact(*values):
        return exact_scattering(values[0], values[1:], k_in, k_out)[0][2, 1]

    values, step = (1.5, 0.3, 0.6), mp.mpf("1e-14")
    found = jax.jit(jax.grad(figure, (0, 1, 2)))(*values)
    with mp.workdps(50):
        steps = [[step * (i == j) for j in range(3)] for i in range(3)]
        expected = [
            float((exact(*map(add, values, by)) - exact(*map(sub, values, by))) / (2 * step))
            for by in steps
        ]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


@pytest.mark.slow
def test_slopes_are_finite_at_the_limits_and_what_is_not_allowed_is_no_number(jax, jacobian):
    k_in = np.array([down(0.0), down(0.6), down(1.5707)])
    k_out = np.array([direction(0.0), -down(0.6), direction(1.5707)])

    def figures(index, alpha):
        return single_scattering(index, alpha, k_in, k_out).matrix

    slopes = jacobian(figures, argnums=(0, 1))
    assert np.all(np.isfinite([slopes(1.5, 0.3), slopes(1.0, 0.3)]))
    matrix = jax.jit(lambda a: single_scattering(1.5, a, down(0.5), direction(0.5)).matrix)
    assert np.all(np.isnan(matrix(0.0)[:3, :3]))


@rows(
    "wrong, sentence",
    [
        (
            {"alpha": 0.0},
            "alpha is 0; give a real alpha above 0 within 1e-12 .. 1000000",
        ),
        ({"alpha_y": [0.3, -1.0, 2.0]}, "alpha_y is -1 at 1; give a real alpha above 0"),
        ({"alpha": op.Parameter("a")}, "alpha follows from the parameter 'a'"),
        ({"index": -1.5}, "index is -1.5; give an index of refraction n + ik"),
        ({"index": op.Material(op.Parameter("n"))}, "index follows from the parameter 'n'"),
        ({"index": op.Material.cauchy([1.5, 0.004])}, "index depends on the wavelength; give one"),
        ({"outside": 1.5 + 0.1j}, "outside is complex"),
        ({"wavelength": "500 nm"}, "no medium depends on it"),
        ({"masking": "smiht"}, "did you mean 'smith'?"),
        ({"incoming": direction(0.5)}, "incoming has z = 0.877583; it is the direction in which"),
        ({"outgoing": [direction(0.5), down(0.5)]}, "outgoing at 1 has z = -0.877583"),
        (
            {"outgoing": (0.6, 0.0, 0.8000001)},
            "outgoing is no unit vector; divide it by its length",
        ),
        ({"incoming": (0.0, 0.0, -1e10)}, "incoming is no unit vector"),
        (
            {"incoming": down(np.pi / 2)},
            "is the direction in which light travels down to the surface",
        ),
        ({"outgoing": (0.0, np.nan, 1.0)}, "outgoing must be finite"),
        ({"alpha": np.ones(3), "outgoing": [direction(0.5)] * 2}, "arrays do not broadcast"),
    ],
)
def test_what_is_wrong_is_told_and_all_of_it_at_once(wrong, sentence):
    right = {"index": 1.5, "alpha": 0.3, "incoming": down(0.5), "outgoing": direction(0.5)}
    with pytest.raises(op.errors.SurfaceError) as told:
        single_scattering(**right | wrong)
    assert len(told.value.faults) == 1
    assert sentence in str(told.value)
    with pytest.raises(op.errors.SurfaceError, match="5 faults"):
        single_scattering(-1.0, 0.0, direction(0.5), down(0.5), masking="no")


def test_it_is_cooks_and_torrances_for_unpolarised_light():
    theta_in, theta_out, alpha = 0.9, 0.6, 0.4
    half, tilt = 0.5 * (theta_in + theta_out), 0.5 * (theta_in - theta_out)
    inside = math.asin(math.sin(half) / 1.5)
    s = (math.sin(half - inside) / math.sin(half + inside)) ** 2
    p = (math.tan(half - inside) / math.tan(half + inside)) ** 2
    seen = 1.0
    for theta in (theta_in, theta_out):
        a = 1.0 / (alpha * math.tan(theta))
        masked = (math.erf(a) - 1.0) / 2.0 + math.exp(-a * a) / (2.0 * a * math.sqrt(math.pi))
        seen /= 1.0 + masked
    areas = 4.0 * math.cos(theta_in) * math.cos(theta_out)
    facets = math.exp(-((math.tan(tilt) / alpha) ** 2)) / (math.pi * alpha**2 * math.cos(tilt) ** 4)
    expected = 0.5 * (s + p) * facets * seen / areas
    brdf = single_scattering(1.5, alpha, down(theta_in), direction(theta_out), masking="separate")
    assert brdf.matrix[0, 0] == pytest.approx(expected, rel=1e-13)


@rows("alpha", [0.1, 0.4, 1.0])
def test_the_albedo_at_normal_incidence_is_that_of_smiths_model(alpha):
    # Light along the normal leaves a facet of slope r at twice its angle.
    def integrand(r):
        tan = 2 * r / (1 - r * r)
        a = 1 / (alpha * tan)
        masked = (mp.erf(a) - 1) / 2 + mp.exp(-a * a) / (2 * a * mp.sqrt(mp.pi))
        return 2 * r / alpha**2 * mp.exp(-((r / alpha) ** 2)) / (1 + masked)

    expected = float(mp.quad(integrand, [1e-30, 0.1, 0.2, 0.4, 0.7, 1 - 1e-12]))
    theta, weights = np.polynomial.legendre.leggauss(400)
    theta, weights = np.pi / 4 * (theta + 1.0), np.pi / 4 * weights
    brdf = single_scattering(1j, alpha, down(0.0), direction(theta)).matrix[:, 0, 0]
    found = 2.0 * np.pi * np.sum(brdf * np.cos(theta) * np.sin(theta) * weights)
    assert found == pytest.approx(expected, rel=1e-9)


def test_a_surface_of_two_roughnesses_may_be_turned_by_a_right_angle():
    straight, turned = (
        single_scattering(1.5, alpha, down(0.7, 0.1 + by), direction(0.9, 0.5 + by), alpha_y=other)
        for alpha, other, by in ((0.2, 0.6, 0.0), (0.6, 0.2, np.pi / 2))
    )
    np.testing.assert_allclose(turned.matrix, straight.matrix, rtol=1e-13, atol=1e-16)
