"""Jones matrices in many digits: turns of the frame, filters, retarders, products."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.lab.accuracy.many_digits import cos_sin, mpmath

if TYPE_CHECKING:
    from optipath.lab.accuracy.boundary_reference import Jones
    from optipath.lab.accuracy.exact_values import Reader


def turn(angle: Any) -> Jones:
    """Return what a turn of the frame does to the field."""
    c, s = cos_sin(angle)
    return (c, s), (-s, c)


def filtering(read: Reader, along: Any, across: Any, angle: Any) -> Jones:
    """Return what a filter does."""
    roots = (mpmath.sqrt(read.real(transmittance)) for transmittance in (along, across))
    return _turned(diagonal(*roots), read.angle(angle, 2))


def retarding(read: Reader, retardance: Any, angle: Any) -> Jones:
    """Return what a retarder does.

    Units: retardance in radians.
    """
    # The field is exp(-iwt): what falls behind gains a positive phase.
    slow = mpmath.mpc(*cos_sin(retardance))
    return _turned(diagonal(1, slow), read.angle(angle, 2))


def diagonal(x: Any, y: Any) -> Jones:
    """Return a diagonal matrix."""
    return (x, 0), (0, y)


def _turned(matrix: Jones, angle: Any) -> Jones:
    return times(turn(-angle), times(matrix, turn(angle)))


def times(first: Jones, second: Jones) -> Jones:
    """Return the product of two matrices."""
    (a, b), (c, d) = first
    (e, f), (g, h) = second
    return (a * e + b * g, a * f + b * h), (c * e + d * g, c * f + d * h)
