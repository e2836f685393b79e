"""Tensor files: the arrays with names that Mitsuba 3 reads its measured materials from."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import IO, Any

    import numpy.typing as npt

_HEAD = b"tensor_file\0" + bytes([1, 0])
_CODES = {"uint8": 1, "uint16": 3, "float32": 10}
_ALIGNED = 8


class Tensor(NamedTuple):
    """An array of a tensor file, whose parts may be computed while it is written."""

    type: str
    shape: tuple[int, ...]
    parts: Iterable[npt.NDArray[Any]]

    @classmethod
    def of(cls, array: npt.NDArray[Any]) -> Tensor:
        """Return an array that is there as a whole."""
        return cls(str(array.dtype), array.shape, (array,))

    @property
    def size(self) -> int:
        """How many bytes it has."""
        return int(np.prod(self.shape)) * np.dtype(self.type).itemsize


def write_tensors(stream: IO[bytes], tensors: Mapping[str, Tensor]) -> None:
    """Write a tensor file, as ``mitsuba.python.tensor_io`` of Mitsuba 3.9 does.

    Little-endian: the word ``tensor_file``, the version 1.0, how many arrays; of each the length
    of its name (16 bits), its name, how many axes (16), its type (8), its place in the file (64)
    and its shape (64 each); then the arrays.

    Examples
    --------
    >>> from io import BytesIO
    >>> write_tensors(stream := BytesIO(), {"a": Tensor.of(np.array([1, 2], np.uint8))})
    >>> stream.getvalue()[:11], [*stream.getvalue()[-2:]]
    (b'tensor_file', [1, 2])
    """
    names = {name: name.encode() for name in tensors}
    heads = sum(2 + len(names[name]) + 11 + 8 * len(each.shape) for name, each in tensors.items())
    place = len(_HEAD) + 4 + heads
    stream.write(_HEAD + struct.pack("<I", len(tensors)))
    gaps = {}
    for name, each in tensors.items():
        gaps[name] = -place % _ALIGNED
        place += gaps[name]
        stream.write(struct.pack("<H", len(names[name])) + names[name])
        stream.write(struct.pack("<HBQ", len(each.shape), _CODES[each.type], place))
        stream.write(struct.pack(f"<{len(each.shape)}Q", *each.shape))
        place += each.size
    for name, each in tensors.items():
        stream.write(bytes(gaps[name]))
        for part in each.parts:
            stream.write(np.ascontiguousarray(part, np.dtype(each.type).newbyteorder("<")).data)
