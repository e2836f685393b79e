"""A sweep in memory: one run of the whole grid, of which variables are views."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.sweeps.labels.dataset_attributes import dataset_attributes
from optipath.sweeps.labels.dataset_labels import attributes_of, coordinates_of, dimensions_of
from optipath.sweeps.labels.light_quantities import COMPONENTS, DERIVED, FAINT
from optipath.sweeps.labels.variable_names import detectors_of, variable_names
from optipath.sweeps.whole.derived_variable import derived
from optipath.sweeps.whole.free_memory import refuse_more_than_free
from optipath.sweeps.whole.quick_dataset import quick_dataset
from optipath.sweeps.whole.stacked_views import stacked
from optipath.sweeps.whole.swept_light import SweptLight
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    import xarray as xr

    from optipath.composer.composer import Composer
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_grid import SweepGrid


def swept_in_memory(
    path: PathGraph, plan: Plan, grid: SweepGrid, composer: Composer | None = None
) -> xr.Dataset:
    """Return the light of a grid."""
    names, dims = variable_names(grid, plan), dimensions_of(grid, plan)
    coords = coordinates_of(grid, plan)
    refuse_more_than_free(plan, grid.varied)
    with units_are_written():  # Who reads the axes has told of degrees among them.
        found = plan.answers.lights(grid.given())
    lights = tuple([SweptLight(plan, grid, name, *found[name]) for name in detectors_of(plan)])
    variables: dict[str, Any] = {}
    each = zip(*[light.components for light in lights], strict=True)
    for quantity, parts in zip(COMPONENTS, each, strict=True):
        numbers = parts[0] if len(parts) == 1 else stacked(parts)
        variables[quantity.variable] = dims, numbers, attributes_of(quantity)
    faint = (FAINT,) if any(light.is_faint for light in lights) else ()
    for quantity in (*DERIVED, *faint):
        name = names[quantity.variable]
        variables[name] = dims, derived(quantity, lights), attributes_of(quantity)
    return quick_dataset(variables, coords, dataset_attributes(path, plan, composer))
