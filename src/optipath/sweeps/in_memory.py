"""A sweep in memory: one run of the whole grid, of which variables are views."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray as xr

from optipath.sweeps.light_quantities import COMPONENTS

if TYPE_CHECKING:
    from optipath.plan.plan import Plan
    from optipath.sweeps.sweep_grid import SweepGrid


def swept_in_memory(plan: Plan, grid: SweepGrid) -> xr.Dataset:
    """Return the light of a grid.

    Parameters
    ----------
    plan : Plan
        What is run.
    grid : SweepGrid
        With the values of its parameters.

    Returns
    -------
    xarray.Dataset
    """
    light = plan.run(**grid.given())
    variables = {each.variable: (tuple(grid.sizes), each.of(light)) for each in COMPONENTS}
    coords = {axis.name: (axis.dimension, axis.shown) for axis in grid.axes}
    return xr.Dataset(variables, coords)
