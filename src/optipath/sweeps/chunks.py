"""Sweeps in chunks: Dask arrays, each block one run of the path."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import dask.array as da
import numpy as np
from dask.base import tokenize
from dask.delayed import delayed

from optipath.errors import ParameterError
from optipath.faults import Cure, Fault, shown, unknown
from optipath.light.quantities import QUANTITIES
from optipath.sweeps.datasets import detectors_of, regions, sweep_dataset
from optipath.sweeps.plan_recipe import PlanRecipe
from optipath.values.precision import is_whole

if TYPE_CHECKING:
    import numpy.typing as npt
    import xarray as xr

    from optipath.composer.composer import Composer
    from optipath.light.light import Light
    from optipath.light.quantities import LightQuantity
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepGrid


def swept_in_chunks(
    path: PathGraph, plan: Plan, grid: SweepGrid, chunks: Any, composer: Composer | None = None
) -> xr.Dataset:
    """Return the light of a grid, to be computed block by block."""
    recipe = PlanRecipe.of(path, composer)
    sizes = chunk_sizes(chunks, grid.sizes, len(detectors_of(plan)))
    return sweep_dataset(path, plan, grid, composer, lambda: _arrays_of(recipe, grid, sizes))


def _arrays_of(
    recipe: PlanRecipe, grid: SweepGrid, sizes: Mapping[str, int]
) -> dict[str, da.Array]:
    """Return each quantity; the light of a block is computed once for all of them."""
    token = tokenize(recipe, grid, dict(sizes))
    places = {name: place for place, name in enumerate(sizes)}
    arguments: list[Any] = [delayed(recipe, name=f"recipe-{token}", traverse=False), None]
    for axis in grid.axes:
        # Each block is sent its part of the axes and not the whole of them.
        part = da.from_array(axis.given, sizes[axis.dimension])  # type: ignore[no-untyped-call]
        arguments += [part, (places[axis.dimension],)]
    along = tuple(places.values())
    light = da.blockwise(  # type: ignore[no-untyped-call]
        _run,
        along,
        *arguments,
        name=f"light-{token}",
        align_arrays=False,
        meta=np.empty((0,) * len(along), object),
        bare=grid.part([slice(0)] * len(sizes)),
    )
    detectors = len(detectors_of(recipe.plan))
    front = {len(along): detectors} if detectors > 1 else {}
    meta = np.empty((0,) * (len(along) + len(front)), recipe.plan.dtype)
    return {
        each.variable: da.blockwise(  # type: ignore[no-untyped-call]
            BlockLight.of,
            (*front, *along),
            light,
            along,
            each,
            None,
            name=f"{each.variable}-{token}",
            new_axes=front,
            meta=meta,
        )
        for each in QUANTITIES
    }


def _run(recipe: PlanRecipe, *values: npt.NDArray[Any], bare: SweepGrid) -> BlockLight:
    """Return the light of a block, for its part of the values of each axis."""
    axes = [
        replace(axis, shown=own, given=own) for axis, own in zip(bare.axes, values, strict=True)
    ]
    return run_block(recipe, replace(bare, axes=tuple(axes)))


_AT_ONCE = 1 << 18
"""How many points are run at a time: what is made on the way stays small, and in the cache."""


@dataclass(frozen=True)
class BlockLight:
    """The light of all detectors, for the points of one block."""

    shape: tuple[int, ...]
    lights: tuple[tuple[Light, ...], ...]
    ran: tuple[int, ...]

    def of(self, quantity: LightQuantity) -> npt.NDArray[Any]:
        """Return a copy of a quantity's numbers, to free the light; detectors come first."""
        numbers = [
            np.concatenate([np.ravel(quantity.of(light)) for light in several])
            for several in self.lights
        ]
        front = (len(numbers),) if len(numbers) > 1 else ()
        result = np.concatenate(numbers).reshape(*front, *self.ran)
        whole = (*front, *self.shape)
        return result if result.shape == whole else np.broadcast_to(result, whole)

    def __sizeof__(self) -> int:
        # What Dask takes for its memory: Stokes vectors and, once it is asked for, their noise.
        return sum(light.stokes.nbytes for several in self.lights for light in several) * 2


def run_block(recipe: PlanRecipe, block: SweepGrid) -> BlockLight:
    """Return the light of a block."""
    plan, varied = recipe.plan, block.varied
    results = []
    for region in regions(varied.shape, _AT_ONCE):
        numbers = varied.part(region).given()
        results.append(plan.answers.in_frames(plan.answers.lights(numbers), numbers))
    lights = [tuple([light[name] for light in results]) for name in detectors_of(plan)]
    return BlockLight(block.shape, tuple(lights), varied.shape)


BLOCK = 1 << 20
"""About how many points a block has that nobody has chosen a size for."""


def chunk_sizes(chunks: Any, sizes: Mapping[str, int], detectors: int = 1) -> dict[str, int]:
    """Return how many values a block has along each dimension.

    >>> chunk_sizes("auto", {"delta": 1000, "rho": 1000, "phi": 100})
    {'delta': 10, 'rho': 1000, 'phi': 100}
    >>> chunk_sizes({"delta": 250, "phi": -1}, {"delta": 1000, "rho": 1000, "phi": 100})
    {'delta': 250, 'rho': 40, 'phi': 100}
    """
    if not sizes:
        raise ParameterError(
            "chunks= and store= cut axes into blocks, and there is no axis; give several values "
            "for a parameter, or leave them out"
        )
    message = _sizes_by_name(chunks, sizes)
    results = {name: min(sizes[name], size) for name, size in message.items()}
    room = BLOCK // detectors
    for size in results.values():
        room //= size
    for name in reversed([*sizes]):
        if name not in results:
            # As few and as equal parts as there can be.
            parts = -(-sizes[name] // max(1, min(room, sizes[name])))
            results[name] = -(-sizes[name] // parts)
            room //= results[name]
    return {name: results[name] for name in sizes}


def _sizes_by_name(chunks: Any, sizes: Mapping[str, int]) -> dict[str, int]:
    """Return the sizes that somebody has chosen."""
    given = chunks if isinstance(chunks, Mapping) else dict.fromkeys(sizes, chunks)
    faults = [fault for name in given for fault in unknown("dimension", name, sizes)]
    results = {}
    for name, size in given.items():
        if isinstance(size, str) and size == "auto":
            continue
        if not (is_whole(size) or is_whole(size, -1, -1)):
            usual = "give 'auto', a number of values along each dimension"
            several = f", or {{'{next(iter(sizes))}': 10}}; -1 keeps a dimension whole"
            cure = Cure(usual + several, command=f"{usual}, such as 1000")
            faults.append(Fault(f"chunks cannot be {shown(size)}", cure))
        elif name in sizes:
            results[name] = sizes[name] if size == -1 else int(size)
    ParameterError.raise_for(faults)
    return results
