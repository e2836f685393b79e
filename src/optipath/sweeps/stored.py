"""Stored sweeps: in a Zarr store or a NetCDF file, block after block."""

from __future__ import annotations

import os
import secrets
import shutil
import sys
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, partial
from hashlib import sha256
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import dask.array as da
import numpy as np
import xarray as xr
from dask.base import tokenize

from optipath.errors import OptipathError, ParameterError, PathError
from optipath.faults import shown
from optipath.light.quantities import QUANTITIES
from optipath.sweeps.blocks import keep_blocks
from optipath.sweeps.chunks import chunk_sizes, run_block
from optipath.sweeps.datasets import detectors_of, sweep_dataset
from optipath.sweeps.plan_recipe import PlanRecipe

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from os import PathLike

    import numpy.typing as npt

    from optipath.light.quantities import LightQuantity
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepAxis, SweepGrid

    Tell: TypeAlias = Callable[[int, int], None]


def place_of_store(store: str | PathLike[str]) -> str:
    """Return where a sweep is to be kept."""
    is_path = isinstance(store, str | os.PathLike)
    place = os.fspath(store).rstrip("/") if is_path else ""
    # A URL of a file of NetCDF has nothing beside it where blocks could be kept.
    endings = (".zarr",) if "://" in place else (".zarr", ".nc")
    if Path(place).suffix not in endings or "\0" in place:
        raise ParameterError(
            f"store {shown(place if is_path else store)} is neither a Zarr store nor a NetCDF "
            f"file: give a name that ends in {' or '.join(endings)}, such as 'sweep.zarr'"
        )
    return place


def stored_sweep(job: SweepJob, place: str, scheduler: Any, *, progress: bool | Tell) -> xr.Dataset:
    """Compute what is not kept yet of a sweep, and return what is kept."""
    tell = progress if callable(progress) else progress_line if progress else None
    if place.endswith(".nc"):
        return stored_in_netcdf(job, Path(place), scheduler, tell)
    store, data = keep_blocks(job, place, scheduler, tell), {}
    token = tokenize(store.place, store.seal)
    for name, chunks in job.chunks.items():
        array = store.arrays[name]
        nothing = np.empty((0,) * len(chunks), array.dtype)  # Else Dask reads what it is like.
        data[name] = da.from_array(array, chunks, f"{name}-{token}", meta=nothing)  # type: ignore[no-untyped-call]
    return job.dataset.copy(data=data)


@dataclass(frozen=True, eq=False)
class SweepJob:
    """A sweep that is computed block by block and kept; see `BlockJob`.

    ``sizes`` says how many values a block has along each dimension of the grid.
    """

    recipe: PlanRecipe
    grid: SweepGrid
    sizes: Mapping[str, int]
    quantities: Mapping[str, LightQuantity]
    dataset: xr.Dataset
    chunks: Mapping[str, tuple[int, ...]]

    @classmethod
    def of(
        cls, path: PathGraph, plan: Plan, grid: SweepGrid, chunks: Any, composer: Any = None
    ) -> SweepJob:
        """Return the job of a sweep; refuse what stores do not have."""
        recipe, detectors = PlanRecipe.of(path, composer), len(detectors_of(plan))
        sizes = chunk_sizes(chunks, grid.sizes, detectors)
        shape = (*[detectors] * (detectors > 1), *grid.shape)
        nothing = np.broadcast_to(np.zeros((), plan.dtype), shape)
        unfilled = {each.variable: nothing for each in QUANTITIES}
        dataset = sweep_dataset(path, plan, grid, composer, lambda: unfilled)
        if names := recipe.without_source:
            raise PathError(
                f"element class '{names[0]}' is defined in no file by which a store could tell it "
                f"from others; put it at the top level of a module and import it, or leave store= "
                f"out"
            )
        if nothing.itemsize > np.dtype("float64").itemsize:
            raise ParameterError(
                "stores have no numbers of dtype 'longdouble'; leave store= out, or give "
                "composer=op.Composer(dtype='float64')"
            )
        quantities = dict(zip(map(str, dataset.data_vars), QUANTITIES, strict=True))
        in_blocks = (*[detectors] * (detectors > 1), *sizes.values())
        chunked = dict.fromkeys(quantities, in_blocks)
        return cls(recipe, grid, sizes, quantities, dataset, chunked)

    @property
    def identity(self) -> str:
        """All of what is computed, a line each, so that the first other one can be told."""
        recipe, grid, variables = self.recipe, self.grid, self.dataset.variables
        lines = [f"a sweep by optipath {self.dataset.attrs['optipath_version']}, layout {LAYOUT}"]
        lines += [f"option {name}: {value!r}" for name, value in recipe.options]
        lines += [f"element class {' '.join(each)}" for each in recipe.own]
        lines += [f"fixed {name}: {_single(grid, name)}" for name in grid.fixed]
        lines += [f"axis {axis.name}: {_axis_text(axis)}" for axis in grid.axes]
        lines += [f"chunks of {name}: {size}" for name, size in self.sizes.items()]
        lines += [f"variable {name}: {variables[name].dtype}" for name in self.quantities]
        return "\n".join([*lines, recipe.text])

    @cached_property
    def regions(self) -> list[tuple[slice, ...]]:
        """The part of the grid that each block is, in the order of the axes."""
        cuts = [
            [slice(start, min(start + size, count)) for start in range(0, count, size)]
            for size, count in zip(self.sizes.values(), self.grid.shape, strict=True)
        ]
        return [*product(*cuts)]

    @property
    def blocks(self) -> int:
        """How many blocks there are."""
        return len(self.regions)

    def places(self, number: int) -> dict[str, tuple[slice, ...]]:
        """Return which part of each variable a block is."""
        region = self.regions[number]
        whole = [slice(None)] * (self.dataset.S0.ndim - len(region))
        return dict.fromkeys(self.quantities, (*whole, *region))

    def task(self, number: int) -> partial[dict[str, npt.NDArray[Any]]]:
        """Return what computes a block, with its own part of the axes: whole ones may be large."""
        grid = self.grid.part(self.regions[number])
        return partial(compute_block, number, self.recipe, grid, self.quantities)


def compute_block(
    number: int,  # noqa: ARG001 - for who counts
    recipe: PlanRecipe,
    grid: SweepGrid,
    quantities: Mapping[str, LightQuantity],
) -> dict[str, npt.NDArray[Any]]:
    """Return the values of each variable in a block."""
    light = run_block(recipe, grid)
    return {name: light.of(each) for name, each in quantities.items()}


LAYOUT = 1
"""The version of what a store of a sweep has in it."""


def _single(grid: SweepGrid, name: str) -> str:
    """Return what tells a fixed value from others: what is run, and how it was given."""
    value = repr(_python_number(grid.fixed[name]))
    shown, unit = grid.labels.get(name, (grid.fixed[name], ""))
    label = f"{_python_number(shown)} {unit}".rstrip()
    return value if label in (value, value.strip("'")) else f"{value}, given as {label}"


def _python_number(value: Any) -> Any:
    """Return a single number of NumPy as one of Python: they are the same sweep."""
    return value.item() if isinstance(value, np.generic | np.ndarray) else value


def _axis_text(axis: SweepAxis) -> str:
    """Return what tells an axis from all others, to the last bit."""
    ends = f"{axis.shown[0]} to {axis.shown[-1]} {axis.unit}".rstrip()
    digest = sha256()
    for values in (axis.given, axis.shown):
        held = values.tobytes() if values.dtype.kind != "O" else repr(values.tolist()).encode()
        digest.update(f"{values.dtype.str} {values.shape} ".encode() + held)
    return f"{len(axis)} values, {ends}, along {axis.dimension}, {digest.hexdigest()[:16]}"


_IDENTITY = "sweep_identity"
"""The attribute by which a file is known again."""

_TAKEN = "'{}' is there already, and {}; give another name, or move it away"
_FAULTS = (OSError, RuntimeError, ValueError, KeyError, TypeError, AttributeError, OverflowError)
"""What is raised, at various depths, by bytes that are no NetCDF."""


def place_of_blocks(store: str) -> str:
    """Return where the blocks of a sweep are until all are there."""
    if not store.endswith(".nc"):
        return store
    file = Path(store)
    return str(file.with_name(f".{file.name}.blocks"))


def stored_in_netcdf(
    job: SweepJob, file: Path, scheduler: Any, tell: Callable[[int, int], None] | None
) -> xr.Dataset:
    """Return a sweep out of its file, which is written if it is not there.

    Blocks are kept in a Zarr store beside the file until all are there, so that an interrupted run
    goes on; concurrent runs share that store.
    """
    identity = sha256(job.identity.encode()).hexdigest()
    if file.exists():
        return _opened(file, identity)
    place = place_of_blocks(str(file))
    try:
        _write(file, keep_blocks(job, place, scheduler, tell).group.store, identity, job)
    except (OptipathError, *_FAULTS):
        # Another run that was faster has put the file there, and removed the store.
        if not file.exists():
            raise
    result = _opened(file, identity)
    shutil.rmtree(place, ignore_errors=True)
    return result


def _write(file: Path, store: Any, identity: str, job: SweepJob) -> None:
    """Write what a store holds beside the place of a file, and put it there."""
    draft = file.with_name(f".{secrets.token_hex(8)}.draft")
    encoding = {name: {"chunksizes": chunks} for name, chunks in job.chunks.items()}
    try:
        with xr.open_zarr(store) as stored:
            message = stored.assign_attrs({_IDENTITY: identity})
            written = message.to_netcdf(draft, engine="h5netcdf", encoding=encoding, compute=False)
            # One block after another: each is read, written, and forgotten.
            written.compute(scheduler="synchronous")
        if not file.exists():  # It may have come to be there since the sweep began.
            draft.replace(file)
    finally:
        with suppress(OSError):
            draft.unlink()


def _opened(file: Path, identity: str) -> xr.Dataset:
    """Return what a file holds, if it is the sweep that is asked for."""
    if not file.is_file():
        raise ParameterError(_TAKEN.format(file, "is no file"))
    try:
        result = xr.open_dataset(file, engine="h5netcdf", chunks={})
    except _FAULTS:
        raise ParameterError(_TAKEN.format(file, "is no NetCDF file, or a damaged one")) from None
    if result.attrs.pop(_IDENTITY, None) != identity:
        result.close()
        raise ParameterError(_TAKEN.format(file, "holds something else"))
    return result


_WIDTH = 40


def progress_line(done: int, total: int) -> None:
    """Write over the last line of the terminal how far a sweep is."""
    filled = _WIDTH * done // total
    if done and filled == _WIDTH * (done - 1) // total:
        return  # It looks the same.
    bar = f"[{'#' * filled}{' ' * (_WIDTH - filled)}] {done} of {total} blocks"
    sys.stderr.write(f"{bar}\n" if done == total else f"{bar}\r")
    sys.stderr.flush()
