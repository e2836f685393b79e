"""The forms of files that hold all of a hemisphere: Zarr and NetCDF."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from pathlib import Path
from typing import Any

import xarray as xr

from optipath.errors import SurfaceError
from optipath.surfaces.files.kept_hemisphere import MEASUREMENT
from optipath.values.written_files import drafted

_RECORD = ".zattrs"
"""The file of a Zarr group in which its attributes are."""


def write_netcdf(dataset: xr.Dataset, file: Path) -> None:
    """Write a Dataset as a file of NetCDF 4, compressed part by part."""
    packed: dict[str, Any] = {"zlib": True, "complevel": 4, "shuffle": True}
    encoding = {name: packed for name in dataset.data_vars if dataset[name].ndim > 1}
    encoding["sums"] = packed | {"chunksizes": _chunks(dataset)}
    with drafted(file) as draft:
        dataset.to_netcdf(draft, engine="h5netcdf", encoding=encoding)


def write_zarr(dataset: xr.Dataset, folder: Path) -> None:
    """Write a Dataset as a Zarr group, part by part, in place of a hemisphere that was there."""
    folder = Path(os.path.realpath(folder))
    if folder.exists() and not _is_hemisphere(folder):
        raise SurfaceError(
            f"'{folder}' is there already, and is no hemisphere; give another name, or move it away"
        )
    if not folder.parent.is_dir():  # Zarr would make one.
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
    name = f".{secrets.token_hex(8)}"
    draft, old = (folder.with_name(f"{name}.{kind}") for kind in ("draft", "old"))
    try:
        # Version 2, whose words of a fixed length and joint metadata are in its specification.
        encoding = {"sums": {"chunks": _chunks(dataset)}}
        dataset.to_zarr(draft, encoding=encoding, zarr_format=2, consolidated=True)
        if folder.exists():
            folder.rename(old)
        draft.rename(folder)
    finally:
        if old.exists() and not folder.exists():
            old.rename(folder)
        for left in (draft, old):
            shutil.rmtree(left, ignore_errors=True)


def read_dataset(place: Path) -> xr.Dataset:
    """Return all of what a file or folder holds."""
    is_netcdf = place.suffix == ".nc"
    engine: Any = {"engine": "h5netcdf"} if is_netcdf else {"engine": "zarr", "consolidated": True}
    with xr.open_dataset(place, chunks=None, **engine) as found:
        found.attrs[MEASUREMENT]  # Before any of its numbers is read.
        return found.load()


def _chunks(dataset: xr.Dataset) -> tuple[int, ...]:
    """Return the shape of the sums of one part."""
    return (1, *dataset["sums"].shape[1:])


def _is_hemisphere(folder: Path) -> bool:
    try:
        return f'"{MEASUREMENT}"' in (folder / _RECORD).read_text("utf-8")
    except (OSError, UnicodeDecodeError):
        return False
