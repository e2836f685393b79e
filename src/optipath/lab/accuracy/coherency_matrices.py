"""Coherency matrices <E conj(E)> of light, in many digits: passed on, added, as Stokes vectors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.lab.accuracy.jones_matrices import times
from optipath.lab.accuracy.many_digits import mpmath

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.lab.accuracy.boundary_reference import Jones


def passed(matrix: Jones, light: Jones) -> Jones:
    """Return the light behind an element."""
    (a, b), (c, d) = matrix
    conj = mpmath.conj
    return times(times(matrix, light), ((conj(a), conj(c)), (conj(b), conj(d))))


def added(lights: Iterable[Jones]) -> Jones:
    """Return the incoherent sum of lights; dark where there is none."""
    entries = [(a, b, c, d) for (a, b), (c, d) in lights] or [(0, 0, 0, 0)]
    a, b, c, d = map(sum, zip(*entries, strict=True))
    return (a, b), (c, d)


def coherency(stokes: Iterable[Any]) -> Jones:
    """Return the coherency matrix of a Stokes vector."""
    s0, s1, s2, s3 = stokes
    # S2 + i S3 = 2 conj(Ex) Ey.
    return ((s0 + s1) / 2, mpmath.mpc(s2, -s3) / 2), (mpmath.mpc(s2, s3) / 2, (s0 - s1) / 2)


def stokes_of(light: Jones) -> tuple[Any, ...]:
    """Return the Stokes vector of a coherency matrix."""
    (xx, _), (yx, yy) = light
    xx, yy, yx = (mpmath.mpmathify(part) for part in (xx, yy, yx))
    return xx.real + yy.real, xx.real - yy.real, 2 * yx.real, 2 * yx.imag
