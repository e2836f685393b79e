"""The grid of a sweep: the outer product of its axes, whole or a part of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.sweeps.axes.sweep_axis import SweepAxis


@dataclass(frozen=True)
class SweepGrid:
    """The outer product of some axes; those of one dimension vary together."""

    axes: tuple[SweepAxis, ...]
    fixed: Mapping[str, Any] = field(default_factory=dict)
    labels: Mapping[str, tuple[Any, str]] = field(default_factory=dict)

    @cached_property
    def sizes(self) -> dict[str, int]:
        """How many values each dimension has, in order."""
        return {axis.dimension: len(axis) for axis in self.axes}

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the grid."""
        return tuple(self.sizes.values())

    @property
    def points(self) -> int:
        """How many paths it has."""
        return prod(self.shape)

    @property
    def varied(self) -> SweepGrid:
        """The same grid with one value along each dimension on which nothing depends."""
        held = {axis.dimension for axis in self.axes if not axis.idle}
        if len(held) == len(self.sizes):
            return self
        return self.part([slice(0, None if name in held else 1) for name in self.sizes])

    def part(self, region: Sequence[slice]) -> SweepGrid:
        """Return a part of the grid."""
        cuts = dict(zip(self.sizes, region, strict=True))
        axes = [
            replace(
                axis, shown=axis.shown[cuts[axis.dimension]], given=axis.given[cuts[axis.dimension]]
            )
            for axis in self.axes
        ]
        return replace(self, axes=tuple(axes))

    def given(self, region: Sequence[slice] | None = None) -> dict[str, Any]:
        """Return what `Plan.run` is given for the grid, or for a part of it."""
        places = list(self.sizes)
        found = dict(self.fixed)
        used = [axis for axis in self.axes if not axis.idle]
        is_whole = len(used) == len(self.axes)
        for axis in used:
            place = places.index(axis.dimension)
            cut = slice(None) if region is None else region[place]
            behind = len(places) - 1 - place
            ahead = 0 if is_whole else place  # Dimensions in front may have no other array.
            found[axis.name] = axis.given[cut].reshape(*(1,) * ahead, -1, *(1,) * behind)
        return found
