"""A sweep in chunks: Dask arrays, of which each block is one run of the plan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import xarray as xr

from optipath.sweeps.chunked.chunk_sizes import chunk_sizes
from optipath.sweeps.chunked.chunked_light import ChunkedLight
from optipath.sweeps.chunked.plan_recipe import PlanRecipe
from optipath.sweeps.labels.dataset_attributes import dataset_attributes
from optipath.sweeps.labels.dataset_labels import attributes_of, coordinates_of, dimensions_of
from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.sweeps.labels.variable_names import detectors_of, variable_names

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.composer.composer import Composer
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_grid import SweepGrid
    from optipath.sweeps.labels.light_quantities import LightQuantity


class ChunkedSweep(NamedTuple):
    """A sweep of which nothing is computed yet, and what it is made of."""

    recipe: PlanRecipe
    grid: SweepGrid
    quantities: Mapping[str, LightQuantity]
    dataset: xr.Dataset


def swept_in_chunks(
    path: PathGraph, plan: Plan, grid: SweepGrid, chunks: Any, composer: Composer | None = None
) -> ChunkedSweep:
    """Return the light of a grid, to be computed block by block."""
    names, dims = variable_names(grid, plan), dimensions_of(grid, plan)
    sizes = chunk_sizes(chunks, grid.sizes, len(detectors_of(plan)))
    recipe = PlanRecipe.of(path, composer)
    light = ChunkedLight(recipe, grid, sizes)
    quantities = {names[each.variable]: each for each in QUANTITIES}
    variables = {
        name: (dims, light.of(each), attributes_of(each)) for name, each in quantities.items()
    }
    attrs = dataset_attributes(path, plan, composer)
    found = xr.Dataset(variables, coordinates_of(grid, plan), attrs)
    return ChunkedSweep(recipe, grid, quantities, found)
