"""A sweep as a job of blocks that are kept, each computed by itself."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from hashlib import sha256
from importlib.metadata import version
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.block_light import run_block
from optipath.sweeps.blocks.block_job import KeptArray, WholeArray

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt
    import xarray as xr

    from optipath.sweeps.light_quantities import LightQuantity
    from optipath.sweeps.plan_recipe import PlanRecipe
    from optipath.sweeps.sweep_grid import SweepGrid

LAYOUT = 1
"""The version of what a store of a sweep has in it."""


@dataclass(frozen=True)
class SweepJob:
    """A sweep that is computed block by block and kept; see `BlockJob`.

    Attributes
    ----------
    recipe : PlanRecipe
        What is run.
    grid : SweepGrid
        With the values of its parameters.
    sizes : mapping of str to int
        How many values a block has along each dimension.
    quantities : mapping of str to LightQuantity
        By the names of their variables.
    arrays, coords, attrs
        The variables, coordinates and attributes of the Dataset.
    """

    recipe: PlanRecipe
    grid: SweepGrid
    sizes: Mapping[str, int]
    quantities: Mapping[str, LightQuantity]
    arrays: Mapping[str, KeptArray]
    coords: Mapping[str, WholeArray]
    attrs: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        recipe: PlanRecipe,
        grid: SweepGrid,
        quantities: Mapping[str, LightQuantity],
        chunked: xr.Dataset,
    ) -> SweepJob:
        """Return the job that keeps a sweep in chunks.

        Parameters
        ----------
        recipe, grid, quantities
            What the sweep is made of.
        chunked : xarray.Dataset
            The sweep as Dask arrays, of which nothing is computed.

        Returns
        -------
        SweepJob
        """
        sizes = {name: chunked.chunksizes[name][0] for name in grid.sizes}
        every = dict(chunked.sizes) | sizes
        arrays = {
            str(name): KeptArray(
                tuple(map(str, each.dims)),
                each.shape,
                tuple([every[dimension] for dimension in each.dims]),
                str(each.dtype),
                each.attrs,
            )
            for name, each in chunked.data_vars.items()
        }
        coords = {
            str(name): WholeArray(tuple(map(str, each.dims)), each.to_numpy(), each.attrs)
            for name, each in chunked.coords.items()
        }
        return cls(recipe, grid, sizes, quantities, arrays, coords, chunked.attrs)

    @property
    def identity(self) -> str:
        """All of what is computed: another path, value, block or library is another sweep."""
        axes = [
            (axis.name, axis.dimension, axis.unit, _digest(axis.given), _digest(axis.shown))
            for axis in self.grid.axes
        ]
        told = {
            "layout": LAYOUT,
            "version": version("optipath"),
            "path": self.recipe.text,
            "options": {name: repr(value) for name, value in self.recipe.options},
            "axes": axes,
            "fixed": {name: repr(value) for name, value in self.grid.fixed.items()},
            "chunks": dict(self.sizes),
            "variables": {name: each.dtype for name, each in self.arrays.items()},
        }
        return json.dumps(told)

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

    def compute(self, number: int) -> dict[str, tuple[tuple[slice, ...], npt.NDArray[Any]]]:
        """Return the part of each variable that a block is, and what is in it.

        Parameters
        ----------
        number : int
            Which block, from 0.

        Returns
        -------
        dict of str to (tuple of slice, ndarray)
        """
        region = self.region(number)
        light = run_block(self.recipe, self.grid.part(region))
        front = (slice(0, len(light.lights)),) if len(light.lights) > 1 else ()
        return {name: ((*front, *region), light.of(each)) for name, each in self.quantities.items()}


def _digest(values: npt.NDArray[Any]) -> str:
    """Return what tells arrays from each other, to the last bit."""
    held = values.tobytes() if values.dtype.kind != "O" else repr(values.tolist()).encode()
    return sha256(f"{values.dtype.str} {values.shape} ".encode() + held).hexdigest()
