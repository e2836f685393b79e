"""Samples of uncertain values: normal, correlated, and within their ranges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, listed
from optipath.sweeps.uncertainty.correlation import root_of

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    import numpy.typing as npt

    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

_CHUNK = 4096
"""How many random numbers begin anew, whatever the blocks are that samples run in."""

_ROUNDS = 1000
"""How often samples outside are drawn again, before what is inside is next to nothing."""


class DrawnSamples:
    """Samples of some values, one set of random numbers for every path of a batch.

    Where a value would leave its range, it is drawn again, path by path, and with it the values
    that it is correlated with: what is left is the normal distribution cut off at the ends. The
    same seed gives each value the same samples, however they are cut into blocks, in whatever
    order values are given, and whatever else is uncertain that it is not correlated with.

    Shape: correlation (k, k).
    """

    def __init__(
        self,
        uncertain: Sequence[UncertainValue],
        correlation: npt.NDArray[np.float64],
        places: Sequence[int],
        count: int,
        seed: int,
        axes: int,
    ) -> None:
        self.count, self._seed, self._axes = count, seed, axes
        self._places = {each.name: place for each, place in zip(uncertain, places, strict=True)}
        self._groups = [
            ([uncertain[place] for place in group], root_of(correlation[np.ix_(group, group)]))
            for group in _groups(correlation, places)
        ]
        self.outside = dict.fromkeys([each.name for each in uncertain], 0)

    def within(self, block: slice, names: Collection[str]) -> dict[str, npt.NDArray[np.float64]]:
        """Return some samples of some values, an axis of them in front of the batch."""
        found: dict[str, list[Any]] = {name: [] for name in names}
        for chunk in range(block.start // _CHUNK, (block.stop - 1) // _CHUNK + 1):
            first = chunk * _CHUNK
            part = slice(max(block.start - first, 0), min(block.stop - first, _CHUNK))
            for group, root in self._groups:
                if any(each.name in found for each in group):
                    drawn = self._within(group, root, chunk, part)
                    for each in group:
                        if each.name in found:
                            found[each.name].append(drawn[each.name])
        return {name: np.concatenate(parts) for name, parts in found.items()}

    def _within(
        self, group: Sequence[UncertainValue], root: Any, chunk: int, part: slice
    ) -> dict[str, Any]:
        found = self._drawn(group, root, chunk, part, 0)
        for each in group:
            outer = ~_inside(each, found[each.name])
            outer = outer.reshape(len(outer), -1).any(axis=1)
            self.outside[each.name] += int(np.count_nonzero(outer))
        for number in range(1, _ROUNDS):
            bad = ~np.logical_and.reduce(
                np.broadcast_arrays(*[_inside(each, found[each.name]) for each in group])
            )
            if not np.any(bad):
                return found
            again = self._drawn(group, root, chunk, part, number)
            found = {name: np.where(bad, again[name], found[name]) for name in found}
        raise ParameterError(_hardly_any([each.name for each in group]))

    def _drawn(
        self, group: Sequence[UncertainValue], root: Any, chunk: int, part: slice, number: int
    ) -> dict[str, Any]:
        """Return the samples that are drawn in some round, be they inside or not."""
        normal = [self._normal(self._places[each.name], chunk, number)[part] for each in group]
        found = {}
        for each, row in zip(group, root, strict=True):
            mixed = sum(weight * some for weight, some in zip(row, normal, strict=True))
            mixed = np.reshape(mixed, (-1, *(1,) * self._axes))
            with np.errstate(over="ignore"):
                found[each.name] = each.value + each.sigma * mixed
        return found

    def _normal(self, place: int, chunk: int, number: int) -> npt.NDArray[np.float64]:
        own = np.random.SeedSequence(self._seed, spawn_key=(place, chunk, number))
        return np.random.Generator(np.random.PCG64(own)).standard_normal(_CHUNK)


def _groups(correlation: npt.NDArray[np.float64], places: Sequence[int]) -> list[list[int]]:
    """Return which values are correlated, also by way of others, in the order of their places."""
    together = correlation != 0.0
    for _ in places:
        together = together @ together
    order = sorted(range(len(places)), key=places.__getitem__)
    groups = [[other for other in order if together[one, other]] for one in order]
    return [group for one, group in zip(order, groups, strict=True) if group[0] == one]


def _inside(each: UncertainValue, samples: Any) -> Any:
    return each.allows(samples) & np.isfinite(samples)


def _hardly_any(names: list[str]) -> str:
    return (
        f"hardly any sample of {listed(names)} is within the range; give a smaller uncertainty, "
        f"or a value farther inside"
    )
