import numpy as np
import pytest

import optipath as op
from optipath.sweeps.uncertainty import monte_carlo
from optipath.values.arrays import memory

SPECTRAL = "copper-gold-spectrum"


def lamp():
    return op.Source(stokes=[1, 1, 0, 0])


def malus():
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
    found = sampled(malus(), a=(0.0, sigma), samples=count)
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
    path, given = malus(), {"a": (0.3, 0.1), "samples": 100}
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
    batch = sampled(malus(), a=(angles, 0.05), samples=200)
    alone = [sampled(malus(), a=(angle, 0.05), samples=200).uncertainties for angle in angles]
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


def test_a_range_that_hardly_any_sample_is_in_is_refused():
    path = op.Source() >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    with pytest.raises(op.ParameterError, match="hardly any sample of t is within the range"):
        sampled(path, t=(0.5, 1e6), samples=100)


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
        sampled(malus(), a=(0.3, 0.1), samples=1_000_000)
    assert sampled(malus(), a=(0.3, 0.1), samples=1_000).uncertainty_of("S0") > 0.0


def test_light_of_jax_has_samples_without_a_warning():
    pytest.importorskip("jax")
    given = {"a": (0.2, 0.03), "samples": 100}
    found = sampled(malus(), **given, composer=op.Composer(engine="jax"))
    plain = sampled(malus(), **given)
    np.testing.assert_allclose(found.uncertainties, plain.uncertainties, rtol=1e-9, atol=1e-12)
