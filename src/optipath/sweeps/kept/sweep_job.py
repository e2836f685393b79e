"""A sweep as a job of blocks that are kept, each computed by itself."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.sweeps.blocks.block_job import KeptArray, WholeArray
from optipath.sweeps.kept.sweep_block import SweepBlock
from optipath.sweeps.kept.sweep_identity import sweep_identity

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from optipath.sweeps.axes.sweep_grid import SweepGrid
    from optipath.sweeps.chunked.in_chunks import ChunkedSweep
    from optipath.sweeps.chunked.plan_recipe import PlanRecipe
    from optipath.sweeps.labels.light_quantities import LightQuantity


@dataclass(frozen=True)
class SweepJob:
    """A sweep that is computed block by block and kept; see `BlockJob`."""

    recipe: PlanRecipe
    grid: SweepGrid
    sizes: Mapping[str, int]
    quantities: Mapping[str, LightQuantity]
    arrays: Mapping[str, KeptArray]
    coords: Mapping[str, WholeArray]
    attrs: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, chunked: ChunkedSweep) -> SweepJob:
        """Return the job that keeps a sweep in chunks."""
        if chunked.dataset.S0.dtype.itemsize > np.dtype("float64").itemsize:
            raise ParameterError(
                "stores have no numbers of dtype 'longdouble'; leave store= out, or give "
                "composer=op.Composer(dtype='float64')"
            )
        dataset, sizes = chunked.dataset, chunked.dataset.chunksizes
        arrays = {
            str(name): KeptArray(
                tuple(map(str, each.dims)),
                each.shape,
                tuple([sizes[dimension][0] for dimension in each.dims]),
                str(each.dtype),
                each.attrs,
            )
            for name, each in dataset.data_vars.items()
        }
        coords = {
            str(name): WholeArray(tuple(map(str, each.dims)), _fixed(each.to_numpy()), each.attrs)
            for name, each in dataset.coords.items()
        }
        each_size = {name: sizes[name][0] for name in chunked.grid.sizes}
        return cls(
            chunked.recipe,
            chunked.grid,
            each_size,
            chunked.quantities,
            arrays,
            coords,
            dataset.attrs,
        )

    @property
    def identity(self) -> str:
        """All of what is computed, a line each: other values, blocks, or bits are another sweep."""
        types = {name: each.dtype for name, each in self.arrays.items()}
        return sweep_identity(self.recipe, self.grid, self.sizes, types)

    @property
    def _counts(self) -> tuple[int, ...]:
        """How many blocks there are along each dimension."""
        return tuple([-(-count // self.sizes[name]) for name, count in self.grid.sizes.items()])

    @property
    def blocks(self) -> int:
        """How many blocks there are."""
        return prod(self._counts)

    def region(self, number: int) -> tuple[slice, ...]:
        """Return the part of the grid that a block is, counted from 0 in the order of the axes."""
        places = np.unravel_index(number, self._counts)
        return tuple(
            [
                slice(int(place) * size, min((int(place) + 1) * size, count))
                for place, size, count in zip(
                    places, self.sizes.values(), self.grid.shape, strict=True
                )
            ]
        )

    def part(self, number: int) -> SweepBlock:
        """Return the inputs of one block: whole axes may be too large to be sent along."""
        region = self.region(number)
        grid = self.grid.part(region)
        return SweepBlock(self.recipe, grid, region, self.quantities)

    def compute(self, number: int) -> dict[str, tuple[tuple[slice, ...], npt.NDArray[Any]]]:
        """Return the part of each variable that a block is, and what is in it."""
        return self.part(number).compute(number)


def _fixed(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return words as words of a fixed length, which stores have."""
    return values.astype(str) if values.dtype.kind == "O" else values
