"""Jobs of blocks: what is computed block by block, and where it is kept."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy.typing as npt


class StoredArray(NamedTuple):
    """An array that blocks fill, part by part; each chunk belongs to one block."""

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    chunks: tuple[int, ...]
    dtype: str = "float64"
    attrs: Mapping[str, Any] = {}


class WholeArray(NamedTuple):
    """A small array that is written when the store is made, such as a coordinate."""

    dims: tuple[str, ...]
    values: npt.NDArray[Any]
    attrs: Mapping[str, Any] = {}


class BlockJob(Protocol):
    """A large job, cut into blocks that are computed each by itself, in any order."""

    @property
    def identity(self) -> str:
        """All of what is computed, a line each: two jobs with one text come to the same bits."""

    @property
    def blocks(self) -> int:
        """How many there are."""

    @property
    def arrays(self) -> Mapping[str, StoredArray]:
        """What is kept, by name."""

    @property
    def coords(self) -> Mapping[str, WholeArray]:
        """What is known before, by name: the coordinates of the arrays."""

    @property
    def attrs(self) -> Mapping[str, Any]:
        """What the whole is, as JSON can hold it."""

    def places(self, number: int) -> Mapping[str, tuple[slice, ...]]:
        """Return which part of each array a block is."""

    def task(self, number: int) -> Callable[[], Mapping[str, npt.NDArray[Any]]]:
        """Return what computes the values of a block; it is pickled to workers."""


def place_of_blocks(store: str) -> str:
    """Return where the blocks of a sweep are until all are there.

    >>> place_of_blocks("sweep.zarr"), place_of_blocks("sweep.nc")
    ('sweep.zarr', '.sweep.nc.blocks')
    """
    if not store.endswith(".nc"):
        return store
    file = Path(store)
    return str(file.with_name(f".{file.name}.blocks"))
