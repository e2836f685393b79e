"""The parts of arrays that a block fills: whole chunks, each the content of a file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import zarr
from zarr.core.buffer import default_buffer_prototype
from zarr.storage import MemoryStore

from optipath.errors import JobError, shown
from optipath.values.whole_numbers import is_whole

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt
    from zarr.core.buffer import Buffer

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
    if not isinstance(found, Mapping):
        raise JobError(
            f"block {number} gives {shown(found)}; return what is in each array by its name, "
            f"{{name: (region, values)}}"
        )
    faults = [f"gives no array '{name}'" for name in arrays if name not in found]
    faults += [f"gives {shown(name)}, which is not kept" for name in found if name not in arrays]
    for name in arrays.keys() & found.keys():
        fault = _form(found[name]) or _fault(arrays[name], *found[name])
        faults += [f"gives '{name}' {fault}"] if fault else []
    if faults:
        raise JobError(*(f"block {number} {fault}" for fault in sorted(faults)))


def _form(part: Any) -> str:
    """Say what is wrong where this is no part at all."""
    if not isinstance(part, tuple) or len(part) != 2 or not isinstance(part[1], np.ndarray):
        return f"as {shown(part)}; give (region, values), a tuple of slices and an array"
    region = part[0]
    is_plain = isinstance(region, tuple) and all(
        isinstance(each, slice)
        and each.step in (None, 1)
        and is_whole(each.start, 0)
        and is_whole(each.stop, 0)
        for each in region
    )
    return "" if is_plain else f"for {shown(region)}; give a tuple of slices, slice(begin, end)"


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
