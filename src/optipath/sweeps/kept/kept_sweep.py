"""A sweep that is kept: in a Zarr store, or in a file of NetCDF."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import xarray as xr

from optipath.errors import ParameterError, shown
from optipath.sweeps.blocks.keep_blocks import keep_blocks
from optipath.sweeps.kept.netcdf_file import kept_in_netcdf
from optipath.sweeps.kept.progress_line import progress_line

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike

    from optipath.sweeps.kept.sweep_job import SweepJob

    Tell: TypeAlias = Callable[[int, int], None]


def place_of_store(store: str | PathLike[str]) -> Path:
    """Return where a sweep is to be kept.

    Examples
    --------
    >>> place_of_store("sweep.csv")
    Traceback (most recent call last):
    optipath.errors.ParameterError: store 'sweep.csv' is neither a Zarr store nor a NetCDF file: \
    give a name that ends in .zarr or .nc, such as 'sweep.zarr'
    """
    is_path = isinstance(store, str | os.PathLike)
    place = Path(store) if is_path else Path()
    if place.suffix not in (".zarr", ".nc"):
        stem = "sweep" if place.stem in ("", ".zarr", ".nc") else place.stem
        raise ParameterError(
            f"store {shown(str(store) if is_path else store)} is neither a Zarr store nor a NetCDF "
            f"file: give a name that ends in .zarr or .nc, such as '{stem}.zarr'"
        )
    return place


def kept_sweep(job: SweepJob, place: Path, scheduler: Any, *, progress: bool | Tell) -> xr.Dataset:
    """Compute what is not kept yet of a sweep, and return what is kept."""
    tell = progress if callable(progress) else progress_line if progress else None
    if place.suffix == ".nc":
        return kept_in_netcdf(job, place, scheduler, tell)
    found: xr.Dataset = xr.open_zarr(keep_blocks(job, place, scheduler, tell))
    for each in found.variables.values():
        each.encoding = {}  # How it is packed here is for this version of Zarr alone.
    return found
