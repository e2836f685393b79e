"""LargeAngles: what is given for angles that nothing limits, looked at for degrees."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.degree_warnings import counts_degrees, warn_of_degrees, warn_of_two_factors
from optipath.values.degrees import TURN, is_within_a_turn
from optipath.values.texts import may_hold_texts

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.affine import Affine
    from optipath.values.inputs import Inputs


class LargeAngles:
    """The open parameters of a path that may be angles beyond a whole turn.

    What is looked at is the angle where it stands, as of a multiple with an offset. Of the first
    array for a parameter, a thousand numbers are looked at; of those that follow, which may be
    many and short, the first, the last, and one between.

    Parameters
    ----------
    inputs : Inputs
        What may be given.
    """

    def __init__(self, inputs: Inputs) -> None:
        self.places: dict[str, dict[tuple[float, float], Affine]] = {}
        for use in inputs.uses:
            value = use.value
            near = is_within_a_turn(*value.span_of(*inputs.limits[value.name]))
            if use.domain.dimension == "angle" and (not near or counts_degrees(value)):
                several = self.places.setdefault(value.name, {})
                several.setdefault((abs(value.scale), value.zero), value)
        self._ranges = [(name, *_within_a_turn(of)) for name, of in self.places.items()]
        self._looked_at: set[str] = set()

    def look(self, given: Mapping[str, Any]) -> None:
        """Warn of plain numbers that come to angles beyond a whole turn.

        Parameters
        ----------
        given : mapping of str to Any
            What is given to a run, by name.

        Warns
        -----
        AngleWarning
            Once for each parameter.
        """
        for name, low, high in self._ranges:
            value = given.get(name)
            if value is None or (type(value) is float and low <= value <= high):
                continue
            if type(value) is np.ndarray and value.size and value.dtype.kind == "f":
                if name in self._looked_at and _looks_small(value, low, high):
                    continue
                self._looked_at.add(name)
            self._warn(name, value)

    def _warn(self, name: str, value: Any) -> None:
        what, places = f"parameter '{name}'", self.places[name].values()
        texts = may_hold_texts(value)
        any(
            (texts and warn_of_two_factors(what, value, place))
            or warn_of_degrees(what, value, place)
            for place in places
        )


def _within_a_turn(places: Mapping[Any, Affine]) -> tuple[float, float]:
    """Return between which numbers a parameter is within a turn wherever it stands."""
    spans = [place.span_for(-TURN, TURN) for place in places.values()]
    return max(low for low, _ in spans), min(high for _, high in spans)


def _looks_small(numbers: np.ndarray[Any, Any], low: float, high: float) -> bool:
    """Tell whether three numbers of an array are within limits; this takes no time."""
    first, last, between = numbers.item(0), numbers.item(-1), numbers.item(numbers.size // 2)
    return bool(low <= first <= high and low <= last <= high and low <= between <= high)
