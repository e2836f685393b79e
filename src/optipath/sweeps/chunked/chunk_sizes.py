"""Where a sweep is cut into blocks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from optipath.errors import ParameterError, shown, unknown
from optipath.values.whole_numbers import is_whole

BLOCK = 1 << 20
"""About how many points a block has that nobody has chosen a size for."""


def chunk_sizes(chunks: Any, sizes: Mapping[str, int], detectors: int = 1) -> dict[str, int]:
    """Return how many values a block has along each dimension.

    Examples
    --------
    >>> chunk_sizes("auto", {"delta": 1000, "rho": 1000, "phi": 100})
    {'delta': 10, 'rho': 1000, 'phi': 100}
    >>> chunk_sizes({"delta": 250, "phi": -1}, {"delta": 1000, "rho": 1000, "phi": 100})
    {'delta': 250, 'rho': 40, 'phi': 100}
    """
    if not sizes:
        raise ParameterError(
            "chunks= and store= cut axes into blocks, and there is no axis; give several values "
            "for a parameter, or leave them out"
        )
    told = _told(chunks, sizes)
    found = {name: min(sizes[name], size) for name, size in told.items()}
    room = BLOCK // detectors
    for size in found.values():
        room //= size
    for name in reversed([*sizes]):
        if name not in found:
            found[name] = _even(sizes[name], max(1, min(room, sizes[name])))
            room //= found[name]
    return {name: found[name] for name in sizes}


def _told(chunks: Any, sizes: Mapping[str, int]) -> dict[str, int]:
    """Return the sizes that somebody has chosen."""
    if _auto(chunks):
        return {}
    forms = (
        f"give 'auto', a number of values along each dimension, or {{'{next(iter(sizes))}': 10}}"
    )
    if isinstance(chunks, Mapping):
        faults = [fault for name in chunks for fault in unknown("dimension", name, sizes)]
        given = {name: size for name, size in chunks.items() if name in sizes and not _auto(size)}
        wrong = [(f"chunks of '{name}'", size) for name, size in given.items()]
    else:
        faults, given, wrong = [], dict.fromkeys(sizes, chunks), [("chunks", chunks)]
    faults += [
        f"{what} cannot be {shown(size)}: {forms}; -1 keeps a dimension whole"
        for what, size in wrong
        if not (is_whole(size) or is_whole(size, -1, -1))
    ]
    if faults:
        raise ParameterError(*faults)
    return {name: sizes[name] if size == -1 else int(size) for name, size in given.items()}


def _auto(size: Any) -> bool:
    return isinstance(size, str) and size == "auto"


def _even(count: int, most: int) -> int:
    """Return the size of as few and as equal parts as there can be."""
    parts = -(-count // most)
    return -(-count // parts)
