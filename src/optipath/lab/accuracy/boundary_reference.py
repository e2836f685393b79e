"""The reference for boundaries and stacks of them, in many digits, written for nothing else."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from optipath.lab.accuracy.many_digits import mpmath
from optipath.lab.accuracy.reference import amplitudes

if TYPE_CHECKING:
    from collections.abc import Sequence

Jones: TypeAlias = tuple[tuple[Any, Any], tuple[Any, Any]]


class ExactBoundary(NamedTuple):
    """The Jones matrices of what is reflected and, as carried power, let through."""

    reflected: Jones
    transmitted: Jones


def boundary(m: Any, c: Any, s: Any) -> ExactBoundary:
    """Return both for a relative index and an angle; they are the same from either side."""
    rs, rp, g = amplitudes(m, c, s)
    through = mpmath.mpf(0), mpmath.mpf(0)
    # E_s is continuous, and so is H along s: t_s = 1 + r_s, t_p = (1 + r_p) / m.
    cross = (1 + rs) * mpmath.conj((1 + rp) / m) if m else mpmath.mpc(0)
    if cross and (m.imag != 0 or g.imag == 0):
        roots = (mpmath.sqrt(abs(1 - abs(r) ** 2)) for r in (rs, rp))
        along, across = roots
        through = along, across * mpmath.conj(cross) / abs(cross)
    return ExactBoundary(((rs, 0), (0, rp)), ((through[0], 0), (0, through[1])))


def refracted(ratio: Any, s: Any) -> tuple[Any, Any]:
    """Return cosine and sine behind a boundary, for the ratio of the indices before and behind."""
    s = ratio * s
    return (mpmath.sqrt(1 - s * s), s) if s < 1 else (mpmath.mpf(0), mpmath.mpf(1))


def stack(indices: Sequence[Any], c: Any, s: Any, *, back: bool, way: bool) -> list[list[Any]]:
    """Return the Mueller matrix of a stack, by adding boundary after boundary from the far side.

    Parameters
    ----------
    indices : sequence of mpc
        From the front medium to the substrate.
    c, s : mpf
        Of the incidence in the front medium.
    back : bool
        Whether light comes from behind.
    way : bool
        Whether it is reflected.
    """
    first, faces = indices[0].real, []
    for place, (n, behind) in enumerate(pairwise(indices)):
        angle = refracted(first / n.real, s) if place else (c, s)
        faces.append(boundary(behind / n.real, *angle))
    if back:
        faces.reverse()
    numbers = [_numbers(face) for face in faces]
    total = numbers[-1]
    for here in reversed(numbers[:-1]):
        pairs = zip(here, total, strict=True)
        total = [_added(r, t, below, through) for (r, t), (below, through) in pairs]
    Fs, Fp, z = (pair[0] if way else pair[1] for pair in total)
    A, B, C, S = (Fs + Fp) / 2, (Fs - Fp) / 2, mpmath.re(z), mpmath.im(z)
    return [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]


def _numbers(face: ExactBoundary) -> list[tuple[Any, Any]]:
    """Return what is reflected and let through of s, of p, and of E_s conj(E_p)."""
    found = []
    for (x, _), (_, y) in face:
        found.append((abs(x) ** 2, abs(y) ** 2, x * mpmath.conj(y)))
    return list(zip(*found, strict=True))


def _added(r: Any, t: Any, below: Any, through: Any) -> tuple[Any, Any]:
    """Return what is reflected and let through of a boundary with others below it."""
    if not t:
        return r, t
    rounds = 1 / (1 - r * below)
    return r + t * t * below * rounds, t * through * rounds
