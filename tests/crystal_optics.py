"""Crystals and filters in 50 digits, written after the papers and not from the library."""

import mpmath
from mpmath import mpf

QUARTZ = {
    "o": ("1.28604141", ("1.07044083", "1.10202242"), ("1.00585997e-2", "100")),
    "e": ("1.28851804", ("1.09509924", "1.15662475"), ("1.02101864e-2", "100")),
}
"""G. Ghosh, Opt. Commun. 163, 95 (1999), table 2; wavelengths in micrometres."""

BK7 = (
    "1",
    ("1.03961212", "0.231792344", "1.01046945"),
    ("0.00600069867", "0.0200179144", "103.560653"),
)
"""SCHOTT, data sheet of N-BK7."""


def sellmeier(coefficients, wavelength):
    offset, strengths, poles = coefficients
    square = (wavelength * mpf(10) ** 6) ** 2
    pairs = zip(strengths, poles, strict=True)
    # The very floats that a coefficient is kept as.
    terms = [mpf(float(b)) * square / (square - mpf(float(c))) for b, c in pairs]
    return mpmath.sqrt(mpf(float(offset)) + mpmath.fsum(terms))


def retardance(thickness, wavelength):
    """Of a plate of quartz."""
    difference = sellmeier(QUARTZ["e"], wavelength) - sellmeier(QUARTZ["o"], wavelength)
    return 2 * mpmath.pi * thickness * difference / wavelength


def lyot(thickness, wavelength, stages=4):
    """What passes of unpolarised light."""
    passed = mpf(1) / 2
    for stage in range(stages):
        passed *= mpmath.cos(retardance(thickness * 2**stage, wavelength) / 2) ** 2
    return passed


def solc(thickness, wavelength, plates=6):
    """What passes of unpolarised light, each plate rocked by 45 deg / plates."""
    rocking = mpmath.pi / (4 * plates)
    turn = mpmath.acos(mpmath.cos(2 * rocking) * mpmath.sin(retardance(thickness, wavelength) / 2))
    many = mpmath.sin(plates * turn) / mpmath.sin(turn)
    return (mpmath.tan(2 * rocking) * mpmath.cos(turn) * many) ** 2 / 2


def rhomb(incidence, wavelength):
    """The retardance of two total reflections inside BK7."""
    other = 1 / sellmeier(BK7, wavelength) ** 2
    s, c = mpmath.sin(incidence), mpmath.cos(incidence)
    return 4 * mpmath.atan(c * mpmath.sqrt(s * s - other) / (s * s))
