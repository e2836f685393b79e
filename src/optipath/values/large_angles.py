"""LargeAngles: what is given for angles that nothing limits, looked at for degrees."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.degrees import TURN, is_within_a_turn, warn_of_degrees

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs


class LargeAngles:
    """The open parameters of a path that may be angles beyond a whole turn.

    Each is warned of once. Of the first array for one, a thousand numbers are looked at; of those
    that follow, which may be many and short, the first, the last, and one between.

    Parameters
    ----------
    inputs : Inputs
        What may be given.
    """

    def __init__(self, inputs: Inputs) -> None:
        angles = [name for name, dimension in inputs.dimensions.items() if dimension == "angle"]
        self.names = {name for name in angles if not is_within_a_turn(*inputs.limits[name])}
        self._looked_at: set[str] = set()

    def look(self, given: Mapping[str, Any]) -> None:
        """Warn of plain numbers beyond a whole turn.

        Parameters
        ----------
        given : mapping of str to Any
            What is given to a run, by name.

        Warns
        -----
        AngleWarning
            Once for each parameter.
        """
        for name in tuple(self.names):
            value = given.get(name)
            if type(value) is float and -TURN <= value <= TURN:
                continue
            if type(value) is np.ndarray and value.size and value.dtype.kind == "f":
                if name in self._looked_at and _looks_small(value):
                    continue
                self._looked_at.add(name)
            if value is not None and warn_of_degrees(f"parameter '{name}'", value):
                self.names.discard(name)


def _looks_small(numbers: np.ndarray[Any, Any]) -> bool:
    """Tell whether three numbers of an array are within a whole turn; this takes no time."""
    first, last, between = numbers.item(0), numbers.item(-1), numbers.item(numbers.size // 2)
    return bool(-TURN <= first <= TURN and -TURN <= last <= TURN and -TURN <= between <= TURN)
