"""Sweep: the light of a path over a grid of values, as a Dataset with pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarray as xr

from optipath.composer.composer import Composer
from optipath.composer.wiring import KEEPABLE
from optipath.errors import ParameterError
from optipath.faults import shown
from optipath.sweeps.axes import grid_of
from optipath.sweeps.memory import swept_in_memory
from optipath.values.parameters import check_named

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from matplotlib.axes import Axes

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan


def sweep(
    path: PathGraph,
    unnamed: tuple[object, ...],
    arguments: dict[str, Any],
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
    grid = grid_of(plan.inputs, arguments, zip, coords, ranges=not at_once)
    if at_once:
        try:
            return swept_in_memory(path, plan, grid, composer)
        except ParameterError as fault:
            message = fault
        grid_of(plan.inputs, arguments, zip, coords)
        raise message
    chunks = "auto" if chunks is None else chunks
    if place is None:
        from optipath.sweeps.chunks import swept_in_chunks  # noqa: PLC0415 - Dask takes its time

        return swept_in_chunks(path, plan, grid, chunks, composer)
    from optipath.sweeps.stored import SweepJob, stored_sweep  # noqa: PLC0415 - Zarr takes its time

    job = SweepJob.of(path, plan, grid, chunks, composer)
    return stored_sweep(job, place, scheduler, progress=progress)


def _plan(path: PathGraph, composer: Composer | None) -> Plan:
    """Return the plan of a path, which gives the light at its detectors."""
    if composer is None:
        return path.compose()
    if not isinstance(composer, Composer):
        argument = shown(composer)
        example = "composer=op.Composer(engine='numpy')"
        raise ParameterError(f"composer= takes a Composer, not {argument}; write {example}")
    if composer.keep != KEEPABLE[0]:
        raise ParameterError(
            f"a sweep gives the light at detectors, and Composer(keep='{composer.keep}') that on "
            f"every link as well; leave keep out, or put a Detector where light is to be read"
        )
    return path.plan_by(composer)


def _place(store: Any, scheduler: Any, progress: Any) -> str | None:
    """Return where a sweep is to be kept; None where it is not."""
    if store is not None:
        from optipath.sweeps.stored import place_of_store  # noqa: PLC0415

        return place_of_store(store)
    if scheduler is not None or progress:
        raise ParameterError(
            "scheduler= and progress= are for a sweep that is kept; give store= besides, such as "
            "store='sweep.zarr', or let Dask compute what chunks= gives: "
            "sweep.compute(scheduler=...)"
        )
    return None


class SweepPictures:
    """Pictures of the Dataset of a sweep, in memory, in chunks, or read from a file.

    >>> import optipath as op
    >>> sweep = op.load_preset("malus").sweep(angle="0 deg:90 deg:91")
    >>> sweep.optipath.curve("S0").get_xlabel()
    'angle: turn of the analyser against the polariser (°)'
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def curve(
        self,
        y: str | Sequence[str] = ("S0",),
        x: str | None = None,
        ax: Axes | None = None,
        *,
        detector: str | None = None,
    ) -> Axes:
        """Draw quantities against one coordinate, as `optipath.plots.curve` draws them."""
        drawn: Axes = _drawn("curve", self._dataset, y, x, ax, detector)
        return drawn

    def map(
        self,
        quantity: str = "S0",
        x: str | None = None,
        y: str | None = None,
        ax: Axes | None = None,
        *,
        detector: str | None = None,
    ) -> Axes:
        """Draw a quantity over two coordinates, as `optipath.plots.quantity_map` draws it."""
        drawn: Axes = _drawn("quantity_map", self._dataset, quantity, x, y, ax, detector)
        return drawn

    def poincare(self, x: str | None = None, ax: Any = None, *, detector: str | None = None) -> Any:
        """Draw the light along one coordinate on the Poincaré sphere, coloured by it."""
        return _drawn("poincare", self._dataset, x, ax, detector)


def _drawn(picture: str, *arguments: Any) -> Any:
    from optipath.plots import check_matplotlib  # noqa: PLC0415 - pictures stand above sweeps

    check_matplotlib()
    from optipath.plots import dataset_pictures  # noqa: PLC0415 - an extra

    return getattr(dataset_pictures, picture)(*arguments)


if not hasattr(xr.Dataset, "optipath"):  # Else xarray warns, where this is loaded anew.
    xr.register_dataset_accessor("optipath")(SweepPictures)  # type: ignore[no-untyped-call]
