"""The reference for media and elliptical retarders: exponentials of what they do per length.

Written as matrices that mpmath exponentiates, in place of the closed forms of the kernels.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.lab.accuracy.many_digits import cos_sin, mpmath

if TYPE_CHECKING:
    from optipath.elements.elliptical_retarder import EllipticalRetarder
    from optipath.elements.medium import Medium
    from optipath.lab.accuracy.exact_values import Reader


def exponential(dichroism: Any, retardance: Any, depth: Any = 0, depolarization: Any = 0) -> Any:
    """Return the Mueller matrix of a generator."""
    (p1, p2, p3), (q1, q2, q3), d = dichroism, retardance, depth + depolarization
    generator = mpmath.matrix(
        [[-depth, p1, p2, p3], [p1, -d, -q3, q2], [p2, q3, -d, -q1], [p3, -q2, q1, -d]]
    )
    return mpmath.expm(generator, method="taylor").tolist()


def medium(element: Medium, read: Reader) -> list[list[Any]]:
    """Return the Mueller matrix of a medium."""
    length = read.real(element.length)
    depth = length * read.real(element.absorption)
    rotation = read.angle_along(element.rotation, element.length, 2)
    rotation -= read.angle_along(element.dextrorotation, element.length, 2)
    retardance = read.angle_along(element.retardance, element.length)
    linear, circular = (
        length * read.real(rate) for rate in (element.dichroism, element.circular_dichroism)
    )
    fast = cos_sin(2 * read.angle(element.angle, 2))
    dichroic = fast
    if element.dichroic_angle is not None:
        dichroic = cos_sin(2 * read.angle(element.dichroic_angle, 2))
    return exponential(  # type: ignore[no-any-return]
        (*(linear * part for part in dichroic), circular),
        (*(retardance * part for part in fast), 2 * rotation),
        depth,
        length * read.real(element.depolarization),
    )


def elliptical_retarder(element: EllipticalRetarder, read: Reader) -> list[list[Any]]:
    """Return the Mueller matrix of an elliptical retarder."""
    turns = tuple(read.angle(part) for part in (element.s1, element.s2, element.s3))
    return exponential((0, 0, 0), turns)  # type: ignore[no-any-return]
