"""Files of measured heights."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import SurfaceError, did_you_mean, needing
from optipath.values.files import bytes_of, input_file

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike
    from pathlib import Path

    from optipath.values.precision import Array


_LARGEST = 256 * 1024 * 1024
"""How many bytes a file of heights may have."""


def read_heights(path: str | PathLike[str]) -> Array:
    """Read the heights of a file, row by row."""
    file = input_file(path, SurfaceError)
    ending = file.suffix.lower()
    if ending not in _READERS:
        raise SurfaceError(
            f"a file of heights cannot end in '{file.suffix}'{did_you_mean(ending, _READERS)}",
            about=str(file),
        )
    if file.is_fifo() and _READERS[ending] is not _text:
        raise SurfaceError("is a pipe; give a file", about=str(file))
    try:
        return _READERS[ending](file)
    except OSError as fault:
        why = fault.strerror or "it is damaged"
        raise SurfaceError(f"cannot be read: {why}", about=str(file)) from None
    except (ValueError, EOFError, MemoryError) as fault:
        raise SurfaceError(
            f"is no table of heights: {' '.join(str(fault).split())}", about=str(file)
        ) from None


def _text(file: Path) -> Array:
    """Read numbers separated by blanks or commas, with ``#`` before remarks."""
    lines = bytes_of(file, _LARGEST).decode("utf-8-sig").splitlines()
    first = next(filter(None, (line.partition("#")[0].strip() for line in lines)), "")
    if not first:
        raise ValueError("it holds no numbers")
    return np.loadtxt(lines, delimiter="," if "," in first else None, ndmin=2)


def _array(file: Path) -> Array:
    """Read an array of NumPy's, which cannot hold anything that would be run."""
    with file.open("rb") as stream:
        return np.lib.format.read_array(stream, allow_pickle=False)


def _picture(file: Path) -> Array:
    """Read a picture, which must be alone in its file."""
    with needing("pictures of heights"):
        import tifffile  # noqa: PLC0415 - an extra
    try:
        with tifffile.TiffFile(file) as picture:
            (only,) = picture.series
            is_palette = only.keyframe.photometric == tifffile.PHOTOMETRIC.PALETTE
            heights = np.asarray(only.asarray())
    except OSError:
        raise
    except Exception as fault:  # noqa: BLE001 - damaged files make tifffile raise anything
        raise ValueError(
            f"{fault}; save one picture, whole and without compression, or give its numbers to "
            f"HeightField.from_heights"
        ) from None
    if is_palette:
        raise ValueError("it has numbers of colours in a palette; save heights as grey values")
    return heights


_READERS: dict[str, Callable[[Path], Array]] = {
    **dict.fromkeys((".txt", ".csv", ".dat", ".asc"), _text),
    ".npy": _array,
    **dict.fromkeys((".tif", ".tiff"), _picture),
}
