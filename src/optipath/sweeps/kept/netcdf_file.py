"""A sweep in a file of NetCDF, which is there whole or not at all."""

from __future__ import annotations

import secrets
import shutil
from contextlib import suppress
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import xarray as xr

from optipath.errors import ParameterError
from optipath.sweeps.blocks.keep_blocks import keep_blocks

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from optipath.sweeps.kept.sweep_job import SweepJob

_IDENTITY = "sweep_identity"
"""The attribute by which a file is known again."""

_TAKEN = "'{}' is there already, and holds something else; give another name, or move it away"


def kept_in_netcdf(
    job: SweepJob, file: Path, scheduler: Any, tell: Callable[[int, int], None] | None
) -> xr.Dataset:
    """Return a sweep out of its file, which is written if it is not there.

    The blocks are kept in a Zarr store beside it until all are there, so that this goes on where it
    was interrupted, too; the file is then written from it block by block, and put into its place.

    Parameters
    ----------
    job : SweepJob
        What is computed.
    file : Path
        Where it is to be.
    scheduler
        As `PathGraph.sweep` takes it.
    tell : callable or None
        As `keep_blocks` takes it.

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    ParameterError
        If another file is there already.
    JobError
        If the store beside it is of something else.
    """
    identity = sha256(job.identity.encode()).hexdigest()
    if file.exists():
        return _opened(file, identity)
    store = keep_blocks(job, file.with_name(f"{file.name}.zarr"), scheduler, tell)
    _write(file, store, identity, {name: each.chunks for name, each in job.arrays.items()})
    shutil.rmtree(store)
    return _opened(file, identity)


def _write(file: Path, store: Path, identity: str, chunks: Mapping[str, tuple[int, ...]]) -> None:
    """Write what a store holds beside the place of a file, and put it there."""
    draft = file.with_name(f".{secrets.token_hex(8)}.draft")
    encoding = {name: {"chunksizes": sizes} for name, sizes in chunks.items()}
    try:
        with xr.open_zarr(store) as kept:
            told = kept.assign_attrs({_IDENTITY: identity})
            written = told.to_netcdf(draft, engine="h5netcdf", encoding=encoding, compute=False)
            # One block after another: each is read, written, and forgotten.
            written.compute(scheduler="synchronous")
        _put(draft, file)
    except BaseException:
        with suppress(OSError):
            draft.unlink()
        raise


def _put(draft: Path, file: Path) -> None:
    # It may have come to be there since the sweep began.
    if file.exists():
        raise ParameterError(_TAKEN.format(file))
    draft.replace(file)


def _opened(file: Path, identity: str) -> xr.Dataset:
    """Return what a file holds, if it is the sweep that is asked for."""
    try:
        found = xr.open_dataset(file, engine="h5netcdf", chunks={})
    except OSError:
        found = None
    if found is None or found.attrs.pop(_IDENTITY, None) != identity:
        raise ParameterError(_TAKEN.format(file))
    return found
