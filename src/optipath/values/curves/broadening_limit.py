"""BroadeningLimit: an oscillator whose formula holds for a broadening below twice its energy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.values.agreement import Agreement, text_of

if TYPE_CHECKING:
    from collections.abc import Collection


@dataclass(frozen=True, eq=False)
class BroadeningLimit(Agreement):
    """The broadening C is below 2 E0, so that alpha of Jellison and Modine (1996) is real.

    The operands are the energy and the broadening.
    """

    owner: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        del xp
        energy, broadening = numbers
        return ~(broadening >= 2.0 * energy)

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying
        energy, broadening = [text_of(*each) for each in zip(self.operands, numbers, strict=True)]
        return (
            f"{self.owner} has the broadening {broadening} and the energy {energy}; the formula "
            f"holds for a broadening below twice the energy, which is {2.0 * numbers[0]:.12g}"
        )
