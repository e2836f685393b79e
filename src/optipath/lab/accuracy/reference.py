"""The reference for one boundary of floats: its Mueller matrices, and how they follow the angle.

All is a function of the ratio sin / cos as the floats give it, since a rounded cosine and a
rounded sine belong to no angle themselves.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from optipath.lab.accuracy.boundary_reference import boundary, cleaned, mueller_numbers, powers
from optipath.lab.accuracy.many_digits import DIGITS, WORKING_DIGITS, mpmath


class Exact(NamedTuple):
    """A, B, C, S of a Mueller matrix, and how each follows tan(theta)."""

    values: tuple[Any, ...]
    conditions: tuple[float, ...]


def reflection(n: float, k: float, cos: float, sin: float, n1: float = 1.0) -> Exact:
    """Return (A, B, C, S) of a reflection, with C + iS = r_s conj(r_p).

    Examples
    --------
    >>> print(float(reflection(1.5, 0.0, 1.0, 0.0).values[0]))
    0.04
    """
    return _exact("reflected", n, k, cos, sin, n1)


def transmission(n: float, k: float, cos: float, sin: float, n1: float = 1.0) -> Exact:
    """Return (A, B, C, S) of the power let through, with the phase of t_s conj(t_p).

    Examples
    --------
    >>> print(float(transmission(1.5, 0.0, 1.0, 0.0).values[0]))
    0.96
    """
    return _exact("transmitted", n, k, cos, sin, n1)


def _exact(way: str, *given: float) -> Exact:
    spread = sum(abs(int(mpmath.log10(x))) for x in map(mpmath.mpf, given) if x)
    with mpmath.workdps(WORKING_DIGITS + 4 * spread):
        n, k, c, s, n1 = map(mpmath.mpf, given)
        m = mpmath.mpc(n, k) / n1
        values = _values(way, m, c, s)
        # The condition from a difference so small that half of the digits stay.
        step = mpmath.mpf(10) ** -(DIGITS // 2 + spread)
        moved = _values(way, m, c, s * (1 + step))
        conditions = tuple(
            abs(float((after / value - 1) / step)) if value and s and c else 0.0
            for value, after in zip(values, moved, strict=True)
        )
        return Exact(values, conditions)


def _values(way: str, m: Any, c: Any, s: Any) -> tuple[Any, ...]:
    length = mpmath.hypot(c, s)
    matrix = getattr(boundary(m, c / length, s / length), way)
    return tuple(map(cleaned, mueller_numbers(*powers(matrix))))
