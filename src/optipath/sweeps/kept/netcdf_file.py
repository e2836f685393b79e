"""A sweep in a file of NetCDF, which is there whole or not at all."""

from __future__ import annotations

import secrets
import shutil
from contextlib import suppress
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import xarray as xr

from optipath.errors import OptipathError, ParameterError
from optipath.sweeps.blocks.keep_blocks import keep_blocks
from optipath.sweeps.kept.block_place import place_of_blocks

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from optipath.sweeps.kept.sweep_job import SweepJob

_IDENTITY = "sweep_identity"
"""The attribute by which a file is known again."""

_TAKEN = "'{}' is there already, and {}; give another name, or move it away"
_FAULTS = (OSError, RuntimeError, ValueError, KeyError, TypeError, AttributeError, OverflowError)
"""What is raised, at various depths, by bytes that are no NetCDF."""


def kept_in_netcdf(
    job: SweepJob, file: Path, scheduler: Any, tell: Callable[[int, int], None] | None
) -> xr.Dataset:
    """Return a sweep out of its file, which is written if it is not there.

    The blocks are kept in a Zarr store beside it until all are there, so that this goes on where it
    was interrupted, too; the file is then written from it block by block, and put into its place.
    Two runs share that store: who is later opens the file of who was first.
    """
    identity = sha256(job.identity.encode()).hexdigest()
    if file.exists():
        return _opened(file, identity)
    place = place_of_blocks(file)
    try:
        keep_blocks(job, place, scheduler, tell)
        _write(file, place, identity, {name: each.chunks for name, each in job.arrays.items()})
    except (OptipathError, *_FAULTS):
        # Another run that was faster has put the file there, and removed the store.
        if not file.exists():
            raise
    found = _opened(file, identity)
    _remove(place)
    return found


def _remove(store: Path) -> None:
    """Remove a store at once, so that nobody goes on with half of it."""
    moved = store.with_name(f".{secrets.token_hex(8)}.draft")
    with suppress(OSError):
        store.rename(moved)
        shutil.rmtree(moved, ignore_errors=True)


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
        found = xr.open_dataset(file, engine="h5netcdf", chunks={})
    except _FAULTS:
        raise ParameterError(_TAKEN.format(file, "is no NetCDF file, or a damaged one")) from None
    if found.attrs.pop(_IDENTITY, None) != identity:
        found.close()
        raise ParameterError(_TAKEN.format(file, "holds something else"))
    return found
