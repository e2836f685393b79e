"""First-order uncertainties against closed forms and 50-digit derivatives."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from tables import rows

METHODS = ["differences", *(["gradients"] if "jax" in ENGINES else [])]
each_method = pytest.mark.parametrize("method", METHODS)


def malus():
    angle, power = op.Parameter("angle"), op.Parameter("power", 2.0)
    return op.Source(power, stokes=[1, 1, 0, 0]) >> op.Polarizer(angle) >> op.Detector()


@each_method
def test_malus(method):
    # I = P cos^2 a: dI = -P sin 2a da.
    found = malus().propagate(angle=(0.7, 0.003), method=method)
    expected = 2.0 * np.sin(1.4) * 0.003
    np.testing.assert_allclose(found.uncertainty_of("intensity"), expected, rtol=1e-10)


def test_shares_of_malus():
    found = malus().propagate(angle=(0.7, 0.003), power=(2.0, 0.01), method="differences")
    by_angle, by_power = (2.0 * np.sin(1.4) * 0.003) ** 2, (np.cos(0.7) ** 2 * 0.01) ** 2
    shares = found.contributions
    share = by_angle / (by_angle + by_power)
    np.testing.assert_allclose([shares["angle"][0], shares["power"][0]], [share, 1.0 - share])
    assert found.contributions_to("S0")["angle"] == shares["angle"][0]


def test_glass_at_normal_incidence():
    # R = ((n - 1) / (n + 1))^2, dR/dn = 4 (n - 1) / (n + 1)^3.
    path = op.Source(100.0) >> op.Interface(op.Parameter("n"), 0.0) >> op.Detector()
    found = path.propagate(n=(1.5, 0.002), method="differences")
    expected = 100.0 * 4.0 * 0.5 / 2.5**3 * 0.002
    np.testing.assert_allclose(found.uncertainty_of("S0"), expected, rtol=1e-10)


def metal_at(n, k, angle):
    """The Stokes vector of +45 degrees reflected from a metal, and its figures, by mpmath."""
    m, c = mpmath.mpc(n, k), mpmath.cos(angle)
    g = mpmath.sqrt(m**2 - mpmath.sin(angle) ** 2)
    s, p = (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)
    across = s * mpmath.conj(p)
    fs, fp = abs(s) ** 2, abs(p) ** 2
    return [(fs + fp) / 2, (fs - fp) / 2, across.real, -across.imag]


def with_figures(stokes):
    s0, s1, s2, s3 = stokes
    linear = mpmath.hypot(s1, s2)
    polarised = mpmath.hypot(linear, s3)
    aop = mpmath.atan2(s2, s1) / 2
    ellipticity = mpmath.tan(mpmath.asin(s3 / polarised) / 2)
    psi = mpmath.acos(s1 / polarised) / 2
    delta = mpmath.atan2(-s3, s2)
    return [*stokes, polarised / s0, linear / s0, aop, ellipticity, psi, delta]


NAMES = ["S0", "S1", "S2", "S3", "dop", "dolp", "aop", "ellipticity", "psi", "delta"]
SIGMAS = {"n": 0.003, "k": 0.007, "theta": 0.002}
VALUES = {"n": 0.6, "k": 2.1, "theta": 1.1}


def expected_changes(function, values, sigmas):
    """The change of each figure with each value, by derivatives in 50 digits."""
    rows = []
    with mpmath.workdps(50):
        for place in range(len(values)):
            order = tuple(int(place == other) for other in range(len(values)))
            row = [
                mpmath.diff(lambda *v, at=at: function(*v)[at], tuple(values), order)
                for at in range(len(NAMES))
            ]
            rows.append([float(slope) * sigmas[place] for slope in row])
    return np.array(rows).T


def metal():
    index = op.Material(op.Parameter("n"), op.Parameter("k"))
    return (
        op.Source(stokes=[1, 0, 1, 0])
        >> op.Depolarizer(0.2)
        >> op.Interface(index, op.Parameter("theta"))
        >> op.Detector()
    )


def hazy(n, k, theta):
    """As `metal` does: the lamp's S2 is 0.8 behind the depolariser."""
    stokes = metal_at(n, k, theta)
    return with_figures([stokes[0], stokes[1], 0.8 * stokes[2], 0.8 * stokes[3]])


@each_method
def test_all_figures_of_a_metal_follow_from_derivatives_in_50_digits(method):
    changes = expected_changes(hazy, VALUES.values(), [*SIGMAS.values()])
    found = metal().propagate(**{n: (VALUES[n], SIGMAS[n]) for n in VALUES}, method=method)
    uncertainties = [found.uncertainty_of(name) for name in NAMES]
    np.testing.assert_allclose(uncertainties, np.linalg.norm(changes, axis=1), rtol=1e-8)
    shares = np.array([list(found.contributions_to(name).values()) for name in NAMES])
    expected = changes**2 / np.sum(changes**2, axis=1, keepdims=True)
    np.testing.assert_allclose(shares, expected, atol=1e-8)
    np.testing.assert_allclose(found.covariance, changes[:4] @ changes[:4].T, rtol=1e-8)


def test_correlated_values_follow_the_matrix_of_covariances():
    changes = expected_changes(hazy, VALUES.values(), [1.0] * 3)
    matrix = np.diag([s**2 for s in SIGMAS.values()])
    matrix[0, 1] = matrix[1, 0] = 0.6 * SIGMAS["n"] * SIGMAS["k"]
    found = metal().propagate(
        **{n: (VALUES[n], SIGMAS[n]) for n in VALUES},
        correlation={("k", "n"): 0.6},
        method="differences",
    )
    covariance = changes @ matrix @ changes.T
    np.testing.assert_allclose(found.covariance, covariance[:4, :4], rtol=1e-8)
    expected = np.sqrt(np.diag(covariance))
    np.testing.assert_allclose([found.uncertainty_of(n) for n in NAMES], expected, rtol=1e-8)
    np.testing.assert_allclose(sum(found.contributions.values()), 1.0)


def test_a_batch_is_each_of_its_paths_alone():
    angles, sigmas = np.array([[0.3], [0.8]]), np.array([0.001, 0.02, 0.0])
    batch = malus().propagate(angle=(angles, sigmas), power=(2.0, 0.1), method="differences")
    assert batch.light.shape == (2, 3)
    assert batch.covariance.shape == (2, 3, 4, 4)
    for place in np.ndindex(2, 3):
        one = malus().propagate(
            angle=(float(angles[place[0], 0]), sigmas[place[1]]),
            power=(2.0, 0.1),
            method="differences",
        )
        np.testing.assert_allclose(batch.uncertainties[place], one.uncertainties, rtol=1e-9)
        np.testing.assert_allclose(batch.shares[place], one.shares, atol=1e-9)


@pytest.mark.skipif("jax" not in ENGINES, reason="JAX is not installed")
@rows("preset", ["lyot-filter", "ellipsometer-pcsa"])
def test_differences_are_the_gradients(preset):
    path = op.load_preset(preset)
    numbers = {n: p.default for n, p in path.compose().inputs.open.items()}
    given = {n: (v, 1e-3 * v or 1e-3) for n, v in numbers.items() if isinstance(v, float)}
    found = path.propagate(**given, method="differences").uncertainties
    other = path.propagate(**given, method="gradients").uncertainties
    np.testing.assert_allclose(found, other, rtol=1e-7, atol=1e-14)


@settings(max_examples=20, deadline=None)
@given(angle=st.floats(0.05, 1.5), sigma=st.floats(1e-9, 1e-3), factor=st.floats(0.1, 100.0))
def test_uncertainties_are_proportional_to_sigma(angle, sigma, factor):
    one = malus().propagate(angle=(angle, sigma), method="differences")
    more = malus().propagate(angle=(angle, sigma * factor), method="differences")
    np.testing.assert_allclose(more.uncertainties, factor * one.uncertainties, rtol=1e-12)


@settings(max_examples=20, deadline=None)
@given(
    theta=st.floats(0.1, 1.4),
    turn=st.floats(-3.0, 3.0),
    sigmas=st.tuples(*[st.floats(1e-6, 1e-2)] * 3),
)
def test_covariances_are_positive_and_that_of_intensity_knows_no_frame(theta, turn, sigmas):
    given_ = {"n": (0.6, sigmas[0]), "k": (2.1, sigmas[1]), "theta": (theta, sigmas[2])}
    found = metal().propagate(**given_, method="differences")
    values = np.linalg.eigvalsh(found.covariance)
    assert np.all(values >= -1e-12 * values.max())
    for name in NAMES:
        np.testing.assert_allclose(sum(found.contributions_to(name).values()), 1.0)
    index = op.Material(op.Parameter("n"), op.Parameter("k"))
    lamp = op.Source(stokes=[1, *_turned(turn)]) >> op.Depolarizer(0.2)
    turned = lamp >> op.Interface(index, op.Parameter("theta"), azimuth=turn) >> op.Detector()
    other = turned.propagate(**given_, method="differences")
    for name in ("intensity", "dop", "ellipticity"):
        np.testing.assert_allclose(
            found.uncertainty_of(name), other.uncertainty_of(name), rtol=1e-7, atol=1e-15
        )


def _turned(turn):
    """Light of +45 degrees to a plane that stands at some angle."""
    return -np.sin(2 * turn), np.cos(2 * turn), 0.0
