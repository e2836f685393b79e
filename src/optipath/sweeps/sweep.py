"""The sweep of a path: from what is given to a Dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import optipath.sweeps.sweep_pictures  # noqa: F401 - a Dataset has pictures by it
from optipath.composer.composer import Composer
from optipath.composer.wiring import KEPT
from optipath.errors import ParameterError, shown
from optipath.sweeps.axes.read_axes import grid_of
from optipath.sweeps.whole.in_memory import swept_in_memory
from optipath.values.by_name import check_named

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import xarray as xr

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan


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
    progress: bool | Callable[[int, int], None] = False,
    composer: Composer | None = None,
) -> xr.Dataset:
    """Return the light of a path for every combination of values; see `PathGraph.sweep`."""
    place = _place(store, scheduler, progress)
    plan = _plan(path, composer)
    check_named("sweep", unnamed, plan.inputs.open)
    at_once = place is None and chunks is None
    # A run looks at ranges itself, and what it finds is told by the axes.
    grid = grid_of(plan.inputs, given, zip, coords, ranges=not at_once)
    if at_once:
        try:
            return swept_in_memory(path, plan, grid, composer)
        except ParameterError as fault:
            told = fault
        grid_of(plan.inputs, given, zip, coords)
        raise told
    from optipath.sweeps.chunked.in_chunks import swept_in_chunks  # noqa: PLC0415 - Dask takes its time

    chunked = swept_in_chunks(path, plan, grid, "auto" if chunks is None else chunks, composer)
    if place is None:
        return chunked.dataset
    from optipath.sweeps.kept.kept_sweep import kept_sweep  # noqa: PLC0415 - Zarr, too
    from optipath.sweeps.kept.sweep_job import SweepJob  # noqa: PLC0415

    return kept_sweep(SweepJob.of(chunked), place, scheduler, progress=progress)


def _plan(path: PathGraph, composer: Composer | None) -> Plan:
    """Return the plan of a path, which gives the light at its detectors."""
    if composer is None:
        return path.compose()
    if not isinstance(composer, Composer):
        given = shown(composer)
        example = "composer=op.Composer(engine='numpy')"
        raise ParameterError(f"composer= takes a Composer, not {given}; write {example}")
    if composer.keep != KEPT[0]:
        raise ParameterError(
            f"a sweep gives the light at detectors, and Composer(keep='{composer.keep}') that on "
            f"every link as well; leave keep out, or put a Detector where light is to be read"
        )
    return path.plan_by(composer)


def _place(store: Any, scheduler: Any, progress: Any) -> Path | None:
    """Return where a sweep is to be kept; None where it is not."""
    if store is not None:
        from optipath.sweeps.kept.kept_sweep import place_of_store  # noqa: PLC0415

        return place_of_store(store)
    given = {"scheduler": scheduler is not None, "progress": bool(progress)}
    if told := [f"{name}=" for name, is_given in given.items() if is_given]:
        raise ParameterError(
            f"{' and '.join(told)} {'is' if len(told) == 1 else 'are'} for a sweep that is kept; "
            f"give store= besides, such as store='sweep.zarr', or let Dask compute what chunks= "
            f"gives: sweep.compute(scheduler=...)"
        )
    return None
