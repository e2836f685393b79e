"""OnePlane: parallel boundaries have one plane of incidence, however the way between is turned."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.values.agreement import Agreement, text_of

if TYPE_CHECKING:
    from collections.abc import Collection

TURNED = 1e-3
"""From what sine on a turn makes another plane of incidence: less is none in a laboratory."""

_NORMAL = 1e-9
"""Up to what sine of an incidence light has no plane of incidence."""


@dataclass(frozen=True, eq=False)
class OnePlane(Agreement):
    """The turns on the way between two parallel boundaries come to none, or light is normal.

    The operands are the incidence at the first, and the turns, which add up.
    """

    leaves: str
    enters: str
    follows: bool

    @property
    def spoils(self) -> tuple[str, ...]:
        """What else is said of the turns on this way."""
        return (way_text(self.leaves, self.enters),)

    def fits(self, xp: Any, *numbers: Any) -> Any:
        angle, *turns = numbers
        return ~((abs(xp.sin(sum(turns))) > TURNED) & (abs(xp.sin(angle)) > _NORMAL))

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying  # No number is a cure.
        name, own = (port.rpartition(".")[0] for port in (self.leaves, self.enters))
        cure = "let the azimuths on the way add up to 0"
        if self.follows:
            why = f"'{own}' takes its incidence over (FOLLOWS), as a face parallel to '{name}' does"
            cure += ", or give its incidence"
        else:
            why = f"light goes to and fro between '{name}' and '{own}', which are parallel then"
        return (
            f"{why}, but the way from {way_text(self.leaves, self.enters)} turns the plane of "
            f"incidence by {turn_text(self.operands[1:], numbers[1:])}; {cure} (a polarizer or "
            f"retarder is turned by its angle, which turns nothing behind it)"
        )


def turn_text(operands: Any, turns: Any) -> str:
    """Write what turns add up to, and whose values they are.

    Units: turns in radians.
    """
    each = [text_of(o, math.degrees(t), " deg") for o, t in zip(operands, turns, strict=True)]
    if len(each) == 1:
        return each[0]
    several = f" ({', '.join(each)})" if each else ""
    return f"{math.degrees(sum(turns)):.10g} deg{several}"


def way_text(leaves: str, enters: str) -> str:
    """Write where light leaves one boundary and enters another.

    Examples
    --------
    >>> way_text("front.transmitted", "back.in")
    "'front.transmitted' to 'back.in'"
    """
    return f"'{leaves}' to '{enters}'"
