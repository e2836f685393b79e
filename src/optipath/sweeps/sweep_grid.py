"""The grid of a sweep: the outer product of its axes, whole or a part of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.sweeps.sweep_axis import SweepAxis


@dataclass(frozen=True)
class SweepGrid:
    """The outer product of some axes; those of one dimension vary together.

    Attributes
    ----------
    axes : tuple of SweepAxis
        In the order in which they were given.
    fixed : mapping of str to Any
        What is given besides, a single value each.
    """

    axes: tuple[SweepAxis, ...]
    fixed: Mapping[str, Any] = field(default_factory=dict)

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

    def given(self, region: Sequence[slice] | None = None) -> dict[str, Any]:
        """Return what `Plan.run` is given for the grid, or for a part of it.

        Parameters
        ----------
        region : sequence of slice, optional
            One for each dimension; by default all of it.

        Returns
        -------
        dict of str to Any
            Arrays that broadcast to the shape of the part: nothing is laid out.
        """
        places = list(self.sizes)
        found = dict(self.fixed)
        for axis in self.axes:
            place = places.index(axis.dimension)
            cut = slice(None) if region is None else region[place]
            behind = len(places) - 1 - place
            found[axis.name] = axis.given[cut].reshape(-1, *(1,) * behind)
        return found
