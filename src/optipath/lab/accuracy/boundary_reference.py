"""The reference for boundaries and stacks of them: Fresnel's complex amplitudes in many digits.

It shares no formula with the kernels.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from optipath.lab.accuracy.many_digits import mpmath

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

    What is let through is the power carried behind over that of the arriving wave alone (S. J.
    Byrnes, arXiv:1603.02720).
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


def stack(indices: Sequence[Any], c: Any, s: Any, *, back: bool, way: bool) -> list[list[Any]]:
    """Return the Mueller matrix of a stack, by adding boundary after boundary from the far side."""
    first, faces = indices[0].real, []
    for place, (n, behind) in enumerate(pairwise(indices)):
        angle = refracted(first / n.real, s) if place else (c, s)
        face = boundary(behind / n.real, *angle)
        faces.append(list(zip(*map(powers, face), strict=True)))
    if back:
        faces.reverse()
    total = faces[-1]
    for here in reversed(faces[:-1]):
        pairs = zip(here, total, strict=True)
        total = [_added(r, t, below, through) for (r, t), (below, through) in pairs]
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


def _added(r: Any, t: Any, below: Any, through: Any) -> tuple[Any, Any]:
    """Return what is reflected and let through of a boundary with others below it."""
    if not t:
        return r, t
    rounds = 1 / (1 - r * below)
    return r + t * t * below * rounds, t * through * rounds
