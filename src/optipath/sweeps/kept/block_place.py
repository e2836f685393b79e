"""Where the blocks of a sweep are kept while they are computed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from os import PathLike


def place_of_blocks(store: str | PathLike[str]) -> Path:
    """Return where the blocks of a sweep are until all are there.

    Examples
    --------
    >>> place_of_blocks("sweep.zarr").name, place_of_blocks("sweep.nc").name
    ('sweep.zarr', '.sweep.nc.blocks')
    """
    place = Path(store)
    return place.with_name(f".{place.name}.blocks") if place.suffix == ".nc" else place
