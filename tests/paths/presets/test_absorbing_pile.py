"""The preset of tinted plates against the closed form that Stokes found for a pile of them."""

import mpmath
import pytest

import optipath as op
from optipath.paths.presets.loader import load_preset

PLATES = 4


def plate(polarization, n, k, depth, incidence):
    """What one plate reflects and lets through, by Fresnel's equations for waves that fade."""
    m, y = mpmath.mpc(n, k), mpmath.sin(incidence)
    c, g = mpmath.cos(incidence), mpmath.sqrt(m * m - y * y)
    first, second = (c, g) if polarization == "s" else (c, g / (m * m))
    R = abs((first - second) / (first + second)) ** 2
    T = abs(2 * first / (first + second)) ** 2 * second.real / first
    T_back = abs(2 * second / (first + second)) ** 2 * first / second.real
    t = mpmath.exp(-depth * g.imag)
    rounds = 1 / (1 - R * R * t * t)
    return R + T * T_back * R * t * t * rounds, T * T_back * t * rounds


def pile(R, T):
    """R and T of a pile (G. G. Stokes, Proc. R. Soc. Lond. 11, 545 (1862))."""
    root = mpmath.sqrt((1 + R + T) * (1 + R - T) * (1 - R + T) * (1 - R - T))
    a, b = (1 + R * R - T * T + root) / (2 * R), (1 - R * R + T * T + root) / (2 * T)
    bottom = a * b**PLATES - 1 / (a * b**PLATES)
    return (b**PLATES - b**-PLATES) / bottom, (a - 1 / a) / bottom


@pytest.mark.parametrize("case", ["tinted", "normal", "smoked"])
def test_the_cases_are_stokes_formula_in_50_digits(case):
    path = load_preset("absorbing-pile", case=case)
    values = {name: parameter.default for name, parameter in path.parameters.items()}
    with mpmath.workdps(50):
        depth = 4 * mpmath.pi * mpmath.mpf(values["thickness"]) / mpmath.mpf(values["wavelength"])
        of_plate = [mpmath.mpf(values[name]) for name in ("n", "k")]
        # At Brewster's angle a plate reflects next to nothing of p.
        (Rs, Ts), (Rp, Tp) = (
            pile(*plate(way, *of_plate, depth, mpmath.mpf(values["theta"]))) for way in "sp"
        )
        exact = {"reflected": (Rs, Rp), "transmitted": (Ts, Tp)}
        for name, light in path.trace_all().items():
            s, p = exact[name]
            assert light.stokes[0] == pytest.approx(float((s + p) / 2), rel=1e-12)
            assert light.stokes[1] == pytest.approx(float((s - p) / 2), rel=1e-12, abs=1e-15)


def test_a_clear_pile_absorbs_nothing_and_is_the_lossless_stack():
    lights = op.load_preset("absorbing-pile", case="clear").trace_all()
    assert sum(light.intensity for light in lights.values()) == pytest.approx(1.0, abs=1e-15)
    lossless = op.LayerStack([1.0] + [1.5, 1.0] * 4, "56.309932474020215 deg")
    expected = lossless.mueller("in", "transmitted").matrix[:, 0]
    assert lights["transmitted"].stokes == pytest.approx(expected, abs=1e-15)
