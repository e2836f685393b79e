"""The light of a sweep as Dask arrays: a task a block, and a small one for each variable."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import dask.array as da
import numpy as np
from dask.base import tokenize
from dask.delayed import delayed

from optipath.sweeps.axes.sweep_grid import SweepGrid
from optipath.sweeps.chunked.block_light import BlockLight, run_block
from optipath.sweeps.labels.variable_names import detectors_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from optipath.sweeps.chunked.plan_recipe import PlanRecipe
    from optipath.sweeps.labels.light_quantities import LightQuantity


class ChunkedLight:
    """The light of a sweep, block by block: each is computed once for all that is asked of it."""

    def __init__(self, recipe: PlanRecipe, grid: SweepGrid, sizes: Mapping[str, int]) -> None:
        self.detectors = len(detectors_of(recipe.plan))
        self.dtype = np.dtype(recipe.plan.dtype)
        self.places = tuple(range(len(sizes)))
        self.token = tokenize(recipe, grid, dict(sizes))
        places = dict(zip(sizes, self.places, strict=True))
        arguments: list[Any] = [delayed(recipe, name=f"recipe-{self.token}", traverse=False), None]
        for axis in grid.axes:
            # Each block is sent its part of the axes and not the whole of them.
            part = da.from_array(axis.given, sizes[axis.dimension])  # type: ignore[no-untyped-call]
            arguments += [part, (places[axis.dimension],)]
        bare = [replace(axis, shown=axis.shown[:0], given=axis.given[:0]) for axis in grid.axes]
        self._light = da.blockwise(  # type: ignore[no-untyped-call]
            _run,
            self.places,
            *arguments,
            name=f"light-{self.token}",
            align_arrays=False,
            meta=np.empty((0,) * len(places), object),
            bare=SweepGrid(tuple(bare), grid.fixed),
        )

    def of(self, quantity: LightQuantity) -> da.Array:
        """Return a quantity of it, lazily; of several detectors, along the first axis."""
        front = {len(self.places): self.detectors} if self.detectors > 1 else {}
        found: da.Array = da.blockwise(  # type: ignore[no-untyped-call]
            BlockLight.of,
            (*front, *self.places),
            self._light,
            self.places,
            quantity,
            None,
            name=f"{quantity.variable}-{self.token}",
            new_axes=front,
            meta=np.empty((0,) * (len(self.places) + len(front)), self.dtype),
        )
        return found


def _run(recipe: PlanRecipe, *values: npt.NDArray[Any], bare: SweepGrid) -> BlockLight:
    """Return the light of a block, for its part of the values of each axis."""
    axes = [
        replace(axis, shown=own, given=own) for axis, own in zip(bare.axes, values, strict=True)
    ]
    return run_block(recipe, SweepGrid(tuple(axes), bare.fixed))
