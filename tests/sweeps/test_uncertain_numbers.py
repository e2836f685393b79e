"""Uncertainties by slopes and by samples, against closed forms and 50-digit derivatives."""

import tracemalloc

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.sweeps.uncertainty import monte_carlo
from optipath.sweeps.uncertainty.drawn_samples import DrawnSamples
from optipath.sweeps.uncertainty.light_figures import difference, figures_of, gradients_of
from optipath.sweeps.uncertainty.uncertain_value import UncertainValue
from optipath.values.arrays import memory
from tables import rows

METHODS = ["differences", *(["gradients"] if "jax" in ENGINES else [])]
each_method = pytest.mark.parametrize("method", METHODS)


def malus():
    angle, power = op.Parameter("angle"), op.Parameter("power", 2.0)
    return op.Source(power, stokes=[1, 1, 0, 0]) >> op.Polarizer(angle) >> op.Detector()


@each_method
def test_malus(method):
    # I = P cos^2 a: dI = -P sin 2a da + cos^2 a dP.
    found = malus().propagate(angle=(0.7, 0.003), method=method)
    expected = 2.0 * np.sin(1.4) * 0.003
    np.testing.assert_allclose(found.uncertainty_of("intensity"), expected, rtol=1e-10)
    found = malus().propagate(angle=(0.7, 0.003), power=(2.0, 0.01), method=method)
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
@pytest.mark.slow
@pytest.mark.parametrize("preset", ["lyot-filter", "ellipsometer-pcsa"])
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


@settings(max_examples=8, deadline=None)
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


RIGHT = np.pi / 2


def uncertainty(path, /, **given):
    return path.propagate(method="differences", **given).uncertainty


def reflected(n, k, angle):
    """The intensity that a surface reflects of unpolarised light."""
    m, c = mpmath.mpc(n, k), mpmath.cos(angle)
    g = mpmath.sqrt(m**2 - mpmath.sin(angle) ** 2)
    return (abs((c - g) / (c + g)) ** 2 + abs((m**2 * c - g) / (m**2 * c + g)) ** 2) / 2


def slope_in_50_digits(values, place, inwards):
    """The slope along one value; at the upper or the lower end of its range from inside."""
    with mpmath.workdps(50):
        upper, lower = (0 if end else mpmath.mpf(10) ** -18 for end in inwards)
        above, below = (
            reflected(*[v + (at == place) * by for at, v in enumerate(values)])
            for by in (upper, -lower)
        )
        return float((above - below) / (upper + lower))


@rows("angle", [1e-9, 1e-6, 1e-3, 0.5, 0.98, RIGHT - 1e-3, RIGHT - 1e-6, RIGHT])
@rows("index", [(1.5, 0.0), (0.6, 2.1), (1.2, 1e-6)])
def test_slopes_go_to_the_ends_of_ranges(angle, index):
    material = op.Material(op.Parameter("n"), op.Parameter("k"))
    path = op.Source() >> op.Interface(material, op.Parameter("angle")) >> op.Detector()
    values = dict(zip(("n", "k", "angle"), (*index, angle), strict=True))
    for place, name in enumerate(values):
        inwards = name == "angle" and angle == RIGHT, name == "k" and index[1] == 0.0
        slope = slope_in_50_digits([*values.values()], place, inwards)
        given = values | {name: (values[name], 1e-3)}
        found = uncertainty(path, **given)[0]
        np.testing.assert_allclose(found, 1e-3 * abs(slope), rtol=1e-7, atol=1e-10)


@rows("waves", [1, 20, 1000, 12345.25])
def test_retarders_of_many_waves_do_not_repeat_themselves(waves):
    # I = (1 + cos p) / 2, the phase p = 2 pi W l / l0 plus an eighth of a wave.
    length, phase = 2e-3, 2 * np.pi * waves
    plate = op.Medium(op.Parameter("l"), retardance=phase / length, angle="45 deg")
    eighth = op.Retarder("45 deg", "45 deg")
    lamp = op.Source(stokes=[1, 1, 0, 0])
    path = lamp >> plate >> eighth >> op.Polarizer(0.0) >> op.Detector()
    slope = np.sin(phase + np.pi / 4) / 2 * phase / length
    found = uncertainty(path, l=(length, 1e-12))[0]
    np.testing.assert_allclose(found, abs(slope) * 1e-12, rtol=1e-7)


def test_a_wavelength_has_steps_of_its_own_size():
    path = op.load_preset("quartz-quarter-wave")
    waves = path.compose().inputs.open["wavelength"].default
    near = [path.trace(wavelength=waves + by).stokes for by in (-1e-13, 1e-13)]
    expected = np.abs(near[1] - near[0]) / 2e-13 * 1e-9
    np.testing.assert_allclose(
        uncertainty(path, wavelength=(waves, 1e-9)), expected, rtol=1e-5, atol=1e-8
    )


def test_a_thick_medium_that_hardly_absorbs():
    # I = exp(-a L): dI/da = -L I, with a step that is small against 1 / L.
    path = op.Source() >> op.Medium("10 m", absorption=op.Parameter("a")) >> op.Detector()
    found = uncertainty(path, a=(1e-3, 1e-6))[0]
    np.testing.assert_allclose(found, 10.0 * np.exp(-0.01) * 1e-6, rtol=1e-9)
    found = uncertainty(path, a=(0.0, 1e-6))[0]
    np.testing.assert_allclose(found, 10.0 * 1e-6, rtol=1e-7)


def test_every_quantity_has_its_gradient():
    light = op.Light([[1.0, 0.1, 0.2, 0.3], [2.0, -0.3, 0.1, 0.0]])
    assert figures_of(light).shape == (2, len(QUANTITIES))
    assert gradients_of(light).shape == (2, len(QUANTITIES), 4)


@rows(
    "stokes", [[1.0, 0.1, 0.2, 0.3], [2.0, -0.3, 0.1, -0.5], [1.0, 0.6, 0.8, 0.0], [3.0, 0, 1, 1]]
)
@rows("scale", [1.0, 1e-100])
def test_gradients_are_what_small_changes_do(stokes, scale):
    step = 1e-6
    for place in range(4):
        by = step * np.eye(4)[place]
        ends = [op.Light((stokes + s * by) * scale, physical=False) for s in (1.0, -1.0)]
        slope = difference(*map(figures_of, ends)) / (2.0 * step * scale)
        found = gradients_of(op.Light(np.multiply(stokes, scale)))[:, place]
        np.testing.assert_allclose(found * scale, slope * scale, atol=1e-8)


def test_angles_differ_by_the_shorter_way_round():
    ends = [op.Light([1.0, -1.0, s, 0.0], physical=False) for s in (1e-3, -1e-3)]
    apart = difference(*map(figures_of, ends))
    np.testing.assert_allclose(apart[6], -1e-3, rtol=1e-5)


BOTH = ["monte-carlo", "differences"]


def uncertain_lamp():
    return op.Source(op.Parameter("i")) >> op.Polarizer(op.Parameter("a")) >> op.Detector()


@rows("method", BOTH)
@rows("size", [1e-300, 1e-160, 1e155, 1e300])
def test_faint_and_bright_light_is_as_uncertain_as_any(method, size):
    given = {"a": (0.3, 0.01), "method": method}
    plain = uncertain_lamp().propagate(i=(1.0, 0.01), **given)
    found = uncertain_lamp().propagate(i=(size, 0.01 * size), **given)
    np.testing.assert_allclose(found.uncertainty / size, plain.uncertainty, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(found.shares[:4], plain.shares[:4], atol=1e-6)
    np.testing.assert_allclose(found.mean / size, plain.mean, rtol=1e-12, atol=1e-15)


def test_light_that_is_nearly_absorbed_is_uncertain_by_the_length_of_the_absorber():
    medium = op.Medium(length=op.Parameter("L"), absorption="100 1/cm")
    path = op.Source(1) >> medium >> op.Detector()
    found = path.propagate(L=("4 cm", "1 um"), method="monte-carlo")
    # exp(-a L) varies by a s = 100 / cm x 1 um = 1 %.
    np.testing.assert_allclose(found.uncertainty[0] / found.light.stokes[0], 0.01, rtol=0.03)


ALL = np.inf


def value(name, low=-ALL, high=ALL, at=0.0, sigma=1.0):
    return UncertainValue(name, np.array(at), np.array(sigma), low, high, "")


def drawn(values, places, correlation=None, count=5_000, block=None):
    correlation = np.eye(len(values)) if correlation is None else np.asarray(correlation)
    samples = DrawnSamples(values, correlation, places, count, 1, 0)
    return samples.within(block or slice(0, count), [each.name for each in values])


def test_another_value_leaves_the_samples_of_the_others_as_they_were():
    a, b, c = value("a"), value("b", low=0.0), value("c", high=0.0)
    alone = drawn([b], [1])["b"]
    for values, places in ([[a, b, c], [0, 1, 2]], [[c, b], [2, 1]]):
        np.testing.assert_array_equal(drawn(values, places)["b"], alone)


def test_correlated_values_have_one_set_of_samples_in_whatever_order():
    a, b, c = value("a"), value("b", low=0.0), value("c")
    matrix = np.array([[1.0, 0.5, 0.0], [0.5, 1.0, 0.3], [0.0, 0.3, 1.0]])
    found, again = (
        drawn([a, b, c], [4, 2, 7], matrix),
        drawn([c, b, a], [7, 2, 4], matrix[::-1, ::-1]),
    )
    for name in "abc":
        np.testing.assert_array_equal(found[name], again[name])
    assert found["b"].min() >= 0.0


def test_a_block_is_a_part_of_the_whole():
    values = [value("a", low=0.0), value("b")]
    whole = drawn(values, [0, 1], count=10_000)
    part = drawn(values, [0, 1], count=10_000, block=slice(4_000, 9_000))
    for name in "ab":
        np.testing.assert_array_equal(part[name], whole[name][4_000:9_000])


def test_values_at_the_ends_of_their_ranges_are_drawn_each_by_itself():
    # Of 30 half-normals 1e-9 of all samples were inside at once.
    values = [value(f"a{number}", low=0.0) for number in range(30)]
    for samples in drawn(values, range(30)).values():
        np.testing.assert_allclose(samples.mean(), np.sqrt(2.0 / np.pi), rtol=0.06)


def test_a_wide_normal_is_cut_off_to_what_is_inside():
    # A tenth of the sigma to both sides: nearly uniform, 8 % inside.
    (samples,) = drawn([value("a", low=-0.1, high=0.1)], [0]).values()
    assert np.abs(samples).max() <= 0.1
    np.testing.assert_allclose(samples.std(), 0.2 / np.sqrt(12.0), rtol=0.03)


def test_ranges_that_hardly_any_sample_is_in_are_refused():
    with pytest.raises(op.ParameterError, match="hardly any sample of a is within the range"):
        drawn([value("b"), value("a", low=-1e-5, high=1e-5)], [0, 1])
    values = [value("a", low=0.0), value("b", low=0.0)]
    with pytest.raises(op.ParameterError, match="hardly any sample of a and b"):
        drawn(values, [0, 1], [[1.0, -1.0], [-1.0, 1.0]])
    path = op.Source() >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    with pytest.raises(op.ParameterError, match="hardly any sample of t is within the range"):
        sampled(path, t=(0.5, 1e6), samples=100)


def test_memory_is_that_of_the_block():
    tracemalloc.start()
    try:
        drawn([value("a", low=0.0)], [0], count=10_000_000, block=slice(5_000_000, 5_000_010))
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()


SPECTRAL = "copper-gold-spectrum"


def lamp():
    return op.Source(stokes=[1, 1, 0, 0])


def analyzed():
    return lamp() >> op.Polarizer(op.Parameter("a")) >> op.Detector()


def sampled(path, /, **given):
    return path.propagate(method="monte-carlo", **given)


def test_small_uncertainties_are_those_of_the_first_order():
    path = op.load_preset("npgr026")
    given = {"n1": (1.12, 0.001), "k1": (2.16, 0.001), "delta": (0.8, 0.001), "phi": (0.3, 0.002)}
    first = path.propagate(**given, method="differences")
    found = sampled(path, **given, samples=20_000)
    # The relative standard deviation of a standard deviation of M samples is 1 / sqrt(2 M).
    there = first.uncertainties > 1e-12
    assert there.sum() > 3
    np.testing.assert_allclose(
        found.uncertainties[there], first.uncertainties[there], rtol=5.0 / np.sqrt(40_000)
    )
    np.testing.assert_allclose(found.shares[there], first.shares[there], atol=0.03)
    np.testing.assert_allclose(found.covariance[0, 1], first.covariance[0, 1], rtol=0.05)


def test_an_extremum_has_the_moments_of_a_squared_normal():
    # I = cos^2 a = (1 + cos 2a) / 2, and the mean of cos 2a is exp(-2 s^2) about 0.
    sigma, count = 0.2, 40_000
    found = sampled(analyzed(), a=(0.0, sigma), samples=count)
    mean = (1.0 + np.exp(-2.0 * sigma**2)) / 2.0
    variance = (1.0 + np.exp(-8.0 * sigma**2)) / 8.0 - np.exp(-4.0 * sigma**2) / 4.0
    deviation = np.sqrt(variance)
    assert abs(found.mean[0] - mean) < 5.0 * deviation / np.sqrt(count)
    np.testing.assert_allclose(found.uncertainty_of("S0"), deviation, rtol=0.04)


def test_correlated_samples_have_the_covariance_of_the_first_order():
    path = (
        lamp() >> op.Rotator(op.Parameter("a")) >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    )
    given = {"a": (0.3, 0.01), "t": (0.5, 0.01), "correlation": {("a", "t"): -0.7}}
    first = path.propagate(**given, method="differences")
    found = sampled(path, **given, samples=40_000)
    size = np.sqrt(np.outer(np.diag(first.covariance), np.diag(first.covariance)))
    assert np.all(np.abs(found.covariance - first.covariance) <= 0.03 * size + 1e-12)


def test_one_seed_has_one_result_and_another_another():
    path, given = analyzed(), {"a": (0.3, 0.1), "samples": 100}
    one, same, other = (sampled(path, **given, seed=seed) for seed in (3, 3, 4))
    np.testing.assert_array_equal(one.uncertainties, same.uncertainties)
    assert one.uncertainty_of("S0") != other.uncertainty_of("S0")
    assert one.method == "Monte Carlo, 100 samples, seed 3"


def test_blocks_of_any_size_have_the_same_bits(monkeypatch):
    path = op.load_preset(SPECTRAL)
    given = {"delta": (0.8, 0.1), "wavelength": ([516e-9, 520e-9], 1e-9), "samples": 100}
    whole = sampled(path, **given)
    for size in (2, 14, 64):
        monkeypatch.setattr(monte_carlo, "PATHS", size)
        parts = sampled(path, **given)
        np.testing.assert_array_equal(whole.uncertainties, parts.uncertainties)
        np.testing.assert_array_equal(whole.covariance, parts.covariance)
        np.testing.assert_array_equal(whole.shares, parts.shares)


def test_each_path_of_a_batch_has_the_samples_that_it_has_alone():
    angles = [0.1, 0.4]
    batch = sampled(analyzed(), a=(angles, 0.05), samples=200)
    alone = [sampled(analyzed(), a=(angle, 0.05), samples=200).uncertainties for angle in angles]
    np.testing.assert_allclose(batch.uncertainties, alone, rtol=1e-9, atol=1e-12)


def test_samples_outside_a_range_are_drawn_again_and_told():
    # Half of a normal distribution: its mean is s sqrt(2 / pi), its variance s^2 (1 - 2 / pi).
    path = op.Source(op.Parameter("i")) >> op.Detector()
    found = sampled(path, i=(0.0, 0.5), samples=40_000)
    np.testing.assert_allclose(found.mean[0], 0.5 * np.sqrt(2.0 / np.pi), rtol=0.02)
    expected = 0.5 * np.sqrt(1.0 - 2.0 / np.pi)
    np.testing.assert_allclose(found.uncertainty_of("S0"), expected, rtol=0.02)
    (note,) = found.notes
    assert "of 40,000 samples were outside its range, 0 or more, and were drawn again" in note


def test_a_range_is_cut_off_for_its_own_paths_alone():
    path = op.Source(op.Parameter("i")) >> op.Detector()
    found = sampled(path, i=([0.0, 100.0], 0.5), samples=5_000)
    assert found.uncertainty_of("S0")[0] < 0.35
    np.testing.assert_allclose(found.uncertainty_of("S0")[1], 0.5, rtol=0.05)


def test_angles_are_spread_the_shorter_way_round():
    path = lamp() >> op.Rotator(op.Parameter("a")) >> op.Detector()
    found = sampled(path, a=(np.pi / 2, 0.01))
    np.testing.assert_allclose(found.uncertainty_of("aop"), 0.01, rtol=0.05)


def test_what_values_do_together_is_the_share_of_none():
    # I t about 0: neither changes the light without the other.
    path = (
        lamp()
        >> op.Polarizer(op.Parameter("a"))
        >> op.Polarizer(op.Parameter("b"))
        >> op.Detector()
    )
    found = sampled(path, a=(0.0, 0.1), b=(np.pi / 2, 0.1))
    shares = found.contributions_to("S0")
    assert sum(shares.values()) < 0.9


def test_light_without_a_figure_in_some_sample_has_no_uncertainty_of_it():
    path = lamp() >> op.Depolarizer(op.Parameter("d")) >> op.Detector()
    found = sampled(path, d=(1.0, 0.1), samples=100)
    assert np.isnan(found.uncertainty_of("aop"))
    assert 0.03 < found.uncertainty_of("dop") < 0.1


def test_values_at_the_ends_of_their_ranges_have_samples():
    path = op.load_preset("npgr026", case=7)
    found = sampled(path, delta=(0, 1e-6), k1=(0, 1e-6), k2=(0, 1e-6), samples=1_000)
    assert np.all(np.isfinite(found.uncertainty))


def test_a_wide_uncertainty_of_a_wavelength_stays_within_its_table():
    table = op.Material.tabulated([400e-9, 450e-9, 500e-9], [1.4, 1.5, 1.6])
    path = lamp() >> op.Interface(table, op.Parameter("i")) >> op.Detector()
    given = {"i": 0.5, "wavelength": ("450 nm", "500 nm"), "samples": 500}
    assert 0.0 < sampled(path, **given).uncertainty_of("S0") < 0.1


def test_the_order_of_values_changes_no_figure():
    path = op.load_preset("npgr026")
    given = {"delta": (0.8, 0.1), "n1": (1.1, 0.1), "k1": (2.2, 0.1), "samples": 100}
    given["correlation"] = {("k1", "n1"): 0.3}
    one, other = (sampled(path, **dict(items)) for items in (given.items(), [*given.items()][::-1]))
    np.testing.assert_array_equal(one.uncertainties, other.uncertainties)
    np.testing.assert_array_equal(one.covariance, other.covariance)
    np.testing.assert_array_equal(one.shares, other.shares[:, ::-1])


def test_a_block_that_the_memory_cannot_hold_is_refused_before(monkeypatch):
    monkeypatch.setattr(memory, "memory", lambda: 2**27)
    with pytest.raises(op.ParameterError, match="GB of memory or more"):
        sampled(analyzed(), a=(0.3, 0.1), samples=1_000_000)
    assert sampled(analyzed(), a=(0.3, 0.1), samples=1_000).uncertainty_of("S0") > 0.0


def test_light_of_jax_has_samples_without_a_warning():
    pytest.importorskip("jax")
    given = {"a": (0.2, 0.03), "samples": 100}
    found = sampled(analyzed(), **given, composer=op.Composer(engine="jax"))
    plain = sampled(analyzed(), **given)
    np.testing.assert_allclose(found.uncertainties, plain.uncertainties, rtol=1e-9, atol=1e-12)
