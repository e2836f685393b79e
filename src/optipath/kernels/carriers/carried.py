"""Stokes vectors as kernels carry them: (weak, S1, S2, S3), and in parts that add up.

``weak`` is the smaller of the intensities along x and along y. Behind a crossed filter or near
Brewster's angle it is tiny, and S0 would lose its digits; near the normal S1 is tiny, and two
intensities would lose its digits. The pair keeps both: S0 = 2 weak + |S1| is a sum of non-negative
terms.

Light may be carried as the first one, two or three only; without S1, ``weak`` is half of S0.
Systems of equations are written in parts that add up, as the smaller of two intensities does not;
light carried by its intensity alone has one part, S0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from optipath.kernels.primitives import not_below_rounding, products, vanishes

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from optipath.kernels.primitives import Primitives


Components: TypeAlias = tuple[Any, Any, Any, Any]
"""(S0, S1, S2, S3), each by itself."""

Carried: TypeAlias = tuple[Any, ...]
"""(weak, S1, S2, S3), or the first few of them; those left out are 0, or matter to nobody."""

_MANY = 1024.0
"""How many roundings a DoP above 1 may come from."""


def carry(xp: Primitives, stokes: Components, count: int = 4) -> Carried:
    """Return Stokes components as they are carried, or the first `count` of them."""
    s0, s1 = stokes[:2]
    if count == 1:
        return (0.5 * s0,)
    size = xp.absolute(s1)
    return not_below_rounding(xp, 0.5 * (s0 - size), size), *stokes[1:count]


def all_four(carried: Carried) -> tuple[Any, Any, Any, Any]:
    """Return carried light with plain zeros for what is left out."""
    weak, s1, s2, s3 = (*carried, 0.0, 0.0, 0.0)[:4]
    return weak, s1, s2, s3


def leaving(xp: Primitives, carried: Carried, count: int) -> Carried:
    """Return the first `count` components of carried light."""
    if count > 1 or len(carried) == 1:
        return carried[:count]
    return (carried[0] + 0.5 * xp.absolute(carried[1]),)


def at_most_polarised(xp: Primitives, carried: Carried) -> Carried:
    """Return light whose S1, S2, S3 are shortened where roundings made them longer than S0.

    Matrices of one's own may make unphysical light, which stays as it is.
    """
    if len(carried) == 1:
        return carried
    weak, s1, s2, s3 = all_four(carried)
    size = xp.absolute(s1)
    s0 = 2.0 * weak + size
    # |S|^2 - S0^2, where S0 = 2 weak + |S1|.
    excess = products((s2, s2), (s3, s3)) - 4.0 * weak * (weak + size)
    square = s0 * s0
    rounding = (excess > 0.0) & vanishes(excess, _MANY * square)
    gap = xp.where(rounding, 0.5 * excess / xp.where(square > 0.0, square, 1.0), 0.0)
    rest = (number - number * gap for number in carried[1:])
    return weak + 0.5 * size * gap, *rest


def stokes_of(xp: Primitives, carried: Carried) -> Components:
    """Return the Stokes components of carried light; those that are left out are 0."""
    weak, s1, s2, s3 = all_four(carried)
    return (2.0 * weak if len(carried) == 1 else 2.0 * weak + xp.absolute(s1)), s1, s2, s3


def along_axes(xp: Primitives, carried: Carried) -> tuple[Any, Any]:
    """Return the intensities along x and along y."""
    if len(carried) == 1:
        return carried[0], carried[0]
    weak, s1 = carried[:2]
    return weak + xp.maximum(s1, 0.0), weak + xp.maximum(-s1, 0.0)


def add(xp: Primitives, first: Carried, second: Carried) -> Carried:
    """Return two lights together, incoherently."""
    if len(first) == len(second) == 1:
        return (first[0] + second[0],)
    x1, y1 = along_axes(xp, first)
    x2, y2 = along_axes(xp, second)
    # One that is carried by fewer components has nothing of the others.
    count = max(len(first), len(second))
    both = zip(all_four(first)[1:count], all_four(second)[1:count], strict=True)
    return xp.minimum(x1 + x2, y1 + y2), *(one + other for one, other in both)


Parts: TypeAlias = tuple[Any, ...]
"""(S0,), (x, y), (x, y, S2) or (x, y, S2, S3)."""


class SolvedLoop(Protocol):
    """Where the lights of a loop meet, as ways of carrying light see it."""

    def count(self, junction: int) -> int:
        """Return by how many components the light at a junction is carried."""

    def ways(self) -> Iterable[tuple[int, int, Sequence[tuple[Any, Any]]]]:
        """Return each way from a junction to the next, and what light passes on it."""

    def lights(self, arriving: Mapping[int, Parts]) -> dict[int, Parts]:
        """Return the parts of the light at each junction, for those of what arrives at some."""


_UNITS: tuple[Carried, ...] = (
    (0.0, 1.0, 0.0, 0.0),
    (0.0, -1.0, 0.0, 0.0),
    (0.0, 0.0, 1.0, 0.0),
    (0.0, 0.0, 0.0, 1.0),
)


def unit_light(part: int, count: int) -> Carried:
    """Return carried light of which one part of some count is 1, and the others 0."""
    return (0.5,) if count == 1 else _UNITS[part][:count]


def parts_of(xp: Primitives, carried: Carried, count: int) -> Parts:
    """Return the parts of carried light, as many as a count of components has."""
    if count == 1:
        return (2.0 * leaving(xp, carried, 1)[0],)
    return *along_axes(xp, carried), *all_four(carried)[2:count]


def light_of(xp: Primitives, parts: Parts) -> Carried:
    """Return carried light of these parts."""
    if len(parts) == 1:
        return (0.5 * parts[0],)
    x, y = parts[:2]
    size = xp.maximum(xp.absolute(x), xp.absolute(y))
    return not_below_rounding(xp, xp.minimum(x, y), size), x - y, *parts[2:]


def energy(xp: Primitives, carried: Carried) -> Any:
    """Return the intensity S0 of carried light."""
    return stokes_of(xp, carried)[0]
