"""FollowingFloats: what follows from plain floats that are given, found again for the same ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.values.curves.computed_values import computed_values
from optipath.values.resolved import THERE, Resolved

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs


class FollowingFloats:
    """Puts numbers that follow from the wavelength beside those that are given."""

    def __init__(self, inputs: Inputs) -> None:
        self.computed = inputs.computed
        arguments = {one.name: one for value in self.computed for one in value.arguments}
        self.defaults = {n: inputs.open[n].default for n in arguments if n in inputs.open}
        self._ranges = [inputs.limits[name] for name in self.defaults]
        self._last: tuple[tuple[Any, ...], dict[str, float]] = (), {}

    def beside(self, given: Mapping[str, float]) -> Mapping[str, float] | None:
        """Return what is given and what follows from it; None where that is to be looked at."""
        numbers = tuple([given.get(name, default) for name, default in self.defaults.items()])
        last, found = self._last
        if numbers != last:
            for number, (low, high) in zip(numbers, self._ranges, strict=True):
                if type(number) is not float or not low <= number <= high:
                    return None
            pairs = zip(self.defaults, numbers, strict=True)
            resolved = {name: Resolved(number, THERE) for name, number in pairs}
            computed = computed_values(self.computed, resolved)
            found = {name: of_it.value.item() for name, of_it in computed.items()}
            self._last = numbers, found
        return {**given, **found}
