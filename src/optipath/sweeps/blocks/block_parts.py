"""The parts of arrays that a block fills: whole chunks, each the content of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import zarr
from zarr.core.buffer import default_buffer_prototype
from zarr.storage import MemoryStore

from optipath.errors import JobError, shown

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import numpy.typing as npt

    from optipath.sweeps.blocks.block_job import KeptArray

_METADATA = ".zarray"


def check_parts(number: int, arrays: Mapping[str, KeptArray], found: Mapping[str, Any]) -> None:
    """Refuse what a block gave if it is not what its job says.

    Parameters
    ----------
    number : int
        Which block it is.
    arrays : mapping of str to KeptArray
        What the job keeps.
    found : mapping of str to (tuple of slice, ndarray)
        What the block gave.

    Raises
    ------
    JobError
        With all faults: a part is missing, of another shape or type, or no whole chunks, so that
        two blocks would write one file.
    """
    faults = [f"gives no array '{name}'" for name in arrays if name not in found]
    faults += [f"gives {shown(name)}, which is not kept" for name in found if name not in arrays]
    for name in arrays.keys() & found.keys():
        region, values = found[name]
        fault = _fault(arrays[name], region, values)
        faults += [f"gives '{name}' {fault}"] if fault else []
    if faults:
        raise JobError(*(f"block {number} {fault}" for fault in sorted(faults)))


def _fault(kept: KeptArray, region: tuple[slice, ...], values: npt.NDArray[Any]) -> str:
    bounds = [(each.start, each.stop) for each in region]
    fits = len(bounds) == len(kept.shape)
    sides = zip(bounds, kept.shape, kept.chunks, strict=True) if fits else ()
    whole = (
        0 <= start < stop <= size and not start % chunk and (stop == size or not stop % chunk)
        for (start, stop), size, chunk in sides
    )
    if not fits or not all(whole):
        return (
            f"for {bounds} of shape {kept.shape}, which is no whole chunks of {kept.chunks}; let "
            f"blocks begin and end where chunks do"
        )
    shape = tuple(stop - start for start, stop in bounds)
    if values.shape != shape or values.dtype != np.dtype(kept.dtype):
        return f"as {values.dtype} of shape {values.shape}, not {kept.dtype} of {shape}"
    return ""


def chunk_files(
    metadata: bytes, region: tuple[slice, ...], values: npt.NDArray[Any]
) -> Iterator[tuple[str, bytes]]:
    """Yield the files of some whole chunks of an array, by Zarr's own codecs.

    Zarr itself may leave half of a file where it is interrupted.

    Parameters
    ----------
    metadata : bytes
        That of the array, as it stands in its file ``.zarray``.
    region : tuple of slice
        What is written.
    values : ndarray
        What is in it.

    Yields
    ------
    tuple of (str, bytes)
        The name and the content of a file, for every chunk.
    """
    buffer = default_buffer_prototype().buffer
    held = {_METADATA: buffer.from_bytes(metadata)}
    array = zarr.open_array(
        # Where a file is missing, it is lost.
        MemoryStore(held),
        zarr_format=2,
        mode="r+",
        config={"write_empty_chunks": True},
    )
    array[region] = values
    for name, content in held.items():
        if name != _METADATA:
            yield name, content.to_bytes()
