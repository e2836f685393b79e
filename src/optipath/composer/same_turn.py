"""SameTurn: light that goes to and fro between two faces is turned alike on every way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.composer.one_plane import TURNED, turn_text, way_text
from optipath.values.agreement import Agreement

if TYPE_CHECKING:
    from collections.abc import Collection


@dataclass(frozen=True, eq=False)
class SameTurn(Agreement):
    """The turns on one way between two faces come to those on another, there or back.

    These are boundaries, or a boundary and a mirror. All ports of a face share x. A turn counts
    about the direction in which its light travels, so that a way back undoes a way there by
    turning as much again. The operands are the turns on both ways.
    """

    count: int
    first: tuple[str, str]
    second: tuple[str, str]

    @property
    def rests_on(self) -> tuple[str, ...]:
        """That neither way turns the plane of incidence, where there is one."""
        return way_text(*self.first), way_text(*self.second)

    def fits(self, xp: Any, *numbers: Any) -> Any:
        return ~(abs(xp.sin(sum(numbers[: self.count]) - sum(numbers[self.count :]))) > TURNED)

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying  # No number is a cure.
        name, own = (port.rpartition(".")[0] for port in self.first)
        parts = slice(self.count), slice(self.count, None)
        first, second = (turn_text(self.operands[part], numbers[part]) for part in parts)
        return (
            f"light goes to and fro between '{name}' and '{own}', but is turned by {first} on the "
            f"way from {way_text(*self.first)}, and by {second} from {way_text(*self.second)}; "
            f"let the azimuths on either way add up to the same, since each counts about the "
            f"direction of its own light"
        )
