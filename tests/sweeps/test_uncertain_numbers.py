"""Uncertainties by slopes and by samples, against closed forms and 50-digit derivatives."""

import tracemalloc
from itertools import product

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

import optipath as op
from chains import ENGINES
from optipath.light.quantities import QUANTITIES
from optipath.sweeps import monte_carlo
from optipath.sweeps.light_figures import UncertainValue, difference, figures_of, gradients_of
from optipath.sweeps.monte_carlo import DrawnSamples
from optipath.values import arrays as memory
from tables import rows, slow_except

METHODS = ["differences", *(["gradients"] if "jax" in ENGINES else [])]
each_method = pytest.mark.parametrize("method", METHODS)
LAMP = op.Source(stokes=[1, 1, 0, 0])
ANALYZED = LAMP >> op.Polarizer(op.Parameter("a")) >> op.Detector()
TURNED = LAMP >> op.Rotator(op.Parameter("a")) >> op.Detector()
BARE = op.Source(op.Parameter("i")) >> op.Detector()
DIMMED = op.Source(op.Parameter("i")) >> op.Polarizer(op.Parameter("a")) >> op.Detector()
POWERED = op.Source(op.Parameter("power", 2.0), stokes=[1, 1, 0, 0])
MALUS = POWERED >> op.Polarizer(op.Parameter("angle")) >> op.Detector()
INDEX = op.Material(op.Parameter("n"), op.Parameter("k"))
HAZE = op.Depolarizer(0.2)
MIRROR = op.Interface(INDEX, op.Parameter("theta"))
METAL = op.Source(stokes=[1, 0, 1, 0]) >> HAZE >> MIRROR >> op.Detector()
NPGR = op.load_preset("npgr026")


def by_slopes(path, /, **given):
    return path.propagate(method="differences", **given)


def sampled(path, /, **given):
    return path.propagate(method="monte-carlo", **given)


def assert_same_bits(one, other, order=1):
    """The same figures, and the same shares in the same or the opposite order."""
    assert_array_equal(one.uncertainties, other.uncertainties)
    assert_array_equal(one.covariance, other.covariance)
    assert_array_equal(one.shares, other.shares[:, ::order])


@pytest.mark.parametrize("method", slow_except(["differences"], METHODS))
def test_malus_and_glass_at_normal_incidence_are_those_of_closed_forms(method):
    # I = P cos^2 a: dI = -P sin 2a da + cos^2 a dP.
    found = MALUS.propagate(angle=(0.7, 0.003), method=method)
    assert_allclose(found.uncertainty_of("intensity"), 2.0 * np.sin(1.4) * 0.003, rtol=1e-10)
    found = MALUS.propagate(angle=(0.7, 0.003), power=(2.0, 0.01), method=method)
    by_angle, by_power = (2.0 * np.sin(1.4) * 0.003) ** 2, (np.cos(0.7) ** 2 * 0.01) ** 2
    shares, share = found.contributions, by_angle / (by_angle + by_power)
    assert_allclose([shares["angle"][0], shares["power"][0]], [share, 1.0 - share])
    assert found.contributions_to("S0")["angle"] == shares["angle"][0]
    # R = ((n - 1) / (n + 1))^2, dR/dn = 4 (n - 1) / (n + 1)^3.
    path = op.Source(100.0) >> op.Interface(op.Parameter("n"), 0.0) >> op.Detector()
    found = by_slopes(path, n=(1.5, 0.002)).uncertainty_of("S0")
    assert_allclose(found, 100.0 * 4.0 * 0.5 / 2.5**3 * 0.002, rtol=1e-10)


NAMES = ["S0", "S1", "S2", "S3", "dop", "dolp", "aop", "ellipticity", "psi", "delta"]
VALUES = {"n": 0.6, "k": 2.1, "theta": 1.1}
SIGMAS = {"n": 0.003, "k": 0.007, "theta": 0.002}
WITH_SIGMAS = {name: (VALUES[name], SIGMAS[name]) for name in VALUES}


def amplitudes(n, k, angle):
    """What a metal reflects of s and of p, by mpmath."""
    m, c = mpmath.mpc(n, k), mpmath.cos(angle)
    g = mpmath.sqrt(m**2 - mpmath.sin(angle) ** 2)
    return (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)


def of_metal(n, k, theta):
    """The light of METAL, whose S2 is 0.8 behind the depolariser, and its figures."""
    s, p = amplitudes(n, k, theta)
    across, fs, fp = 0.8 * s * mpmath.conj(p), abs(s) ** 2, abs(p) ** 2
    s0, s1, s2, s3 = stokes = (fs + fp) / 2, (fs - fp) / 2, across.real, -across.imag
    linear = mpmath.hypot(s1, s2)
    polarised = mpmath.hypot(linear, s3)
    aop = mpmath.atan2(s2, s1) / 2
    ellipticity = mpmath.tan(mpmath.asin(s3 / polarised) / 2)
    psi, delta = mpmath.acos(s1 / polarised) / 2, mpmath.atan2(-s3, s2)
    return [*stokes, polarised / s0, linear / s0, aop, ellipticity, psi, delta]


def slopes_of_metal():
    """The slope of each figure along each value, by derivatives in 50 digits."""

    def slope(at, order):
        return float(mpmath.diff(lambda *v: of_metal(*v)[at], tuple(VALUES.values()), order))

    with mpmath.workdps(50):
        orders = np.eye(3, dtype=int).tolist()
        return np.array([[slope(at, tuple(o)) for o in orders] for at in range(len(NAMES))])


@each_method
def test_all_figures_of_a_metal_follow_from_derivatives_in_50_digits(method):
    changes = slopes_of_metal() * [*SIGMAS.values()]
    found = METAL.propagate(**WITH_SIGMAS, method=method)
    uncertainties = [found.uncertainty_of(name) for name in NAMES]
    assert_allclose(uncertainties, np.linalg.norm(changes, axis=1), rtol=1e-8)
    shares = np.array([list(found.contributions_to(name).values()) for name in NAMES])
    assert_allclose(shares, changes**2 / np.sum(changes**2, axis=1, keepdims=True), atol=1e-8)
    assert_allclose(found.covariance, changes[:4] @ changes[:4].T, rtol=1e-8)


def test_correlated_values_follow_their_matrix_and_a_batch_is_each_of_its_paths():
    slopes, matrix = slopes_of_metal(), np.diag([s**2 for s in SIGMAS.values()])
    matrix[0, 1] = matrix[1, 0] = 0.6 * SIGMAS["n"] * SIGMAS["k"]
    found = by_slopes(METAL, **WITH_SIGMAS, correlation={("k", "n"): 0.6})
    covariance = slopes @ matrix @ slopes.T
    assert_allclose(found.covariance, covariance[:4, :4], rtol=1e-8)
    expected = np.sqrt(np.diag(covariance))
    assert_allclose([found.uncertainty_of(n) for n in NAMES], expected, rtol=1e-8)
    assert_allclose(sum(found.contributions.values()), 1.0)
    angles, sigmas = np.array([[0.3], [0.8]]), np.array([0.001, 0.02, 0.0])
    batch = by_slopes(MALUS, angle=(angles, sigmas), power=(2.0, 0.1))
    assert batch.light.shape == (2, 3)
    assert batch.covariance.shape == (2, 3, 4, 4)
    for place in np.ndindex(2, 3):
        angle = float(angles[place[0], 0]), sigmas[place[1]]
        one = by_slopes(MALUS, angle=angle, power=(2.0, 0.1))
        assert_allclose(batch.uncertainties[place], one.uncertainties, rtol=1e-9)
        assert_allclose(batch.shares[place], one.shares, atol=1e-9)
    angles = [0.1, 0.4]
    batch = sampled(ANALYZED, a=(angles, 0.05), samples=200).uncertainties
    alone = [sampled(ANALYZED, a=(a, 0.05), samples=200).uncertainties for a in angles]
    assert_allclose(batch, alone, rtol=1e-9, atol=1e-12)


@pytest.mark.skipif("jax" not in ENGINES, reason="JAX is not installed")
@pytest.mark.slow
@pytest.mark.parametrize("preset", ["lyot-filter", "ellipsometer-pcsa"])
def test_differences_are_the_gradients(preset):
    path = op.load_preset(preset)
    numbers = {n: p.default for n, p in path.compose().inputs.open.items()}
    given = {n: (v, 1e-3 * v or 1e-3) for n, v in numbers.items() if isinstance(v, float)}
    found, other = (path.propagate(**given, method=method).uncertainties for method in METHODS)
    assert_allclose(found, other, rtol=1e-7, atol=1e-14)


@settings(max_examples=20, deadline=None)
@given(angle=st.floats(0.05, 1.5), sigma=st.floats(1e-9, 1e-3), factor=st.floats(0.1, 100.0))
def test_uncertainties_are_proportional_to_sigma(angle, sigma, factor):
    one, more = (by_slopes(MALUS, angle=(angle, sigma * by)) for by in (1.0, factor))
    assert_allclose(more.uncertainties, factor * one.uncertainties, rtol=1e-12)


@settings(max_examples=4, deadline=None)
@given(st.floats(0.1, 1.4), st.floats(-3.0, 3.0), st.tuples(*[st.floats(1e-6, 1e-2)] * 3))
def test_covariances_are_positive_and_that_of_intensity_knows_no_frame(theta, turn, sigmas):
    values = zip((0.6, 2.1, theta), sigmas, strict=True)
    uncertain = dict(zip(("n", "k", "theta"), values, strict=True))
    found = by_slopes(METAL, **uncertain)
    values = np.linalg.eigvalsh(found.covariance)
    assert np.all(values >= -1e-12 * values.max())
    assert_allclose([sum(found.contributions_to(name).values()) for name in NAMES], 1.0)
    # Light of +45 degrees to a plane that stands at some angle.
    lamp = op.Source(stokes=[1, -np.sin(2 * turn), np.cos(2 * turn), 0.0])
    turned = op.Interface(INDEX, op.Parameter("theta"), azimuth=turn)
    other = by_slopes(lamp >> HAZE >> turned >> op.Detector(), **uncertain)
    for name in ("intensity", "dop", "ellipticity"):
        one, again = found.uncertainty_of(name), other.uncertainty_of(name)
        assert_allclose(one, again, rtol=1e-7, atol=1e-15)


def slope_in_50_digits(values, place, inwards):
    """The slope of unpolarised light; at the upper or the lower end of a range from inside."""

    def reflected(by):
        s, p = amplitudes(*[v + (at == place) * by for at, v in enumerate(values)])
        return (abs(s) ** 2 + abs(p) ** 2) / 2

    with mpmath.workdps(50):
        upper, lower = (0 if end else mpmath.mpf(10) ** -18 for end in inwards)
        return float((reflected(upper) - reflected(-lower)) / (upper + lower))


@pytest.mark.parametrize(
    "angle",
    slow_except(
        (1e-9, 0.98, np.pi / 2),
        (1e-9, 1e-6, 1e-3, 0.5, 0.98, np.pi / 2 - 1e-3, np.pi / 2 - 1e-6, np.pi / 2),
    ),
)
@rows("index", [(1.5, 0.0), (0.6, 2.1), (1.2, 1e-6)])
def test_slopes_go_to_the_ends_of_ranges(angle, index):
    path = op.Source() >> op.Interface(INDEX, op.Parameter("angle")) >> op.Detector()
    values = dict(zip(("n", "k", "angle"), (*index, angle), strict=True))
    for place, name in enumerate(values):
        inwards = name == "angle" and angle == np.pi / 2, name == "k" and index[1] == 0.0
        slope = slope_in_50_digits([*values.values()], place, inwards)
        found = by_slopes(path, **values | {name: (values[name], 1e-3)}).uncertainty[0]
        assert_allclose(found, 1e-3 * abs(slope), rtol=1e-7, atol=1e-10)


def test_many_waves_wavelengths_and_thick_media_have_steps_of_their_own_size():
    # I = (1 + cos p) / 2, the phase p = 2 pi W l / l0 plus an eighth of a wave.
    for waves in (1, 20, 1000, 12345.25):
        length, phase = 2e-3, 2 * np.pi * waves
        plate = op.Medium(op.Parameter("l"), retardance=phase / length, angle="45 deg")
        path = LAMP >> plate >> op.Retarder("45 deg", "45 deg") >> op.Polarizer(0.0)
        found = by_slopes(path >> op.Detector(), l=(length, 1e-12)).uncertainty[0]
        slope = np.sin(phase + np.pi / 4) / 2 * phase / length
        assert_allclose(found, abs(slope) * 1e-12, rtol=1e-7)
    path = op.load_preset("quartz-quarter-wave")
    waves = path.compose().inputs.open["wavelength"].default
    near = [path.trace(wavelength=waves + by).stokes for by in (-1e-13, 1e-13)]
    expected = np.abs(near[1] - near[0]) / 2e-13 * 1e-9
    found = by_slopes(path, wavelength=(waves, 1e-9)).uncertainty
    assert_allclose(found, expected, rtol=1e-5, atol=1e-8)
    # I = exp(-a L): dI/da = -L I, with a step that is small against 1 / L.
    path = op.Source() >> op.Medium("10 m", absorption=op.Parameter("a")) >> op.Detector()
    found = by_slopes(path, a=(1e-3, 1e-6)).uncertainty[0]
    assert_allclose(found, 10.0 * np.exp(-0.01) * 1e-6, rtol=1e-9)
    assert_allclose(by_slopes(path, a=(0.0, 1e-6)).uncertainty[0], 10.0 * 1e-6, rtol=1e-7)
    # exp(-a L) varies by a s = 100 / cm x 1 um = 1 %.
    medium = op.Medium(length=op.Parameter("L"), absorption="100 1/cm")
    found = sampled(op.Source(1) >> medium >> op.Detector(), L=("4 cm", "1 um"))
    assert_allclose(found.uncertainty[0] / found.light.stokes[0], 0.01, rtol=0.03)


@rows("stokes", [[1, 0.1, 0.2, 0.3], [2, -0.3, 0.1, -0.5], [1, 0.6, 0.8, 0], [3, 0, 1, 1]])
def test_gradients_of_every_quantity_are_what_small_changes_do(stokes):
    light, step = op.Light([stokes, stokes]), 1e-6
    assert figures_of(light).shape == (2, len(QUANTITIES))
    assert gradients_of(light).shape == (2, len(QUANTITIES), 4)
    for scale, place in product((1.0, 1e-100), range(4)):
        by = step * np.eye(4)[place]
        ends = [op.Light((stokes + s * by) * scale, physical=False) for s in (1.0, -1.0)]
        slope = difference(*map(figures_of, ends)) / (2.0 * step * scale)
        found = gradients_of(op.Light(np.multiply(stokes, scale)))[:, place]
        assert_allclose(found * scale, slope * scale, atol=1e-8)


def test_angles_differ_and_are_spread_by_the_shorter_way_round():
    ends = [op.Light([1.0, -1.0, s, 0.0], physical=False) for s in (1e-3, -1e-3)]
    assert_allclose(difference(*map(figures_of, ends))[6], -1e-3, rtol=1e-5)
    found = sampled(TURNED, a=(np.pi / 2, 0.01))
    assert_allclose(found.uncertainty_of("aop"), 0.01, rtol=0.05)


@rows("method", ["monte-carlo", "differences"])
def test_faint_and_bright_light_is_as_uncertain_as_any(method):
    uncertain = {"a": (0.3, 0.01), "method": method}
    plain = DIMMED.propagate(i=(1.0, 0.01), **uncertain)
    for size in (1e-300, 1e-160, 1e155, 1e300):
        found = DIMMED.propagate(i=(size, 0.01 * size), **uncertain)
        assert_allclose(found.uncertainty / size, plain.uncertainty, rtol=1e-6, atol=1e-12)
        assert_allclose(found.shares[:4], plain.shares[:4], atol=1e-6)
        assert_allclose(found.mean / size, plain.mean, rtol=1e-12, atol=1e-15)


def value(name, low=-np.inf, high=np.inf):
    return UncertainValue(name, np.array(0.0), np.array(1.0), low, high, "")


def drawn(values, places, correlation=None, count=5_000, block=None):
    correlation = np.eye(len(values)) if correlation is None else np.asarray(correlation)
    samples = DrawnSamples(values, correlation, places, count, 1, 0)
    return samples.within(block or slice(0, count), [each.name for each in values])


def test_samples_of_a_value_do_not_change_with_others_and_are_cut_off_by_themselves():
    a, b, c = value("a"), value("b", low=0.0), value("c", high=0.0)
    alone = drawn([b], [1])["b"]
    for values, places in ([[a, b, c], [0, 1, 2]], [[c, b], [2, 1]]):
        assert_array_equal(drawn(values, places)["b"], alone)
    assert_array_equal(drawn([b, a], [1, 0], block=slice(400, 900))["b"], alone[400:900])
    # Of 30 half-normals 1e-9 of all samples were inside at once.
    values = [value(f"a{number}", low=0.0) for number in range(30)]
    for samples in drawn(values, range(30)).values():
        assert samples.min() >= 0.0
        assert_allclose(samples.mean(), np.sqrt(2.0 / np.pi), rtol=0.06)
    # A tenth of the sigma to both sides: nearly uniform, 8 % inside.
    (samples,) = drawn([value("a", low=-0.1, high=0.1)], [0]).values()
    assert np.abs(samples).max() <= 0.1
    assert_allclose(samples.std(), 0.2 / np.sqrt(12.0), rtol=0.03)


def test_ranges_that_hardly_any_sample_is_in_and_blocks_too_large_are_refused(monkeypatch):
    narrow, halves = value("a", low=-1e-5, high=1e-5), [value(name, low=0.0) for name in "ab"]
    path = op.Source() >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    for ask, told in (
        (lambda: drawn([value("b"), narrow], [0, 1]), "of a is within the range"),
        (lambda: drawn(halves, [0, 1], [[1.0, -1.0], [-1.0, 1.0]]), "of a and b"),
        (lambda: sampled(path, t=(0.5, 1e6), samples=100), "of t is within the range"),
    ):
        with pytest.raises(op.errors.ParameterError, match=f"hardly any sample {told}"):
            ask()
    tracemalloc.start()
    try:
        drawn([value("a", low=0.0)], [0], count=10_000_000, block=slice(5_000_000, 5_000_010))
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()
    monkeypatch.setattr(memory, "memory", lambda: 2**27)
    with pytest.raises(op.errors.ParameterError, match="GB of memory or more"):
        sampled(ANALYZED, a=(0.3, 0.1), samples=1_000_000)
    assert sampled(ANALYZED, a=(0.3, 0.1), samples=1_000).uncertainty_of("S0") > 0.0


def test_small_uncertainties_and_correlated_ones_are_those_of_the_first_order():
    asked = {"n1": (1.12, 0.001), "k1": (2.16, 0.001), "delta": (0.8, 0.001), "phi": (0.3, 0.002)}
    first, found = by_slopes(NPGR, **asked), sampled(NPGR, **asked, samples=20_000)
    # The relative standard deviation of a standard deviation of M samples is 1 / sqrt(2 M).
    there = first.uncertainties > 1e-12
    assert there.sum() > 3
    one, other = (each.uncertainties[there] for each in (found, first))
    assert_allclose(one, other, rtol=5.0 / np.sqrt(40_000))
    assert_allclose(found.shares[there], first.shares[there], atol=0.03)
    assert_allclose(found.covariance[0, 1], first.covariance[0, 1], rtol=0.05)
    path = LAMP >> op.Rotator(op.Parameter("a")) >> op.Attenuator(op.Parameter("t"))
    asked = {"a": (0.3, 0.01), "t": (0.5, 0.01), "correlation": {("a", "t"): -0.7}}
    path = path >> op.Detector()
    first = by_slopes(path, **asked).covariance
    found = sampled(path, **asked, samples=40_000).covariance
    size = np.sqrt(np.outer(np.diag(first), np.diag(first)))
    assert np.all(np.abs(found - first) <= 0.03 * size + 1e-12)


def test_an_extremum_and_the_end_of_a_range_have_the_moments_of_closed_forms_and_it_is_told():
    # I = cos^2 a = (1 + cos 2a) / 2, and the mean of cos 2a is exp(-2 s^2) about 0.
    sigma, count = 0.2, 40_000
    found = sampled(ANALYZED, a=(0.0, sigma), samples=count)
    mean = (1.0 + np.exp(-2.0 * sigma**2)) / 2.0
    deviation = np.sqrt((1.0 + np.exp(-8.0 * sigma**2)) / 8.0 - np.exp(-4.0 * sigma**2) / 4.0)
    assert abs(found.mean[0] - mean) < 5.0 * deviation / np.sqrt(count)
    assert_allclose(found.uncertainty_of("S0"), deviation, rtol=0.04)
    # Half of a normal distribution: its mean is s sqrt(2 / pi), its variance s^2 (1 - 2 / pi).
    found = sampled(BARE, i=(0.0, 0.5), samples=count)
    assert_allclose(found.mean[0], 0.5 * np.sqrt(2.0 / np.pi), rtol=0.02)
    assert_allclose(found.uncertainty_of("S0"), 0.5 * np.sqrt(1.0 - 2.0 / np.pi), rtol=0.02)
    (note,) = found.notes
    assert "of 40,000 samples were outside its range, 0 or more, and were drawn again" in note
    # It is cut off for its own paths alone.
    found = sampled(BARE, i=([0.0, 100.0], 0.5), samples=5_000).uncertainty_of("S0")
    assert found[0] < 0.35
    assert_allclose(found[1], 0.5, rtol=0.05)


def test_one_seed_has_one_result_whatever_the_engine_the_order_and_the_size_of_blocks(monkeypatch):
    asked = {"a": (0.3, 0.1), "samples": 100}
    one, same, other = (sampled(ANALYZED, **asked, seed=seed) for seed in (3, 3, 4))
    assert_same_bits(one, same)
    assert one.uncertainty_of("S0") != other.uncertainty_of("S0")
    assert one.method == "Monte Carlo, 100 samples, seed 3"
    if "jax" in ENGINES:  # Without a warning.
        same = sampled(ANALYZED, **asked, seed=3, composer=op.Composer(engine="jax"))
        assert_allclose(same.uncertainties, one.uncertainties, rtol=1e-9, atol=1e-12)
    asked = {"delta": (0.8, 0.1), "n1": (1.1, 0.1), "k1": (2.2, 0.1), "samples": 100}
    asked["correlation"] = {("k1", "n1"): 0.3}
    backwards = dict([*asked.items()][::-1])
    assert_same_bits(sampled(NPGR, **asked), sampled(NPGR, **backwards), order=-1)
    path = op.load_preset("copper-gold-spectrum")
    asked = {"delta": (0.8, 0.1), "wavelength": ([516e-9, 520e-9], 1e-9), "samples": 100}
    whole = sampled(path, **asked)
    for size in (2, 14, 64):
        monkeypatch.setattr(monte_carlo, "PATHS", size)
        assert_same_bits(whole, sampled(path, **asked))


def test_what_values_do_together_is_the_share_of_none_and_samples_are_within_ranges_and_tables():
    # I t about 0: neither changes the light without the other.
    path = LAMP >> op.Polarizer(op.Parameter("a")) >> op.Polarizer(op.Parameter("b"))
    found = sampled(path >> op.Detector(), a=(0.0, 0.1), b=(np.pi / 2, 0.1))
    assert sum(found.contributions_to("S0").values()) < 0.9
    # Figures that are none have no uncertainty.
    path = LAMP >> op.Depolarizer(op.Parameter("d")) >> op.Detector()
    found = sampled(path, d=(1.0, 0.1), samples=100)
    assert np.isnan(found.uncertainty_of("aop"))
    assert 0.03 < found.uncertainty_of("dop") < 0.1
    path = op.load_preset("npgr026", case=7)
    found = sampled(path, delta=(0, 1e-6), k1=(0, 1e-6), k2=(0, 1e-6), samples=1_000)
    assert np.all(np.isfinite(found.uncertainty))
    table = op.Material.tabulated([400e-9, 450e-9, 500e-9], [1.4, 1.5, 1.6])
    path = LAMP >> op.Interface(table, op.Parameter("i")) >> op.Detector()
    found = sampled(path, i=0.5, wavelength=("450 nm", "500 nm"), samples=500)
    assert 0.0 < found.uncertainty_of("S0") < 0.1
