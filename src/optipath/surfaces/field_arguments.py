"""Arguments of height fields, files of measured heights, resolution of meshes."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import Cure, Fault, MeshWarning, SurfaceError, did_you_mean, needing, shown
from optipath.values.angles import calls_up
from optipath.values.arrays import as_argument
from optipath.values.files import bytes_of, input_file
from optipath.values.precision import Array, as_doubles, is_whole, real_number

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike
    from pathlib import Path

    from optipath.paths.files.schema import Faults


Pair = tuple[float, float]

_FARTHEST = 1e30
"""The largest length, and one over the least, whose ratios to others still have squares."""


def pair_of(what: str, value: Any, faults: list[str]) -> Pair:
    """Return positive numbers for x and for y, of one number or of a pair.

    >>> pair_of("size", 400, [])
    (400.0, 400.0)
    """
    both = _both(value)
    if len(both) == 2 and all((real_number(each) or 0.0) > 0.0 for each in both):
        if not all(1.0 / _FARTHEST <= each <= _FARTHEST for each in both):
            limits = f"{1.0 / _FARTHEST:g} .. {_FARTHEST:g}"
            faults.append(f"{what} is {shown(value)}; give it in a unit of which it is {limits}")
            return 1.0, 1.0
        return float(both[0]), float(both[1])
    faults.append(f"{what} must be a positive number, or two for x and y, not {shown(value)}")
    return 1.0, 1.0


def cells_of(cells: Any, faults: list[str]) -> tuple[int, int]:
    """Return how many cells there are along x and y, of one number or of a pair.

    >>> cells_of((640, 320), [])
    (640, 320)
    """
    numbers = _both(cells)
    if len(numbers) == 2 and all(is_whole(number, 2) for number in numbers):
        return int(numbers[0]), int(numbers[1])
    faults.append(f"cells must be a whole number from 2, or two for x and y, not {shown(cells)}")
    return 2, 2


def heights_of(heights: Any, faults: Faults, *, periodic: bool) -> Array:
    """Return heights as a read-only copy in float64. Shape: heights (rows, columns)."""
    least = 2 if periodic else 3
    array = faults.attempt("", as_argument, "the array of heights", heights, SurfaceError)
    if array is None:
        return np.zeros((least, least))
    if array.dtype.kind not in "iuf" or array.ndim != 2 or min(array.shape) < least:
        faults.append(
            f"heights are an array of {array.dtype} of shape {array.shape}; give real numbers, "
            f"rows along y and columns along x, {least} x {least} or more"
        )
        return np.zeros((least, least))
    stored = np.array(as_doubles(array), order="C")
    if (bad := np.argwhere(~np.isfinite(stored))).size:
        row, column = map(int, bad[0])
        faults.append(
            f"{len(bad)} of {stored.size} heights are not finite, the first "
            f"{stored[row, column]} at heights[{row}, {column}]; cut these out, or fill them with "
            f"heights around them"
        )
    elif (highest := np.abs(stored).max()) > _FARTHEST:
        faults.append(f"heights reach {highest:.3g}; give them in a unit of at most {_FARTHEST:g}")
    stored.setflags(write=False)
    return stored


def _both(value: Any) -> tuple[Any, ...]:
    """Return the entries of a pair, or a number twice."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        return tuple(value)
    return value, value


FEWEST_LENGTHS = 10
"""How many correlation lengths a period needs, to have enough different waves."""

CONVERGED = 16
"""How many cells a correlation length needs where light is scattered several times."""

_SMOOTH = 0.3
_OF_SMOOTH = 5
"""The largest alpha at which little light is scattered twice, and how many cells do there."""


def correlation_lengths(alpha: Pair, size: Pair) -> Pair:
    """Return how many correlation lengths, 2 / alpha, a surface of random waves has.

    >>> correlation_lengths((1.0, 0.5), (80.0, 80.0))
    (40.0, 20.0)
    """
    return size[0] * alpha[0] / 2.0, size[1] * alpha[1] / 2.0


def period_faults(alpha: Pair, size: Pair) -> list[str]:
    """Return the sentences for periods too short for random waves; none for long ones.

    >>> period_faults((0.1, 0.1), (400.0, 400.0))
    []
    """
    lengths = correlation_lengths(alpha, size)
    # A size of 20 / alpha may be less by a rounding.
    if min(lengths) * (1.0 + 1e-12) >= FEWEST_LENGTHS:
        return []
    enough = tuple(math.ceil(2.0 * FEWEST_LENGTHS / each) for each in alpha)
    why = (
        f"a periodic surface of {size[0]:.6g} x {size[1]:.6g} and alpha {alpha} has "
        f"{lengths[0]:.3g} x {lengths[1]:.3g} correlation lengths 2/alpha, too few for its waves, "
        f"of which it needs {FEWEST_LENGTHS} x {FEWEST_LENGTHS}; write size={enough} or more, or "
        f"periodic=False"
    )
    return [why]


def converged_cells(alpha: Pair, size: Pair, each: int = CONVERGED) -> tuple[int, int]:
    """Return how many cells are enough for light of any number of events, or for so many a length.

    >>> converged_cells((1.0, 0.5), (80.0, 80.0))
    (640, 320)
    """
    # The rounding of a product is no cell more.
    along_x, along_y = (
        max(2, math.ceil(each * length * (1.0 - 1e-12)))
        for length in correlation_lengths(alpha, size)
    )
    return along_x, along_y


def warn_of_coarse(alpha: Pair, size: Pair, cells: tuple[int, int]) -> None:
    """Warn of a mesh that is too coarse for its roughness."""
    needed = CONVERGED if max(alpha) > _SMOOTH else _OF_SMOOTH
    enough = converged_cells(alpha, size, needed)
    if all(have >= need for have, need in zip(cells, enough, strict=True)):
        return
    lengths = correlation_lengths(alpha, size)
    had = min(have / length for have, length in zip(cells, lengths, strict=True))
    why = (
        f"a mesh of {cells[0]} x {cells[1]} cells has {had:.4g} a correlation length 2/alpha, and "
        f"needs {needed} at alpha {max(alpha):.4g}: slopes are lost, and light of several events"
    )
    ways = f"cells={enough}", f"--cells {','.join(map(str, enough))}"
    cure = Cure.of("{} are enough".format, *ways)
    warnings.warn(Fault(why, cure), MeshWarning, stacklevel=calls_up())


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
