"""Light in parts that add up: the intensities along x and along y, S2 and S3.

Carried light (weak, S1, S2, S3) keeps more digits, but the smaller of two intensities does
not add up; systems of equations are written in these parts. Light that is carried by its
intensity alone has one part, S0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from optipath.kernels.carriers.carried import all_four, along_axes, leaving, stokes_of
from optipath.kernels.numbers.vanishing import not_below_rounding

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import Carried
    from optipath.kernels.numbers.primitives import Primitives

Parts: TypeAlias = tuple[Any, ...]
"""(S0,), (x, y), (x, y, S2) or (x, y, S2, S3)."""


class SolvedLoop(Protocol):
    """Where the lights of a loop meet, as ways of carrying light see it."""

    def count(self, junction: int) -> int:
        """Return by how many components the light at a junction is carried."""

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
    """Return the parts of carried light, as many as a count of components has.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> parts_of(FLOAT, (0.25, -0.5, 0.1, 0.0), 3), parts_of(FLOAT, (0.25, -0.5), 1)
    ((0.25, 0.75, 0.1), (1.0,))
    """
    if count == 1:
        return (2.0 * leaving(xp, carried, 1)[0],)
    return *along_axes(xp, carried), *all_four(carried)[2:count]


def light_of(xp: Primitives, parts: Parts) -> Carried:
    """Return carried light of these parts.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> light_of(FLOAT, (0.25, 0.75, 0.1))
    (0.25, -0.5, 0.1)
    """
    if len(parts) == 1:
        return (0.5 * parts[0],)
    x, y = parts[:2]
    size = xp.maximum(xp.absolute(x), xp.absolute(y))
    return not_below_rounding(xp, xp.minimum(x, y), size), x - y, *parts[2:]


def energy(xp: Primitives, carried: Carried) -> Any:
    """Return the intensity S0 of carried light."""
    return stokes_of(xp, carried)[0]
