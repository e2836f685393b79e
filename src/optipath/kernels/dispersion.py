"""Dispersion formulas: the complex index of refraction by wavelength.

All give n of wavelengths w in micrometres and of the coefficients C1, C2, ... of a page, in the
order of the database's document "Dispersion formulas" (M. N. Polyanskiy, Sci. Data 11, 94, 2024).
Where that comes to no number, n is NaN.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    Formula = Callable[[Any, Any, Sequence[float]], Any]


def sellmeier_square(
    xp: Any, wavelength: Any, offset: Any, strengths: Sequence[Any], poles: Sequence[Any]
) -> Any:
    """Return n^2 = offset + the sum of B w^2 / (w^2 - C).

    W. Sellmeier, Annalen der Physik 219, 272 (1871); in the form of the catalogues of glass. Units:
    wavelength in micrometres; strengths, poles in square micrometres.

    >>> import numpy as np
    >>> b, c = (1.03961212, 0.231792344, 1.01046945), (0.00600069867, 0.0200179144, 103.560653)
    >>> round(float(np.sqrt(sellmeier_square(np, 0.5876, 1.0, b, c))), 5)  # BK7
    1.5168
    """
    square = wavelength * wavelength
    result = offset + 0.0 * square
    for strength, pole in zip(strengths, poles, strict=True):
        beyond = square - pole
        at_resonance = beyond == 0.0
        term = strength * square / xp.where(at_resonance, 1.0, beyond)
        result = result + xp.where(at_resonance, xp.nan, term)
    return result


def index_of_square(xp: Any, square: Any) -> Any:
    """Return n of n^2; NaN where that is not above 0."""
    there = square > 0.0
    return xp.where(there, xp.sqrt(xp.where(there, square, 1.0)), xp.nan)


def cauchy_index(xp: Any, wavelength: Any, coefficients: Sequence[Any]) -> Any:
    """Return n = A + B / w^2 + C / w^4 + ...

    A.-L. Cauchy, Memoire sur la dispersion de la lumiere (1836). Units: wavelength in micrometres;
    coefficients in square micrometres.

    >>> import numpy as np
    >>> float(cauchy_index(np, 0.5, [1.5, 0.004]))
    1.516
    """
    per_square = 1.0 / (wavelength * wavelength)
    result = xp.zeros_like(per_square)
    for coefficient in reversed(coefficients):
        result = result * per_square + coefficient
    return result


def _grouped(coefficients: Sequence[float], size: int) -> Iterator[Sequence[float]]:
    """Yield the terms of a sum, those left out whose factor is 0."""
    for at in range(0, len(coefficients), size):
        if coefficients[at]:
            yield coefficients[at : at + size]


def _powers(w: Any, coefficients: Sequence[float]) -> Any:
    return sum(factor * w**power for factor, power in _grouped(coefficients, 2))


def _sellmeier_by_wavelengths(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 1: n^2 - 1 = C1 + C2 w^2/(w^2 - C3^2) + ..."""
    squares = [value if at % 2 else value**2 for at, value in enumerate(c)]
    return _sellmeier_by_squares(xp, w, [c[0], *squares[1:]])


def _sellmeier_by_squares(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 2: n^2 - 1 = C1 + C2 w^2/(w^2 - C3) + ..."""
    return index_of_square(xp, sellmeier_square(xp, w, 1.0 + c[0], c[1::2], c[2::2]))


def _polynomial(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 3: n^2 = C1 + C2 w^C3 + ..."""
    return index_of_square(xp, c[0] + _powers(w, c[1:]))


def _poles_and_powers(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 4: n^2 = C1 + C2 w^C3/(w^2 - C4^C5) + the like + C10 w^C11 + ..."""
    poles = [
        factor * w**power / (w**2 - place**of_place)
        for factor, power, place, of_place in _grouped(c[1:9], 4)
    ]
    return index_of_square(xp, c[0] + sum(poles) + _powers(w, c[9:]))


def _by_powers(_: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 5, after Cauchy: n = C1 + C2 w^C3 + ..."""
    return c[0] + _powers(w, c[1:])


def _of_gases(_: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 6: n - 1 = C1 + C2/(C3 - w^-2) + ..."""
    return 1.0 + c[0] + sum(a / (b - w**-2) for a, b in _grouped(c[1:], 2))


def _herzberger(_: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 7: n = C1 + C2 L + C3 L^2 + C4 w^2 + ..., L = 1/(w^2 - 0.028)."""
    lorentz = 1.0 / (w**2 - 0.028)
    rest = sum(factor * w ** (2 * at) for at, factor in enumerate(c[3:], 1))
    return c[0] + c[1] * lorentz + c[2] * lorentz**2 + rest


def _retro(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 8: (n^2 - 1)/(n^2 + 2) = C1 + C2 w^2/(w^2 - C3) + C4 w^2."""
    ratio = c[0] + c[1] * w**2 / (w**2 - c[2]) + c[3] * w**2
    return index_of_square(xp, (1.0 + 2.0 * ratio) / (1.0 - ratio))


def _exotic(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 9: n^2 = C1 + C2/(w^2 - C3) + C4 (w - C5)/((w - C5)^2 + C6)."""
    off = w - c[4]
    return index_of_square(xp, c[0] + c[1] / (w**2 - c[2]) + c[3] * off / (off**2 + c[5]))


DATABASE_FORMULAS: dict[int, Formula] = {
    1: _sellmeier_by_wavelengths,
    2: _sellmeier_by_squares,
    3: _polynomial,
    4: _poles_and_powers,
    5: _by_powers,
    6: _of_gases,
    7: _herzberger,
    8: _retro,
    9: _exotic,
}
"""Each by its number: functions of ``numpy`` or ``jax.numpy``, w and the coefficients."""


def coefficients_fit(number: int, count: int) -> bool:
    """Tell whether a formula may have so many coefficients.

    >>> coefficients_fit(2, 7), coefficients_fit(2, 6), coefficients_fit(8, 4)
    (True, False, True)
    """
    return count in _COUNTS[number] if number in _COUNTS else count % 2 == 1


_COUNTS = {4: (1, 5, *range(9, 101, 2)), 7: range(3, 101), 8: (4,), 9: (6,)}
"""How many coefficients these formulas have; the others have one and then pairs."""


def drude_lorentz_permittivity(
    energy: Any, background: Any, plasma: Any, free: Any, bound: Sequence[Any]
) -> tuple[Any, Any]:
    """Return the permittivity of electrons that are free, and of some bound to an energy each.

    eps = background - f0 wp^2 / (w^2 + i g0 w) + the sum of f wp^2 / (w0^2 - w^2 - i g w), of a
    field exp(-iwt): F. Wooten, Optical Properties of Solids (1972), chapter 3; in the form of A. D.
    Rakic et al., Appl. Opt. 37, 5271 (1998), eqs. 1 to 3, whose field is exp(+iwt). Units: energy
    in electronvolts.

    >>> gold = [(0.024, 0.415, 0.241), (0.010, 0.830, 0.345)]
    >>> real, imaginary = drude_lorentz_permittivity(1.0, 1.0, 9.03, (0.760, 0.053), gold)
    >>> round(real, 3), round(imaginary, 3)
    (-64.152, 5.213)
    """
    square, strength = energy * energy, plasma * plasma
    f0, g0 = free
    real = background - f0 * strength / (square + g0 * g0)
    imaginary = f0 * strength * g0 / (energy * (square + g0 * g0))
    for f, w0, g in bound:
        away, damped = (w0 - energy) * (w0 + energy), g * energy
        size = f * strength / (away * away + damped * damped)
        real, imaginary = real + size * away, imaginary + size * damped
    return real, imaginary


def tauc_lorentz_permittivity(
    xp: Any, energy: Any, amplitude: Any, resonance: Any, broadening: Any, gap: Any
) -> tuple[Any, Any]:
    """Return what an oscillator above a gap adds to the permittivity.

    G. E. Jellison and F. A. Modine, Appl. Phys. Lett. 69, 371 (1996), with the erratum, 2137. The
    logarithms of the real part are taken together, so that what becomes infinite at the gap, and
    cancels there, does not stand in it. Units: energy in electronvolts.

    >>> import numpy as np
    >>> silicon = tauc_lorentz_permittivity(np, 3.5, 122.0, 3.45, 2.54, 1.2)
    >>> [round(float(part), 3) for part in silicon]
    [5.113, 20.414]
    """
    e, a, e0, c, eg = energy, amplitude, resonance, broadening, gap
    ee, e0e0, cc, egeg = e * e, e0 * e0, c * c, eg * eg
    alpha = xp.sqrt(4.0 * e0e0 - cc)
    beyond = ee - e0e0
    zeta = beyond * beyond + cc * ee
    above = e - eg
    inside = xp.where(above > 0.0, above, 0.0)
    imaginary = a * e0 * c * inside * inside / (zeta * e)

    by_log = (egeg - e0e0) * ee + egeg * cc - e0e0 * (e0e0 + 3.0 * egeg)
    by_angle = beyond * (e0e0 + egeg) + egeg * cc
    sum_of = e0e0 + egeg
    first = c * by_log / (2.0 * alpha * e0) * xp.log((sum_of + alpha * eg) / (sum_of - alpha * eg))
    angles = math.pi - xp.arctan((2.0 * eg + alpha) / c) + xp.arctan((alpha - 2.0 * eg) / c)
    second = by_angle / e0 * angles
    gamma = e0e0 - 0.5 * cc
    turn = math.pi + 2.0 * xp.arctan(2.0 * (gamma - egeg) / (alpha * c))
    third = 2.0 * e0 * eg / alpha * (ee - gamma) * turn
    gap_square = (e0e0 - egeg) * (e0e0 - egeg) + egeg * cc
    total = e + eg
    # Of |E - Eg| / (E + Eg): next to the gap as it stands, far from it of what it is less than 1.
    distance = xp.where(above < 0.0, -above, above)
    is_near, at_gap = distance < 0.5 * total, distance == 0.0
    near = xp.log(xp.where(is_near & ~at_gap, distance, total) / total)
    far = xp.log1p(xp.where(is_near, 0.0, -2.0 * xp.where(e < eg, e, eg) / total))
    ratio = near + far
    logs = above * above / e * ratio + eg * xp.log(gap_square / (total * total * total * total))
    real = a / (math.pi * zeta) * (first - second + third - e0 * c * logs)
    return real, imaginary


def index_of_permittivity(xp: Any, real: Any, imaginary: Any) -> tuple[Any, Any]:
    """Return n and k with (n + ik)^2 = real + i imaginary, both of them not negative.

    The field is exp(-iwt), so that what absorbs has a positive imaginary part. Slopes are finite
    but where the permittivity is 0.

    >>> import numpy as np
    >>> n, k = index_of_permittivity(np, 3.0, 4.0)
    >>> float(n), float(k)
    (2.0, 1.0)
    """
    is_metal = real < 0.0
    dark = (real == 0.0) & (imaginary == 0.0)
    one = xp.where(dark, 1.0, xp.where(is_metal, -real, real))
    larger = xp.sqrt(0.5 * (xp.sqrt(one * one + imaginary * imaginary) + one))
    smaller = 0.5 * imaginary / larger
    larger = xp.where(dark, 0.0, larger)
    return xp.where(is_metal, smaller, larger), xp.where(is_metal, larger, smaller)
