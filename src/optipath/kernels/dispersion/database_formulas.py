"""The dispersion formulas 1 to 9 of refractiveindex.info, as its pages number them.

All give n of wavelengths w in micrometres and of the coefficients C1, C2, ... of a page, in the
order of the database's document "Dispersion formulas" (M. N. Polyanskiy, Sci. Data 11, 94, 2024).
Where that comes to no number, n is NaN.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.dispersion.sellmeier import index_of_square, sellmeier_square

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    Formula = Callable[[Any, Any, Sequence[float]], Any]


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


def _by_powers(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 5, after Cauchy: n = C1 + C2 w^C3 + ..."""
    del xp
    return c[0] + _powers(w, c[1:])


def _of_gases(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 6: n - 1 = C1 + C2/(C3 - w^-2) + ..."""
    del xp
    return 1.0 + c[0] + sum(a / (b - w**-2) for a, b in _grouped(c[1:], 2))


def _herzberger(xp: Any, w: Any, c: Sequence[float]) -> Any:
    """Return n by formula 7: n = C1 + C2 L + C3 L^2 + C4 w^2 + ..., L = 1/(w^2 - 0.028)."""
    del xp
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

    Examples
    --------
    >>> coefficients_fit(2, 7), coefficients_fit(2, 6), coefficients_fit(8, 4)
    (True, False, True)
    """
    if number in _COUNTS:
        return count in _COUNTS[number]
    return count % 2 == 1


_COUNTS = {4: (1, 5, *range(9, 101, 2)), 7: range(3, 101), 8: (4,), 9: (6,)}
"""How many coefficients these formulas have; the others have one and then pairs."""
