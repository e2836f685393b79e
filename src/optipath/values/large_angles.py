"""LargeAngles: what is given for angles that nothing limits, looked at for degrees."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.degree_warnings import counts_degrees, warn_of_degrees, warn_of_two_factors
from optipath.values.degrees import TURN, is_of_an_angle, is_within_a_turn
from optipath.values.texts import may_hold_texts

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Mapping

    from optipath.values.affine import Affine
    from optipath.values.inputs import Inputs


class LargeAngles:
    """The open parameters of a path that may be angles beyond a whole turn.

    Of the first array for a parameter, a thousand numbers are looked at; of those that follow,
    which may be many and short, the first, the last, and one between.

    Parameters
    ----------
    inputs : Inputs
        What may be given.
    """

    def __init__(self, inputs: Inputs) -> None:
        self.places: dict[str, dict[Hashable, Affine]] = {}
        for use in inputs.uses:
            value = use.value
            near = is_within_a_turn(*inputs.limits[value.name])
            large = is_of_an_angle(value.scale) and not near
            if use.domain.dimension == "angle" and (large or counts_degrees(value)):
                self.places.setdefault(value.name, {}).setdefault(value.quantity, value)
        self._ranges = [(name, _within(of.values())) for name, of in self.places.items()]
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
        for name, most in self._ranges:
            value = given.get(name)
            if value is None or (type(value) is float and -most <= value <= most):
                continue
            if type(value) is np.ndarray and value.size and value.dtype.kind == "f":
                if name in self._looked_at and _looks_small(value, most):
                    continue
                self._looked_at.add(name)
            self._warn(f"parameter '{name}'", name, value)

    def look_at_uncertainties(self, given: Mapping[str, Any]) -> None:
        """Warn of standard uncertainties that come to angles beyond a whole turn.

        Parameters
        ----------
        given : mapping of str to Any
            Those that are given, by the name of the parameter.

        Warns
        -----
        AngleWarning
            Once for each parameter.
        """
        for name in [name for name in given if name in self.places]:
            self._warn(f"the standard uncertainty of parameter '{name}'", name, given[name])

    def _warn(self, what: str, name: str, value: Any) -> None:
        places = self.places[name].values()
        texts = may_hold_texts(value)
        for place in places:
            if texts and warn_of_two_factors(what, value, place):
                return
            if warn_of_degrees(what, value, place):
                return


def _within(places: Iterable[Affine]) -> float:
    """Return up to what size no number for a parameter is one to warn of."""
    return TURN if any(is_of_an_angle(place.scale) for place in places) else math.inf


def _looks_small(numbers: np.ndarray[Any, Any], most: float) -> bool:
    """Tell whether three numbers of an array are up to some size; this takes no time."""
    first, last, between = numbers.item(0), numbers.item(-1), numbers.item(numbers.size // 2)
    return bool(abs(first) <= most and abs(last) <= most and abs(between) <= most)
