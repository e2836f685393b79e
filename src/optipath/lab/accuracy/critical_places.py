"""Places where methods fail, at a given distance: next to critical angles, grazing, the normal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from optipath.errors import OptipathError, unknown
from optipath.lab.accuracy.regions import Region, beside

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.lab.accuracy.regions import Dice, Floats

    Draw: TypeAlias = Callable[[Dice, float], tuple[Floats, ...]]


@dataclass(frozen=True)
class CriticalPlace:
    """An angle of incidence that methods fail next to.

    Units: draw in radians.
    """

    name: str
    called: str
    draw: Draw

    def region(self, distance: float) -> Region:
        """Return the boundaries at one distance.

        Units: distance in radians.

        Examples
        --------
        >>> samples = PLACES["grazing"].region(1e-3).samples(2)
        >>> samples.cos
        array([0.001, 0.001])
        """
        # Of one name, and so with the same media at every distance.
        return Region(self.name, lambda dice: self.draw(dice, distance))


def _brewster(dice: Dice, distance: float) -> tuple[Floats, ...]:
    n = np.where(dice.sign() > 0, dice.even(1.05, 4), dice.even(0.25, 0.95))
    return n, np.zeros(1), *beside(n, dice.sign() * distance)


def _critical(dice: Dice, distance: float) -> tuple[Floats, ...]:
    n, k = dice.even(0.2, 0.95), dice.some(dice.decades(1e-20, 1e-3))
    return n, k, *beside(n / np.sqrt((1 - n) * (1 + n)), dice.sign() * distance)


def _medium(dice: Dice) -> tuple[Floats, Floats]:
    return dice.even(0.1, 5), dice.some(dice.even(0.01, 8))


def _grazing(dice: Dice, distance: float) -> tuple[Floats, ...]:
    return *_medium(dice), np.full(1, np.sin(distance)), np.full(1, np.cos(distance))


def _normal(dice: Dice, distance: float) -> tuple[Floats, ...]:
    return *_medium(dice), np.full(1, np.cos(distance)), np.full(1, np.sin(distance))


PLACES = {
    place.name: place
    for place in (
        CriticalPlace("brewster", "Brewster's angle", _brewster),
        CriticalPlace("critical", "the critical angle", _critical),
        CriticalPlace("grazing", "grazing incidence", _grazing),
        CriticalPlace("normal", "the normal", _normal),
    )
}


def places_called(names: Sequence[str]) -> list[CriticalPlace]:
    """Return places by their names, each once."""
    if faults := [fault for name in names for fault in unknown("place", name, PLACES)]:
        raise OptipathError(*faults)
    return [PLACES[name] for name in dict.fromkeys(names)]
