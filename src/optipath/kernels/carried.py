"""Light as the steps carry it along: (weak, S1, S2, S3).

``weak`` is the smaller of the intensities along x and along y. Behind a crossed filter
or near Brewster's angle one of the two is tiny, and in S0 its digits would be lost;
near the normal S1 is tiny, and in the two intensities its digits would be lost. The
pair (weak, S1) keeps both: S0 = 2 weak + |S1| is a sum of non-negative terms.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from optipath.kernels.primitives import Primitives

Components: TypeAlias = tuple[Any, Any, Any, Any]
"""(S0, S1, S2, S3), each by itself."""

Carried: TypeAlias = tuple[Any, Any, Any, Any]
"""(weak, S1, S2, S3)."""

_SEVERAL, _MANY = 64.0, 1024.0
"""How many roundings a negative intensity, and a DoP above 1, may come from."""


def carry(xp: Primitives, stokes: Components) -> Carried:
    """Return Stokes components as they are carried.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> carry(FLOAT, (1.0, -0.5, 0.0, 0.0))
    (0.25, -0.5, 0.0, 0.0)
    """
    s0, s1, s2, s3 = stokes
    size = xp.absolute(s1)
    return not_below_rounding(xp, 0.5 * (s0 - size), size), s1, s2, s3


def not_below_rounding(xp: Primitives, weak: Any, size: Any) -> Any:
    """Return an intensity, 0 where it is negative by no more than the roundings of a size.

    Matrices of one's own may make light that cannot be; its negative intensities stay.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> not_below_rounding(FLOAT, -1e-17, 0.5), not_below_rounding(FLOAT, -0.1, 0.5)
    (0.0, -0.1)
    """
    return xp.where((weak < 0.0) & _vanishes(weak, _SEVERAL * size), 0.0, weak)


def _vanishes(number: Any, beside: Any) -> Any:
    return beside + number == beside


def at_most_polarised(xp: Primitives, carried: Carried) -> Carried:
    """Return light whose S1, S2, S3 are shortened where roundings made them longer than S0.

    Matrices of one's own may make light that cannot be; it stays as it is.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> at_most_polarised(FLOAT, (0.0, 1.0, 1e-8, 0.0))
    (2.5000000000000003e-17, 1.0, 1e-08, 0.0)
    """
    weak, s1, s2, s3 = carried
    size = xp.absolute(s1)
    s0 = 2.0 * weak + size
    # |S|^2 - S0^2, where S0 = 2 weak + |S1|.
    excess = s2 * s2 + s3 * s3 - 4.0 * weak * (weak + size)
    square = s0 * s0
    rounding = (excess > 0.0) & _vanishes(excess, _MANY * square)
    gap = xp.where(rounding, 0.5 * excess / xp.where(square > 0.0, square, 1.0), 0.0)
    return weak + 0.5 * size * gap, s1 - s1 * gap, s2 - s2 * gap, s3 - s3 * gap


def stokes_of(xp: Primitives, carried: Carried) -> Components:
    """Return the Stokes components of carried light.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> stokes_of(FLOAT, (0.25, -0.5, 0.0, 0.0))
    (1.0, -0.5, 0.0, 0.0)
    """
    weak, s1, s2, s3 = carried
    return 2.0 * weak + xp.absolute(s1), s1, s2, s3


def along_axes(xp: Primitives, carried: Carried) -> tuple[Any, Any]:
    """Return the intensities along x and along y."""
    weak, s1, _, _ = carried
    return weak + xp.maximum(s1, 0.0), weak + xp.maximum(-s1, 0.0)


def add(xp: Primitives, first: Carried, second: Carried) -> Carried:
    """Return two lights together, incoherently.

    Examples
    --------
    >>> from optipath.kernels import FLOAT
    >>> add(FLOAT, (0.0, 1.0, 0.0, 0.0), (0.0, -1.0, 0.0, 0.5))
    (1.0, 0.0, 0.0, 0.5)
    """
    x1, y1 = along_axes(xp, first)
    x2, y2 = along_axes(xp, second)
    rest = (one + other for one, other in zip(first[1:], second[1:], strict=True))
    return xp.minimum(x1 + x2, y1 + y2), *rest
