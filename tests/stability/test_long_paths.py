"""Paths of many elements, and light too faint for a float."""

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.lab.path_reference import exact_lights, exact_stokes
from paths import chain
from tables import rows, slow
from wired import wired

# Total reflection, glass and a metal.
REFLECTED = [(1 / 1.5, 0.9), (1.5, 0.7), (0.2 + 3.4j, 1.1)]
POLARISED = (1.0, 0.48, 0.6, 0.64)
FAINT = op.Attenuator(1e-150)


def both_ways(path, **options):
    """The light of a path by Stokes vectors and by Jones matrices."""
    for composing in ("stokes", "jones"):
        yield op.Composer(composing=composing, **options).compose(path).run()


def excess(light):
    """DoP - 1 of what was computed, without rounding of its own."""
    s0, *rest = map(mpmath.mpf, light.stokes.astype(float).tolist())
    with mpmath.workdps(40):
        return float(mpmath.sqrt(sum(part * part for part in rest)) / s0 - 1)


@pytest.mark.parametrize("count", [10, *map(slow, (200, 300, 3000))])
@rows("dtype", ["float64", "float32"])
@rows("index, incidence", REFLECTED)
def test_no_path_polarises_by_more_than_100_percent(index, incidence, count, dtype):
    path = chain([op.Interface(index, incidence, azimuth=0.3)] * count, POLARISED)
    for light in both_ways(path, dtype=dtype):
        assert light.intensity >= 0.0
        assert light.intensity == 0.0 or excess(light) <= np.finfo(dtype).eps


@pytest.mark.parametrize("count", [1000, slow(100_000)])
def test_many_thousand_total_reflections_keep_the_light_and_its_polarisation(count):
    # One after another about one axis: a retarder of as many times the angle.
    light = chain([op.Interface(1 / 1.5, 0.9)] * count, POLARISED).trace()
    _, _, c, s = op.fresnel_reflection(1 / 1.5, np.cos(0.9), np.sin(0.9), "compensated")
    phase = count * np.arctan2(s, c)
    turned = (POLARISED[2] + 1j * POLARISED[3]) * np.exp(-1j * phase)
    expected = [1.0, POLARISED[1], turned.real, turned.imag]
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-10)
    assert excess(light) <= 1e-12


def test_light_as_faint_as_floats_are_has_its_polarisation():
    light = chain([op.Attenuator(0.18)] * 400 + [op.Rotator(0.2)], POLARISED).trace()
    assert light.log10_intensity == pytest.approx(400 * np.log10(0.18), abs=1e-10)
    c, s = np.cos(0.4), np.sin(0.4)
    turned = [1.0, c * 0.48 - s * 0.6, s * 0.48 + c * 0.6, 0.64]
    np.testing.assert_allclose(light.normalized, turned, rtol=1e-14)
    assert light.dop == pytest.approx(1.0, abs=1e-15)
    # Two steps are enough to be too faint, and a batch may be so in part.
    light = chain([op.Attenuator([0.5, 1e-150, 1e-300, 0.0])] * 2, POLARISED).trace()
    np.testing.assert_allclose(light.log10_intensity, [np.log10(0.25), -300, -np.inf, -np.inf])
    np.testing.assert_allclose(light.stokes[0], np.multiply(POLARISED, 0.25))
    np.testing.assert_allclose(light.dop, [1.0, 1.0, np.nan, np.nan], rtol=0, atol=1e-15)


def test_a_faint_path_of_glass_agrees_with_50_digits_and_faint_light_adds_to_faint_light():
    angles = np.random.default_rng(4).uniform((0, -3), (1.5, 3), (8, 2)).tolist()
    glasses = (op.Interface(1.5, incidence, azimuth=turn) for incidence, turn in angles)
    path = chain([FAINT, FAINT, *glasses], POLARISED)
    exact = exact_stokes(path)["eye"]
    expected = [float(part / exact[0]) for part in exact]
    for light in both_ways(path):
        assert light.log10_intensity == pytest.approx(float(mpmath.log10(exact[0])), rel=1e-14)
        np.testing.assert_allclose(light.normalized, expected, rtol=0, atol=1e-13)
    nodes = {"sum": op.Combiner(), "eye": op.Detector()}
    nodes |= {"a": op.Source(stokes=[1.0, 1.0, 0, 0]), "b": op.Source(stokes=[1.0, -1.0, 0, 0])}
    nodes |= {f"{name}{number}": FAINT for name in "ab" for number in (0, 1)}
    links = "a -> a0, a0 -> a1, a1 -> sum, b -> b0, b0 -> b1, b1 -> sum, sum -> eye"
    for light in both_ways(wired(nodes, links)):
        np.testing.assert_allclose(light.normalized, [1, 0, 0, 0], rtol=0, atol=1e-15)
        assert light.log10_intensity == pytest.approx(-300 + np.log10(2), abs=1e-10)


def test_no_intensity_is_negative_in_float32():
    rng, batch, elements = np.random.default_rng(5), 2000, []
    for _ in range(8):
        n, k = rng.uniform(0.5, 3, batch), rng.uniform(0, 3, batch) * rng.integers(0, 2, batch)
        incidence, azimuth = rng.uniform(0, np.pi / 2, batch), rng.uniform(-4, 4, batch)
        elements.append(op.Interface(n + 1j * k, incidence, azimuth=azimuth))
    crossed = [op.Polarizer(0.4), op.Polarizer(0.4 + np.pi / 2)]
    for several in ([*elements, *crossed], [*crossed, *elements]):
        for light in both_ways(chain(several, POLARISED), dtype="float32"):
            assert light.stokes.dtype == np.float32
            assert np.all(light.stokes[..., 0] >= 0.0)


def test_s1_near_the_normal_keeps_its_law_where_amplitude_loses_all_of_it():
    path = chain([op.Interface(1.5, op.Parameter("theta"))])
    theta = 10.0 ** np.linspace(-12, -3, 10)
    stable, amplitude = (
        op.Composer(method=method).compose(path).run(theta=theta).stokes[:, 1]
        for method in ("stable", "amplitude")
    )
    exact = [float(exact_lights(path, theta=t)["eye"].stokes[1]) for t in theta.tolist()]
    np.testing.assert_allclose(stable, exact, rtol=2e-15)
    assert np.all(np.abs(amplitude[:4] / exact[:4] - 1) > 0.5)


@rows("dtype, most", [("float64", 1e-14), ("float32", 1e-6)])
@rows(
    "element, turn",
    [(op.Rotator(0.3), 0.3), (op.Retarder(2 * np.pi, 0.7), 0.0), (op.Attenuator(0.5), 0.0)],
)
def test_light_that_is_nulled_is_not_negative(element, turn, dtype, most):
    axes = np.random.default_rng(0).uniform(-4, 4, 50_000)
    path = chain([op.Polarizer(axes), element, op.Polarizer(axes + np.pi / 2 + turn)])
    for light in both_ways(path, dtype=dtype):
        assert np.all(light.stokes[:, 0] >= 0.0)
        assert np.all(light.intensity <= most)


@pytest.mark.parametrize("count", [200, slow(1000)])
def test_many_retarders_polarise_by_no_more_than_100_percent_in_float32(count):
    pairs = np.random.default_rng(6).uniform(-3, 3, (count, 2)).tolist()
    path = chain([op.Retarder(*pair) for pair in pairs], POLARISED)
    for light in both_ways(path, dtype="float32"):
        assert excess(light) <= 2 * np.finfo("float32").eps


@rows("theta", [1e-8, 1e-4, 0.7, 1.57])
def test_each_entry_of_the_matrix_of_a_path_has_its_own_digits(theta):
    matrix = chain([op.Interface(1.5, theta)], POLARISED).mueller().matrix
    A, B, C, S = op.fresnel_reflection(1.5, np.cos(theta), np.sin(theta))
    expected = [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]
    np.testing.assert_allclose(matrix, expected, rtol=1e-15)
