"""Differences where they are hard, against derivatives in 50 digits."""

import mpmath
import numpy as np

import optipath as op
from tables import rows

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
