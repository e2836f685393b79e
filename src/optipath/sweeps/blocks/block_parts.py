"""The parts of arrays that a block fills: whole chunks, each the content of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import zarr
from zarr.core.buffer import default_buffer_prototype
from zarr.storage import MemoryStore

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt
    from zarr.core.buffer import Buffer

_METADATA = ".zarray"


def chunk_files(
    metadata: bytes, region: tuple[slice, ...], values: npt.NDArray[Any]
) -> Iterator[tuple[str, bytes]]:
    """Yield the files of some whole chunks of an array, by Zarr's own codecs.

    Zarr itself may leave half of a file where it is interrupted.
    """
    buffer = default_buffer_prototype().buffer
    like = zarr.open_array(
        MemoryStore({_METADATA: buffer.from_bytes(metadata)}), zarr_format=2, mode="r"
    )
    held: dict[str, Buffer] = {}
    array = zarr.create_array(
        MemoryStore(held),
        shape=like.shape,
        chunks=like.chunks,
        dtype=like.dtype,
        fill_value=like.fill_value,
        compressors=like.compressors,
        filters=like.filters,
        zarr_format=2,
        # Where a file is missing, it is lost. An array that is opened would leave this unheeded.
        config={"write_empty_chunks": True},
    )
    array[region] = values
    for name, content in held.items():
        if not name.startswith(".z"):
            yield name, content.to_bytes()
