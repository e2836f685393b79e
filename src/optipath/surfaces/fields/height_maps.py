"""Files of measured heights: plain text, NumPy's arrays, and TIFF."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError, did_you_mean, shown
from optipath.extras import needing
from optipath.values.arrays.memory import enough_for
from optipath.values.given_files import bytes_of, given_file

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from os import PathLike
    from pathlib import Path

Array = np.ndarray[Any, Any]

_CURE = "cut out a part of it"
_LARGEST = 256 * 1024 * 1024


def read_heights(path: str | PathLike[str]) -> Array:
    """Read the heights of a file, row by row."""
    file = given_file(path, SurfaceError)
    ending = file.suffix.lower()
    if ending not in _READERS:
        raise SurfaceError(
            f"a file of heights cannot end in '{file.suffix}'{did_you_mean(ending, _READERS)}",
            about=str(file),
        )
    if file.exists() and not (file.is_file() or file.is_dir()):  # A pipe would be waited for.
        raise SurfaceError("cannot be read: it is no file", about=str(file))
    try:
        return _READERS[ending](file)
    except SurfaceError as fault:
        raise SurfaceError(*fault.faults, about=str(file)) from None
    except OSError as fault:
        why = fault.strerror or "it is damaged"
        raise SurfaceError(f"cannot be read: {why}", about=str(file)) from None
    except MemoryError:
        raise SurfaceError(f"is larger than the memory; {_CURE}", about=str(file)) from None


def _text(file: Path) -> Array:
    """Read numbers separated by blanks or commas."""
    try:
        lines = enumerate(bytes_of(file, _LARGEST).decode("utf-8-sig").splitlines(), 1)
    except UnicodeDecodeError:
        raise SurfaceError("is no text in UTF-8; save it as UTF-8") from None
    rows = [(number, row) for number, line in lines if (row := line.partition("#")[0].strip())]
    if not rows:
        raise SurfaceError("holds no numbers; write a line of heights for each row")
    comma = "," if "," in rows[0][1] else None
    try:
        return np.loadtxt([row for _, row in rows], delimiter=comma, ndmin=2, comments=None)
    except ValueError:
        raise SurfaceError(
            f"is no table of numbers: {_first_fault(rows, comma)}; write as many numbers in each "
            f"line, separated by blanks or commas, with decimal points, and '#' before remarks"
        ) from None


def _first_fault(rows: list[tuple[int, str]], separator: str | None) -> str:
    """Return what is wrong with the first line that is no row of numbers."""
    first, among = rows[0]
    for line, row in rows:
        cells = row.split(separator)
        if (wanted := len(among.split(separator))) != len(cells):
            return f"line {line} has {len(cells)} numbers, and line {first} has {wanted}"
        for cell in cells:
            try:
                float(cell)
            except ValueError:
                return f"{shown(cell.strip())} in line {line} is no number"
    return "it has numbers that are written in an unusual way"


def _array(file: Path) -> Array:
    """Read an array of NumPy's, which cannot hold anything that would be run."""
    try:
        with file.open("rb") as stream:
            return np.lib.format.read_array(stream, allow_pickle=False)
    except (ValueError, EOFError) as fault:
        raise SurfaceError(
            f"is no array of numbers: {_one_line(fault)}; write it by numpy.save"
        ) from None


def _picture(file: Path) -> Array:
    """Read a picture, which must be alone in its file."""
    with needing("pictures of heights"):
        import tifffile  # noqa: PLC0415 - an extra
    try:
        with warnings.catch_warnings(), tifffile.TiffFile(file) as picture:
            warnings.simplefilter("ignore")
            only = _alone(picture.series)
            with enough_for(only.shape, only.dtype.itemsize, _CURE, SurfaceError, _HEIGHTS):
                return np.asarray(only.asarray())
    except (OSError, MemoryError, SurfaceError):
        raise
    except Exception as fault:  # noqa: BLE001 - damaged files make tifffile raise anything
        raise SurfaceError(
            f"is no TIFF that can be read: {_one_line(fault)}; {_cure_of(fault)}, or give its "
            f"numbers to HeightField.from_heights"
        ) from None


def _alone(pictures: Sequence[Any]) -> Any:
    if len(pictures) != 1:
        raise SurfaceError(
            f"has {len(pictures) or 'no'} pictures; save that of the heights alone, or give its "
            f"numbers to HeightField.from_heights"
        )
    if pictures[0].keyframe.photometric == _PALETTE:
        raise SurfaceError(
            "has numbers of colours in a palette, which are no heights; save heights as grey values"
        )
    return pictures[0]


def _cure_of(fault: Exception) -> str:
    """Return what may be wrong with a picture: its compression, or that it is not whole."""
    packed = "compression" in str(fault).lower() or "imagecodecs" in str(fault).lower()
    return "save it without compression" if packed else "it may be cut short, so save it again"


def _one_line(fault: Exception) -> str:
    return " ".join(str(fault).split()).rstrip(".;") or type(fault).__name__


_PALETTE = 3  # As the specification of TIFF has it.
_HEIGHTS = "picture of {:.3g} heights"
_READERS: dict[str, Callable[[Path], Array]] = {
    **dict.fromkeys((".txt", ".csv", ".dat", ".asc"), _text),
    ".npy": _array,
    **dict.fromkeys((".tif", ".tiff"), _picture),
}
