"""The sweep of a path: from what is given to a Dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.sweeps.in_memory import swept_in_memory
from optipath.sweeps.read_axes import grid_of
from optipath.values.by_name import check_named

if TYPE_CHECKING:
    import xarray as xr

    from optipath.composer.composer import Composer
    from optipath.paths.path_graph import PathGraph


def sweep(
    path: PathGraph,
    unnamed: tuple[object, ...],
    given: dict[str, Any],
    *,
    zip: Any = (),  # noqa: A002 - as `path.sweep` has it
    coords: Any = None,
    chunks: Any = None,
    store: Any = None,
    scheduler: Any = None,
    progress: bool = False,
    composer: Composer | None = None,
) -> xr.Dataset:
    """Return the light of a path for every combination of values; see `PathGraph.sweep`.

    Parameters
    ----------
    path : PathGraph
        What is swept.
    unnamed : tuple
        What is given without a name.
    given : dict of str to Any
        What is given by name.
    zip, coords, chunks, store, scheduler, progress, composer
        As `PathGraph.sweep` takes them.

    Returns
    -------
    xarray.Dataset
    """
    del chunks, store, scheduler, progress
    plan = path.compose() if composer is None else composer.compose(path)
    check_named("sweep", unnamed, plan.inputs.open)
    grid = grid_of(plan.inputs, given, zip, coords)
    return swept_in_memory(path, plan, grid, composer)
