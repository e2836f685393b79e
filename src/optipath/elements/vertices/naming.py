"""Which chain of a batch, in words; and how many there are in a piece that stays in the cache."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

_AT_ONCE = 1 << 11
"""How many chains are looked at together, so that they stay in the cache."""


def of_chain(chain: int, batch: tuple[int, ...]) -> str:
    """Return which chain of a batch is meant, ready to be put behind what is in it.

    Examples
    --------
    >>> of_chain(0, ()), of_chain(7, (10,)), of_chain(7, (2, 5))
    ('', ' of chain 7', ' of chain (1, 2)')
    """
    if not batch:
        return ""
    found = tuple(int(place) for place in np.unravel_index(chain, batch))
    return f" of chain {found if len(found) > 1 else found[0]}"


def pieces_of(count: int) -> Iterator[slice]:
    """Yield slices of so many chains.

    Examples
    --------
    >>> list(pieces_of(3000))
    [slice(0, 2048, None), slice(2048, 3000, None)]
    """
    for start in range(0, count, _AT_ONCE):
        yield slice(start, min(start + _AT_ONCE, count))
