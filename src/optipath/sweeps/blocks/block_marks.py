"""The mark of a finished block: which part of each array it has filled."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.blocks.block_job import KeptArray

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_TYPE = np.dtype("<i8")


def marks_of(arrays: Mapping[str, KeptArray], blocks: int) -> KeptArray:
    """Return the array of all marks, a row and a chunk for each block.

    A row is 1 and then, for each array and dimension, where the part of the block begins and ends.

    Parameters
    ----------
    arrays : mapping of str to KeptArray
        What the job keeps.
    blocks : int
        How many there are.

    Returns
    -------
    KeptArray
    """
    length = 1 + 2 * sum(len(each.shape) for each in arrays.values())
    return KeptArray(("block", "bound"), (blocks, length), (1, length), _TYPE.str)


def name_of_mark(number: int) -> str:
    """Return the name of the file of a mark."""
    return f"{number}.0"


def mark_of(arrays: Mapping[str, KeptArray], found: Mapping[str, Any]) -> bytes:
    """Return the mark of a block.

    Parameters
    ----------
    arrays : mapping of str to KeptArray
        What the job keeps.
    found : mapping of str to (tuple of slice, ndarray)
        What the block gave.

    Returns
    -------
    bytes
        The content of its file.
    """
    regions = [found[name][0] for name in arrays]
    bounds = [end for region in regions for each in region for end in (each.start, each.stop)]
    return np.array([1, *bounds], _TYPE).tobytes()


def files_of_mark(arrays: Mapping[str, KeptArray], mark: bytes) -> Iterator[tuple[str, str]]:
    """Yield what a block has written.

    Parameters
    ----------
    arrays : mapping of str to KeptArray
        What the job keeps.
    mark : bytes
        Of the block.

    Yields
    ------
    tuple of (str, str)
        The name of an array, and that of the file of one of its chunks.

    Examples
    --------
    >>> arrays = {"S0": KeptArray(("delta", "rho"), (6, 4), (2, 4))}
    >>> mark = mark_of(arrays, {"S0": ((slice(2, 6), slice(0, 4)), None)})
    >>> list(files_of_mark(arrays, mark))
    [('S0', '1.0'), ('S0', '2.0')]
    """
    bounds = iter(np.frombuffer(mark, _TYPE)[1:].tolist())
    for name, kept in arrays.items():
        places = [
            range(next(bounds) // chunk, -(-min(next(bounds), size) // chunk))
            for size, chunk in zip(kept.shape, kept.chunks, strict=True)
        ]
        for place in product(*places):
            yield name, ".".join(map(str, place)) or "0"
