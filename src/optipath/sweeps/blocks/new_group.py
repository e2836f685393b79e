"""The Zarr group of a store, as it is before the first block is done."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import zarr

from optipath.sweeps.blocks.block_job import KeptArray
from optipath.sweeps.blocks.block_marks import mark_of, stamp_of
from optipath.sweeps.blocks.job_record import FILES, group_attrs

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.sweeps.blocks.block_job import BlockJob, WholeArray

# Version 2 of the format has words of a fixed length, and all metadata at one place, in its
# specification; zarr and xarray warn that version 3 has neither.
_VERSION: Literal[2] = 2
_DIMENSIONS = "_ARRAY_DIMENSIONS"


def make_group(job: BlockJob, record: dict[str, Any], about: str, folder: Path) -> None:
    """Write a group with the arrays of a job, its coordinates and its record."""
    folder.mkdir()
    group = zarr.create_group(str(folder), zarr_format=_VERSION, attributes=group_attrs(job))
    for name, kept in job.arrays.items():
        _create(group, name, kept)
    for name, whole in job.coords.items():
        _write(group, name, whole)
    zarr.consolidate_metadata(str(folder), zarr_format=_VERSION)
    group.create_group("blocks", attributes=record)
    (folder / "blocks" / "done").mkdir()
    stamps = {
        file.relative_to(folder).as_posix(): stamp_of(file.read_bytes())
        for file in sorted(folder.rglob("*"))
        if file.is_file()
    }
    (folder / FILES).write_bytes(mark_of(about, stamps))


def _create(group: zarr.Group, name: str, kept: KeptArray) -> zarr.Array[Any]:
    dtype = np.dtype(kept.dtype)
    return group.create_array(
        name,
        shape=kept.shape,
        chunks=kept.chunks,
        dtype=dtype,
        # xarray takes a fill value for one that is missing, which a number must not be.
        fill_value=np.nan if dtype.kind in "fc" else None,
        config={"write_empty_chunks": True},
        attributes={**kept.attrs, _DIMENSIONS: list(kept.dims)},
    )


def _write(group: zarr.Group, name: str, whole: WholeArray) -> None:
    shape = whole.values.shape
    chunks = tuple(max(size, 1) for size in shape)
    kept = KeptArray(whole.dims, shape, chunks, whole.values.dtype.str, whole.attrs)
    _create(group, name, kept)[...] = whole.values
