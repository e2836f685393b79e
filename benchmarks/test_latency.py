"""One path, plain floats in, a Stokes vector out."""

import math

import pytest

import optipath as op
from subjects import METAL, assignment

AT = {"delta": 0.7, "rho": 0.4, "phi": 0.2}


def by_hand(delta, rho, phi):
    """Return the Stokes vector as one would write it down with the math module."""

    def reflection(n, k, angle):
        c, s2 = math.cos(angle), math.sin(angle) ** 2
        x = n * n - k * k - s2
        root = math.sqrt(x * x + 4 * n * n * k * k)
        a2, b2 = 0.5 * (root + x), 0.5 * (root - x)
        a, b = math.sqrt(max(a2, 0.0)), math.sqrt(max(b2, 0.0))
        ab, t = a2 + b2, s2 / c
        Fs = (ab - 2 * a * c + c * c) / (ab + 2 * a * c + c * c)
        below = ab + 2 * a * t + t * t
        Fp = Fs * (ab - 2 * a * t + t * t) / below
        return 0.5 * (Fs + Fp), 0.5 * (Fs - Fp), Fs * (t * t - ab) / below, 2 * Fs * b * t / below

    A, B, C, S = reflection(METAL["n2"], METAL["k2"], phi)
    s0, s1, s2, s3 = 50 * (A + B), 50 * (A + B), 0.0, 0.0
    c2, sin2 = math.cos(2 * rho), math.sin(2 * rho)
    s1, s2 = c2 * s1 - sin2 * s2, c2 * s2 + sin2 * s1
    A, B, C, S = reflection(METAL["n1"], METAL["k1"], delta)
    return A * s0 + B * s1, B * s0 + A * s1, C * s2 + S * s3, C * s3 - S * s2


def timed(benchmark, action):
    return benchmark.pedantic(action, rounds=200, iterations=20, warmup_rounds=20)


@pytest.mark.benchmark(group="one path")
def test_by_hand(benchmark):
    found = timed(benchmark, lambda: by_hand(**AT))
    assert assignment(**METAL).trace(**AT).stokes.tolist() == pytest.approx(found, rel=1e-12)


@pytest.mark.benchmark(group="one path")
@pytest.mark.parametrize("composing", ["stokes", "jones"])
def test_a_plan(benchmark, composing):
    plan = op.Composer(composing=composing).compose(assignment(**METAL))
    timed(benchmark, lambda: plan.run(**AT).stokes)


@pytest.mark.benchmark(group="one path")
def test_a_plan_of_defaults_and_words(benchmark):
    plan = op.load_preset("npgr026").compose()
    timed(benchmark, lambda: plan.run(**AT, filter="horizontal").stokes)
