"""The reference for one boundary: Fresnel's complex amplitudes in 50 digits.

It shares no formula with the kernels. All is a function of the ratio sin / cos as the
floats give it, since a rounded cosine and a rounded sine belong to no angle themselves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.lab.accuracy.many_digits import DIGITS, WORKING_DIGITS, mpmath

if TYPE_CHECKING:
    from collections.abc import Callable


class Exact(NamedTuple):
    """A, B, C, S of a Mueller matrix, and how each follows tan(theta).

    Attributes
    ----------
    values : tuple of mpf
        A, B, C, S.
    conditions : tuple of float
        |t dX/dt / X| of each for t = tan(theta), 0 where X is 0.
    """

    values: tuple[Any, ...]
    conditions: tuple[float, ...]


def reflection(n: float, k: float, cos: float, sin: float, n1: float = 1.0) -> Exact:
    """Return (A, B, C, S) of a reflection, with C + iS = r_s conj(r_p).

    Parameters
    ----------
    n, k : float
        The medium behind the boundary.
    cos, sin : float
        Of the angle of incidence.
    n1 : float, optional
        The medium in front.

    Examples
    --------
    >>> print(float(reflection(1.5, 0.0, 1.0, 0.0).values[0]))
    0.04
    """
    return _exact(_reflected, n, k, cos, sin, n1)


def transmission(n: float, k: float, cos: float, sin: float, n1: float = 1.0) -> Exact:
    """Return (A, B, C, S) of the power let through, with the phase of t_s conj(t_p).

    Parameters
    ----------
    n, k, cos, sin, n1 : float
        As in `reflection`.

    Examples
    --------
    >>> print(float(transmission(1.5, 0.0, 1.0, 0.0).values[0]))
    0.96
    """
    return _exact(_transmitted, n, k, cos, sin, n1)


def amplitudes(m: Any, c: Any, s: Any) -> tuple[Any, Any, Any]:
    """Return r_s, r_p and g = m cos(theta_2) for a relative index m."""
    # 1 - s^2 is c^2: an equal medium reflects nothing, at grazing incidence too.
    g = mpmath.sqrt(m * m - s * s if s < c else (m * m - 1) + c * c)
    if g.imag < 0 or (g.imag == 0 and g.real < 0):
        g = -g
    rs = (c - g) / (c + g) if c + g else mpmath.mpf(0)
    second = m * m * c
    # At normal incidence on an index of 0 nothing tells s from p but the turn of y.
    rp = (second - g) / (second + g) if second + g else -rs
    return _cleaned(rs), _cleaned(rp), g


def _reflected(m: Any, c: Any, s: Any) -> tuple[Any, ...]:
    rs, rp, _ = amplitudes(m, c, s)
    Fs, Fp, cross = abs(rs) ** 2, abs(rp) ** 2, rs * mpmath.conj(rp)
    return (Fs + Fp) / 2, (Fs - Fp) / 2, cross.real, cross.imag


def _transmitted(m: Any, c: Any, s: Any) -> tuple[Any, ...]:
    rs, rp, g = amplitudes(m, c, s)
    Ts, Tp = 1 - abs(rs) ** 2, 1 - abs(rp) ** 2
    # E_s is continuous, and so is H along s: t_s = 1 + r_s, t_p = (1 + r_p) / m.
    cross = (1 + rs) * mpmath.conj((1 + rp) / m) if m else mpmath.mpc(0)
    size = mpmath.sqrt(abs(Ts * Tp))
    if not cross or (m.imag == 0 and g.imag != 0):
        return (Ts + Tp) / 2, (Ts - Tp) / 2, mpmath.mpf(0), mpmath.mpf(0)
    cross *= size / abs(cross)
    return (Ts + Tp) / 2, (Ts - Tp) / 2, cross.real, cross.imag


def _exact(function: Callable[..., tuple[Any, ...]], *given: float) -> Exact:
    spread = sum(abs(int(mpmath.log10(x))) for x in map(mpmath.mpf, given) if x)
    with mpmath.workdps(WORKING_DIGITS + 4 * spread):
        n, k, c, s, n1 = map(mpmath.mpf, given)
        m = mpmath.mpc(n, k) / n1
        values = _values(function, m, c, s)
        # The condition from a difference so small that half of the digits stay.
        step = mpmath.mpf(10) ** -(DIGITS // 2 + spread)
        moved = _values(function, m, c, s * (1 + step))
        conditions = tuple(
            abs(float((after / value - 1) / step)) if value and s and c else 0.0
            for value, after in zip(values, moved, strict=True)
        )
        return Exact(values, conditions)


def _values(function: Callable[..., tuple[Any, ...]], m: Any, c: Any, s: Any) -> tuple[Any, ...]:
    length = mpmath.hypot(c, s)
    return tuple(map(_cleaned, function(m, c / length, s / length)))


def _cleaned(value: Any) -> Any:
    """Return 0 for what is only the rounding of the last digits of what has cancelled."""
    return value if abs(value) > mpmath.mpf(10) ** -(mpmath.mp.dps - 10) else mpmath.mpf(0)
