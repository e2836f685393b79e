"""LargeAngles: what is given for angles that nothing limits, looked at for degrees."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.degree_warnings import warn_of_degrees, warn_of_two_factors
from optipath.values.degrees import TURN, counts_degrees, is_of_an_angle, is_within_a_turn
from optipath.values.texts import may_hold_texts

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs


class LargeAngles:
    """The open parameters of a path that may be angles beyond a whole turn.

    Of the first array for a parameter, a thousand numbers are looked at; of those that follow,
    which may be many and short, the first, the last, and one between.
    """

    def __init__(self, inputs: Inputs) -> None:
        self.names: list[str] = []
        self._turned: set[str] = set()
        for use in inputs.uses:
            name = use.value.name
            if use.domain.dimension == "angle" and counts_degrees(use.value.scale):
                self._turned.add(name)
            of_angle = use.domain.dimension == "angle" and is_of_an_angle(use.value.scale)
            if of_angle and name not in self.names and not is_within_a_turn(*inputs.limits[name]):
                self.names.append(name)
        self.looks = bool(self.names or self._turned)
        self._looked_at: set[str] = set()

    def look(self, given: Mapping[str, Any]) -> None:
        """Warn of plain numbers that come to angles beyond a whole turn."""
        for name in self._turned & given.keys():
            if may_hold_texts(given[name]):
                warn_of_two_factors(name, given[name])
        for name in self.names:
            value = given.get(name)
            if value is None or (type(value) is float and -TURN <= value <= TURN):
                continue
            if type(value) is np.ndarray and value.size and value.dtype.kind == "f":
                if name in self._looked_at and _looks_small(value):
                    continue
                self._looked_at.add(name)
            warn_of_degrees(f"parameter '{name}'", value)

    def look_at_uncertainties(self, given: Mapping[str, Any]) -> None:
        """Warn of standard uncertainties that come to angles beyond a whole turn."""
        for name in [name for name in given if name in self.names]:
            warn_of_degrees(f"the standard uncertainty of parameter '{name}'", given[name])


def _looks_small(numbers: np.ndarray[Any, Any]) -> bool:
    """Tell whether three numbers of an array are within a whole turn; this takes no time."""
    first, last, between = numbers.item(0), numbers.item(-1), numbers.item(numbers.size // 2)
    return bool(abs(first) <= TURN and abs(last) <= TURN and abs(between) <= TURN)
