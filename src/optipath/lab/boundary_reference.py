"""Reference for boundaries and stacks: Fresnel's amplitudes in many digits.

Without a formula of the kernels; all is a function of the ratio sin / cos as floats give it, since
a rounded cosine and a rounded sine belong to no angle themselves.
"""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from optipath.lab.many_digits import DIGITS, WORKING_DIGITS, mpmath

if TYPE_CHECKING:
    from collections.abc import Sequence


Jones: TypeAlias = tuple[tuple[Any, Any], tuple[Any, Any]]


class ExactBoundary(NamedTuple):
    """What a boundary does to the field, the same from either side."""

    reflected: Jones
    transmitted: Jones


def boundary(m: Any, c: Any, s: Any) -> ExactBoundary:
    """Return what a boundary reflects and lets through."""
    # 1 - s^2 is c^2: an equal medium reflects nothing, at grazing incidence too.
    g = _root(m * m - s * s if s < c else (m * m - 1) + c * c)
    rs = (c - g) / (c + g) if c + g else mpmath.mpf(0)
    second = m * m * c
    # At normal incidence on an index of 0 nothing tells s from p but the turn of y.
    rp = (second - g) / (second + g) if second + g else -rs
    rs, rp = cleaned(rs), cleaned(rp)
    along, across = mpmath.mpf(0), mpmath.mpf(0)
    # E_s is continuous, and so is H along s: t_s = 1 + r_s, t_p = (1 + r_p) / m.
    cross = (1 + rs) * mpmath.conj((1 + rp) / m) if m else mpmath.mpc(0)
    if cross and (m.imag != 0 or g.imag == 0):
        along, across = (mpmath.sqrt(abs(1 - abs(r) ** 2)) for r in (rs, rp))
        across *= mpmath.conj(cross) / abs(cross)
    return ExactBoundary(((rs, 0), (0, rp)), ((along, 0), (0, across)))


def along_face(m: Any, angle: Any) -> Any:
    """Return the wave along a face, for the real angle in a medium that absorbs or does not."""
    # By g^2 = m^2 - y^2 with y = q sin, Re g = q cos: a quadratic equation for q^2.
    square = m * m
    q2 = (square.real + mpmath.sqrt(square.real**2 + (square.imag / mpmath.cos(angle)) ** 2)) / 2
    return mpmath.sqrt(q2) * mpmath.sin(angle)


def between(m1: Any, m2: Any, y: Any) -> ExactBoundary:
    """Return what a boundary does to light that comes out of a medium that absorbs.

    Transmission is relative to the power of the arriving wave alone (S. J. Byrnes,
    arXiv:1603.02720).
    """
    g1, g2 = (_root(m * m - y * y) for m in (m1, m2))
    # Cosines, which are complex in either medium.
    c1, c2 = g1 / m1, g2 / m2
    rs = (m1 * c1 - m2 * c2) / (m1 * c1 + m2 * c2)
    rp = (m2 * c1 - m1 * c2) / (m2 * c1 + m1 * c2)
    ts, tp = 2 * m1 * c1 / (m1 * c1 + m2 * c2), 2 * m1 * c1 / (m2 * c1 + m1 * c2)
    along = abs(ts) * mpmath.sqrt((m2 * c2).real / (m1 * c1).real)
    carried = (m2 * mpmath.conj(c2)).real / (m1 * mpmath.conj(c1)).real
    across = abs(tp) * mpmath.sqrt(carried) if g2.real else mpmath.mpf(0)
    phase = tp * mpmath.conj(ts)
    across *= phase / abs(phase)
    return ExactBoundary(((rs, 0), (0, rp)), ((along, 0), (0, across)))


def _root(square: Any) -> Any:
    """Return the root of the wave that goes on, and fades."""
    g = mpmath.sqrt(square)
    return -g if g.imag < 0 or (g.imag == 0 and g.real < 0) else g


def refracted(ratio: Any, s: Any) -> tuple[Any, Any]:
    """Return cosine and sine behind a boundary."""
    s = ratio * s
    return (mpmath.sqrt(1 - s * s), s) if s < 1 else (mpmath.mpf(0), mpmath.mpf(1))


def stack(
    indices: Sequence[Any], y: Any, depths: Sequence[Any] = (), *, way: bool
) -> list[list[Any]]:
    """Return the Mueller matrix of a stack, by adding boundary after boundary from the far side.

    Its layers are thick, and of some depth where one absorbs; y is n sin of every medium.
    """
    faces = [_both_sides(*pair, y) for pair in pairwise(indices)]
    total = [(r, t) for r, t, _ in faces[-1]]
    inner = [*zip(faces[:-1], indices[1:-1], depths or [0] * len(indices[2:]), strict=True)]
    for here, n, depth in reversed(inner):
        left = mpmath.exp(-depth * mpmath.sqrt(n * n - y * y).imag) if n.imag else 1
        total = [
            _added(r, t, up, left**2 * below, left * through)
            for (r, t, up), (below, through) in zip(here, total, strict=True)
        ]
    A, B, C, S = mueller_numbers(*(pair[0] if way else pair[1] for pair in total))
    return [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]


def powers(matrix: Jones) -> tuple[Any, Any, Any]:
    """Return what becomes of the powers of s and p, and of E_s conj(E_p)."""
    (x, _), (_, y) = matrix
    return abs(x) ** 2, abs(y) ** 2, x * mpmath.conj(y)


def mueller_numbers(Fs: Any, Fp: Any, z: Any) -> tuple[Any, Any, Any, Any]:
    """Return (A, B, C, S) of a Mueller matrix."""
    return (Fs + Fp) / 2, (Fs - Fp) / 2, mpmath.re(z), mpmath.im(z)


def cleaned(value: Any) -> Any:
    """Return 0 for what is only the rounding of the last digits of what has cancelled."""
    return value if abs(value) > mpmath.mpf(10) ** -(mpmath.mp.dps - 10) else mpmath.mpf(0)


def _added(r: Any, t: Any, up: Any, below: Any, through: Any) -> tuple[Any, Any]:
    """Return what is reflected and let through of a boundary with others below it."""
    if not t:
        return r, t
    rounds = 1 / (1 - r * below)
    return r + t * up * below * rounds, t * through * rounds


def _both_sides(first: Any, second: Any, y: Any) -> list[tuple[Any, Any, Any]]:
    """Return what is reflected, and let through from in front and from behind, of each part."""
    front, behind = [
        between(n, other, y) if n.imag else boundary(other / n.real, *refracted(1 / n.real, y))
        for n, other in ((first, second), (second, first))
    ]
    numbers = front.reflected, front.transmitted, behind.transmitted
    return list(zip(*map(powers, numbers), strict=True))


class Exact(NamedTuple):
    """A, B, C, S of a Mueller matrix, and how each follows tan(theta)."""

    values: tuple[Any, ...]
    conditions: tuple[float, ...]


def exact(way: str, n: Any, k: Any, c: Any, s: Any, n1: Any = 1.0) -> Exact:
    """Return (A, B, C, S) of what is ``reflected`` or ``transmitted`` at an angle of c and s.

    C + iS is r_s conj(r_p); of what is let through it has the phase of t_s conj(t_p).

    >>> print(float(exact("reflected", 1.5, 0.0, 1.0, 0.0).values[0]))
    0.04
    """
    spread = sum(abs(int(mpmath.log10(x))) for x in map(mpmath.mpf, (n, k, c, s, n1)) if x)
    with mpmath.workdps(WORKING_DIGITS + 4 * spread):
        n, k, c, s, n1 = map(mpmath.mpf, (n, k, c, s, n1))
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


reflection, transmission = partial(exact, "reflected"), partial(exact, "transmitted")


def _values(way: str, m: Any, c: Any, s: Any) -> tuple[Any, ...]:
    length = mpmath.hypot(c, s)
    matrix = getattr(boundary(m, c / length, s / length), way)
    return tuple(map(cleaned, mueller_numbers(*powers(matrix))))
