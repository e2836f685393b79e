"""Batches of any shape in pieces that follow each other in memory."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator


class Piece(NamedTuple):
    """A part of a batch."""

    where: tuple[int | slice, ...]
    start: int
    stop: int


def pieces(batch: tuple[int, ...], size: int) -> Iterator[Piece]:
    """Yield the parts of a batch in order, each of a size at most.

    Examples
    --------
    >>> [piece.where for piece in pieces((2, 3), 4)]
    [(slice(0, 1, None),), (slice(1, 2, None),)]
    """
    if 0 < prod(batch) <= size:
        yield Piece((slice(0, batch[0]),) if batch else (), 0, prod(batch))
        return
    axis = 0
    while axis < len(batch) - 1 and prod(batch[axis + 1 :]) > size:
        axis += 1
    inner = prod(batch[axis + 1 :])
    step = max(1, size // max(inner, 1))
    start = 0
    for outer in np.ndindex(batch[:axis]):
        for begin in range(0, batch[axis], step):
            end = min(begin + step, batch[axis])
            stop = start + (end - begin) * inner
            yield Piece((*outer, slice(begin, end)), start, stop)
            start = stop
