"""What a large job says of itself, so that it can be cut into blocks that are kept."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt


class KeptArray(NamedTuple):
    """An array that blocks fill, part by part."""

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


class BlockPart(Protocol):
    """What a worker is sent of a job for one block."""

    def compute(self, number: int) -> Mapping[str, tuple[tuple[slice, ...], npt.NDArray[Any]]]:
        """Compute one block."""


class BlockJob(BlockPart, Protocol):
    """A large job, cut into blocks that are computed each by itself, in any order.

    It is pickled to workers, so its fields are plain data; it stays as it is while it runs. One
    that is large has a method ``part(number)`` besides, which returns the `BlockPart` that is sent
    in its place.
    """

    @property
    def identity(self) -> str:
        """All of what is computed: two jobs with one text come to the same bits."""

    @property
    def blocks(self) -> int:
        """How many there are."""

    @property
    def arrays(self) -> Mapping[str, KeptArray]:
        """What is kept, by name."""

    @property
    def coords(self) -> Mapping[str, WholeArray]:
        """What is known before, by name: the coordinates of the arrays."""

    @property
    def attrs(self) -> Mapping[str, Any]:
        """What the whole is, as JSON can hold it."""
