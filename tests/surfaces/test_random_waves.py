"""Random waves: their variances, the distribution of their slopes, and their sum."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optipath.surfaces.fields.random_waves import RandomWaves
from tables import rows

FALSE_ALARM = 1e-6
"""The chance that a right distribution fails a test of Kolmogorov and Smirnov here."""
alphas = st.floats(0.01, 3.0)
lengths = st.floats(10.0, 60.0)


def slopes_of(waves, x, y):
    """The slopes of a sum of cosines, by its derivative at each point."""
    angle = waves.phase + np.multiply.outer(x, waves.x_number)
    angle += np.multiply.outer(y, waves.y_number)
    amplitude = -waves.amplitude * np.sin(angle)
    return np.sum(amplitude * waves.x_number, -1), np.sum(amplitude * waves.y_number, -1)


def distance(sample, cumulative):
    """The largest distance of Kolmogorov and Smirnov, times the root of how many there are."""
    expected = cumulative(np.sort(sample))
    steps = np.arange(sample.size + 1) / sample.size
    found = max(np.max(steps[1:] - expected), np.max(expected - steps[:-1]))
    return found * np.sqrt(sample.size)


def limit(false_alarm):
    """What that exceeds with some probability, of many numbers: 2 exp(-2 d^2)."""
    return np.sqrt(np.log(2.0 / false_alarm) / 2.0)


def far_apart_slopes(alpha, rng, *, periodic=True):
    """Slopes at points 2.5 correlation lengths apart, of 16 surfaces."""
    period = tuple(80.0 / a for a in alpha)
    grid = np.arange(16) * 5.0
    x, y = (each.ravel() / a for each, a in zip(np.meshgrid(grid, grid), alpha, strict=True))
    found = []
    for seed in range(16):
        waves = RandomWaves.drawn(alpha, 1000, seed, period if periodic else None)
        start = rng.random(2) * period
        found.append(slopes_of(waves, x + start[0], y + start[1]))
    return np.concatenate(found, axis=1) / np.reshape(alpha, (2, 1))


@given(alphas, alphas, lengths, lengths, st.integers(10, 2000), st.integers(0, 1 << 40))
def test_every_surface_has_the_variances(alpha_x, alpha_y, long, wide, number, seed):
    for period in ((2.0 * long / alpha_x, 2.0 * wide / alpha_y), None):
        waves = RandomWaves.drawn((alpha_x, alpha_y), number, seed, period)
        power = waves.amplitude**2 / 2.0
        assert period or waves.phase.size == number
        assert np.sum(power) == pytest.approx(1.0, rel=1e-12)
        assert np.sum(power * waves.x_number**2) == pytest.approx(alpha_x**2 / 2.0, rel=1e-12)
        assert np.sum(power * waves.y_number**2) == pytest.approx(alpha_y**2 / 2.0, rel=1e-12)


@given(lengths, lengths, st.integers(1, 2000), st.integers(0, 1 << 40))
def test_periodic_waves_are_whole_and_none_interferes_with_another(long, wide, number, seed):
    period = np.array([2.0 * long, 2.0 * wide])
    waves = RandomWaves.drawn((1.0, 1.0), number, seed, tuple(period))
    counts = np.array([waves.x_number, waves.y_number]).T * period / (2.0 * np.pi)
    whole = np.rint(counts)
    assert np.allclose(counts, whole, rtol=0.0, atol=1e-9)
    both = np.concatenate([whole, -whole])
    assert len(np.unique(both, axis=0)) == len(both)


@given(st.integers(0, 1 << 40), st.floats(0.0, math.pi), st.sampled_from([None, (80.0, 40.0)]))
def test_heights_are_correlated_over_two_by_alpha(seed, turn, period):
    # The transform of the density of wave vectors, exp(-f^2 / alpha^2) / (pi alpha^2).
    alpha = (1.0, 2.0)
    waves = RandomWaves.drawn(alpha, 1000, seed, period)
    x, y = np.cos(turn) / alpha[0], np.sin(turn) / alpha[1]
    distance = np.linspace(0.0, 8.0, 33)
    along = waves.x_number * x + waves.y_number * y
    found = np.cos(np.multiply.outer(distance, along)) @ (waves.amplitude**2 / 2.0)
    assert np.max(np.abs(found - np.exp(-(distance**2) / 4.0))) < 0.02


@rows("number", [1, 2, 3, 5])
def test_a_few_waves_have_powers_all_the_same(number):
    for seed in range(20):
        waves = RandomWaves.drawn((1.0, 1.0), number, seed)
        assert np.all(np.isfinite(waves.amplitude))
        assert np.all(waves.amplitude >= 0.0)
        assert np.any(waves.amplitude > 0.0)


@rows("alpha", [(1.0, 1.0), (0.1, 0.1), (0.4, 0.1)])
@rows("periodic", [True, False])
def test_slopes_have_the_density_of_beckmann(alpha, periodic, rng):
    # exp(-tan^2 / alpha^2) / (pi alpha^2): squares of scaled slopes are exponential, directions
    # uniform.
    x, y = far_apart_slopes(alpha, rng, periodic=periodic)
    assert distance(x**2 + y**2, lambda square: -np.expm1(-square)) < limit(FALSE_ALARM)
    turned = np.arctan2(y, x) % (2.0 * np.pi)
    assert distance(turned, lambda turn: turn / (2.0 * np.pi)) < limit(FALSE_ALARM)


def test_the_slopes_test_tells_a_rougher_surface(rng):
    x, y = far_apart_slopes((1.0, 1.0), rng)
    wrong = 1.1 * (x**2 + y**2)
    assert distance(wrong, lambda square: -np.expm1(-square)) > limit(FALSE_ALARM)


@rows("period", [None, (20.0, 30.0)])
def test_heights_are_the_sum_of_cosines(period, rng):
    waves = RandomWaves.drawn((1.0, 0.7), 1000, 3, period)
    x, y = rng.uniform(-20.0, 20.0, 7), rng.uniform(-20.0, 20.0, 5)
    angle = waves.phase + np.multiply.outer(x, waves.x_number)
    angle = angle + np.multiply.outer(y, waves.y_number)[:, np.newaxis]
    expected = np.sum(waves.amplitude * np.cos(angle), -1)
    assert waves.heights(x, y) == pytest.approx(expected, abs=1e-12)


def test_heights_in_parts_of_rows_are_the_same_bits():
    waves = RandomWaves.drawn((1.0, 1.0), 1000, 0)
    x, y = np.linspace(0.0, 20.0, 5), np.linspace(0.0, 200.0, 2500)
    parts = [waves.heights(x, part) for part in (y[:7], y[7:])]
    assert np.array_equal(np.concatenate(parts), waves.heights(x, y))


def test_heights_are_the_same_bits_with_any_number_of_threads():
    code = (
        "from optipath.surfaces.fields.random_waves import RandomWaves as R; import hashlib as h;"
        "import numpy as n; x = n.linspace(0, 60, 300); w = R.drawn((1., 1.), 1000, 0);"
        "print(h.sha256(w.heights(x, x).tobytes()).hexdigest())"
    )
    found = set()
    for threads in "12":
        own = os.environ | {"OPENBLAS_NUM_THREADS": threads, "MKL_NUM_THREADS": threads}
        run = [sys.executable, "-c", code]
        found.add(subprocess.run(run, env=own, capture_output=True, check=True).stdout)
    assert len(found) == 1


def test_heights_of_many_surfaces_are_normal(rng):
    points, several = np.arange(8) * 10.0, []
    for seed in range(30):
        waves = RandomWaves.drawn((1.0, 1.0), 1000, seed, (80.0, 80.0))
        x, y = rng.uniform(0.0, 80.0, 2)
        several.append(waves.heights(points + x, points + y))
    erf = np.vectorize(math.erf)
    found = distance(np.ravel(several), lambda z: (1.0 + erf(z / np.sqrt(2.0))) / 2.0)
    assert found < limit(FALSE_ALARM)
