"""Paths of many elements, and light too faint for a float."""

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.lab.accuracy.path_reference import exact_lights, exact_stokes
from paths import chain
from tables import rows, slow

# Total reflection, glass and a metal.
REFLECTED = [(1 / 1.5, 0.9), (1.5, 0.7), (0.2 + 3.4j, 1.1)]
POLARISED = (1.0, 0.48, 0.6, 0.64)


def both_ways(path, **options):
    """The light of a path by Stokes vectors and by Jones matrices."""
    for composing in ("stokes", "jones"):
        yield op.Composer(composing=composing, **options).compose(path).run()


def excess(light):
    """DoP - 1 of what was computed, without rounding of its own."""
    s0, *rest = map(mpmath.mpf, light.mantissa.astype(float).tolist())
    with mpmath.workdps(40):
        return float(mpmath.sqrt(sum(part * part for part in rest)) / s0 - 1)


@pytest.mark.parametrize("count", [10, 200, *map(slow, (300, 3000))])
@rows("composing", ["stokes", "jones"])
@rows("dtype", ["float64", "float32"])
@rows("index, incidence", REFLECTED)
def test_no_path_polarises_by_more_than_100_percent(index, incidence, count, dtype, composing):
    path = chain([op.Interface(index, incidence, azimuth=0.3)] * count, POLARISED)
    light = op.Composer(dtype=dtype, composing=composing).compose(path).run()
    assert light.mantissa[0] > 0.0
    assert light.intensity >= 0.0
    assert excess(light) <= np.finfo(dtype).eps


@pytest.mark.parametrize("count", [1000, slow(100_000)])
def test_many_thousand_total_reflections_keep_the_light_and_its_polarisation(count):
    # One after another about one axis: a retarder of as many times the angle.
    element = op.Interface(1 / 1.5, 0.9)
    path = chain([element] * count, POLARISED)
    _, _, c, s = op.fresnel_reflection(1 / 1.5, np.cos(0.9), np.sin(0.9), "compensated")
    phase = count * np.arctan2(s, c)
    turned = (POLARISED[2] + 1j * POLARISED[3]) * np.exp(-1j * phase)
    light = path.trace()
    expected = [1.0, POLARISED[1], turned.real, turned.imag]
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=1e-10)
    assert excess(light) <= 1e-12


def test_light_of_1e_minus_100000_has_its_polarisation():
    path = chain([op.Attenuator(1e-250)] * 400 + [op.Rotator(0.2)], POLARISED)
    light = path.trace()
    assert light.log10_intensity == pytest.approx(-100_000, abs=1e-6)
    assert light.intensity == 0.0
    c, s = np.cos(0.4), np.sin(0.4)
    turned = [1.0, c * 0.48 - s * 0.6, s * 0.48 + c * 0.6, 0.64]
    np.testing.assert_allclose(light.normalized, turned, rtol=1e-14)
    assert light.dop == pytest.approx(1.0, abs=1e-15)


def test_two_steps_are_enough_to_be_too_faint_and_a_batch_may_be_so_in_part():
    light = chain([op.Attenuator(1e-200)] * 2, POLARISED).trace()
    assert light.intensity == 0.0
    np.testing.assert_allclose(light.normalized, POLARISED, rtol=1e-15)
    light = chain([op.Attenuator([0.5, 1e-300, 0.0])] * 2, POLARISED).trace()
    np.testing.assert_allclose(light.log10_intensity, [np.log10(0.25), -600, -np.inf])
    np.testing.assert_array_equal(light.exponent == 0, [True, False, True])
    np.testing.assert_allclose(light.stokes[0], np.multiply(POLARISED, 0.25))
    np.testing.assert_allclose(light.dop, [1.0, 1.0, np.nan], rtol=0, atol=1e-15)


def test_a_faint_path_of_glass_agrees_with_50_digits():
    rng = np.random.default_rng(4)
    angles = rng.uniform((0, -3), (1.5, 3), (8, 2))
    dark = [op.Attenuator(1e-200)] * 2
    path = chain([*dark, *(op.Interface(1.5, i, azimuth=a) for i, a in angles.tolist())], POLARISED)
    exact = exact_stokes(path)["eye"]
    expected = [float(part / exact[0]) for part in exact]
    for light in both_ways(path):
        assert light.log10_intensity == pytest.approx(float(mpmath.log10(exact[0])), rel=1e-14)
        np.testing.assert_allclose(light.normalized, expected, rtol=0, atol=1e-13)


def test_faint_light_adds_to_faint_light():
    path = op.PathGraph()
    for name, state in (("a", (1.0, 1.0, 0, 0)), ("b", (1.0, -1.0, 0, 0))):
        node = path.add(name, op.Source(stokes=state))
        for number in range(2):
            node = node >> path.add(f"{name}{number}", op.Attenuator(1e-200))
        node >> (path["sum"] if name == "b" else path.add("sum", op.Combiner()))
    path["sum"] >> path.add("eye", op.Detector())
    for light in both_ways(path):
        np.testing.assert_allclose(light.normalized, [1, 0, 0, 0], rtol=0, atol=1e-15)
        assert light.log10_intensity == pytest.approx(-400 + np.log10(2), abs=1e-10)


def test_no_intensity_is_negative_in_float32():
    rng = np.random.default_rng(5)
    batch = 2000
    elements = [
        op.Interface(
            rng.uniform(0.5, 3, batch) + 1j * rng.uniform(0, 3, batch) * rng.integers(0, 2, batch),
            rng.uniform(0, np.pi / 2, batch),
            azimuth=rng.uniform(-4, 4, batch),
        )
        for _ in range(8)
    ]
    crossed = [op.Polarizer(0.4), op.Polarizer(0.4 + np.pi / 2)]
    for path in (chain([*elements, *crossed], POLARISED), chain([*crossed, *elements], POLARISED)):
        for light in both_ways(path, dtype="float32"):
            assert light.stokes.dtype == np.float32
            assert np.all(light.mantissa[..., 0] >= 0.0)


def test_s1_near_the_normal_keeps_its_law_where_amplitude_loses_all_of_it():
    path = chain([op.Interface(1.5, op.Parameter("theta"))], (1.0, 0, 0, 0))
    theta = 10.0 ** np.linspace(-12, -3, 10)
    found = {
        method: op.Composer(method=method).compose(path).run(theta=theta).stokes[:, 1]
        for method in ("stable", "amplitude")
    }
    exact = [float(exact_lights(path, theta=t)["eye"].stokes[1]) for t in theta.tolist()]
    np.testing.assert_allclose(found["stable"], exact, rtol=2e-15)
    assert np.all(np.abs(found["amplitude"][:4] / exact[:4] - 1) > 0.5)


@rows("composing", ["stokes", "jones"])
@rows("dtype", ["float64", "float32"])
@rows(
    "element, turn",
    [(op.Rotator(0.3), 0.3), (op.Retarder(2 * np.pi, 0.7), 0.0), (op.Attenuator(0.5), 0.0)],
)
def test_light_that_is_nulled_is_not_negative(element, turn, dtype, composing):
    axes = np.random.default_rng(0).uniform(-4, 4, 50_000)
    crossed = op.Polarizer(axes), element, op.Polarizer(axes + np.pi / 2 + turn)
    light = (
        op.Composer(dtype=dtype, composing=composing).compose(chain(crossed, (1, 0, 0, 0))).run()
    )
    assert np.all(light.mantissa[:, 0] >= 0.0)
    assert np.all(light.intensity <= 1e-6 if dtype == "float32" else light.intensity <= 1e-14)


@pytest.mark.parametrize("count", [200, slow(1000)])
@rows("composing", ["stokes", "jones"])
def test_many_retarders_polarise_by_no_more_than_100_percent_in_float32(composing, count):
    rng = np.random.default_rng(6)
    plates = [op.Retarder(*pair) for pair in rng.uniform(-3, 3, (count, 2)).tolist()]
    composer = op.Composer(dtype="float32", composing=composing)
    assert excess(composer.compose(chain(plates, POLARISED)).run()) <= 2 * np.finfo("float32").eps


@rows("theta", [1e-8, 1e-4, 0.7, 1.57])
def test_each_entry_of_the_matrix_of_a_path_has_its_own_digits(theta):
    path = chain([op.Interface(1.5, theta)], POLARISED)
    matrix = path.mueller().matrix
    A, B, C, S = op.fresnel_reflection(1.5, np.cos(theta), np.sin(theta))
    expected = [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]
    np.testing.assert_allclose(matrix, expected, rtol=1e-15)
