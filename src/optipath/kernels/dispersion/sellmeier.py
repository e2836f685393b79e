"""The formulas of Sellmeier and Cauchy, of what is transparent."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence


def sellmeier_square(
    xp: Any, wavelength: Any, offset: Any, strengths: Sequence[Any], poles: Sequence[Any]
) -> Any:
    """Return n^2 = offset + the sum of B w^2 / (w^2 - C).

    W. Sellmeier, Annalen der Physik 219, 272 (1871); in the form of the catalogues of glass.

    Units: wavelength in micrometres; strengths, poles in square micrometres.

    Examples
    --------
    >>> import numpy as np
    >>> b, c = (1.03961212, 0.231792344, 1.01046945), (0.00600069867, 0.0200179144, 103.560653)
    >>> round(float(np.sqrt(sellmeier_square(np, 0.5876, 1.0, b, c))), 5)  # BK7
    1.5168
    """
    square = wavelength * wavelength
    found = offset + 0.0 * square
    for strength, pole in zip(strengths, poles, strict=True):
        beyond = square - pole
        at_resonance = beyond == 0.0
        term = strength * square / xp.where(at_resonance, 1.0, beyond)
        found = found + xp.where(at_resonance, xp.nan, term)
    return found


def index_of_square(xp: Any, square: Any) -> Any:
    """Return n of n^2; NaN where that is not above 0."""
    there = square > 0.0
    return xp.where(there, xp.sqrt(xp.where(there, square, 1.0)), xp.nan)


def cauchy_index(xp: Any, wavelength: Any, coefficients: Sequence[Any]) -> Any:
    """Return n = A + B / w^2 + C / w^4 + ...

    A.-L. Cauchy, Memoire sur la dispersion de la lumiere (1836).

    Units: wavelength in micrometres; coefficients in square micrometres.

    Examples
    --------
    >>> import numpy as np
    >>> float(cauchy_index(np, 0.5, [1.5, 0.004]))
    1.516
    """
    per_square = 1.0 / (wavelength * wavelength)
    found = xp.zeros_like(per_square)
    for coefficient in reversed(coefficients):
        found = found * per_square + coefficient
    return found
