"""Arguments of height fields, files of measured heights, resolution of meshes."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import Cure, Fault, MeshWarning, SurfaceError, did_you_mean, needing, shown
from optipath.values.affine import real_number
from optipath.values.angles import calls_up
from optipath.values.arrays import as_argument, enough_for
from optipath.values.files import bytes_of, input_file
from optipath.values.precision import Array, as_doubles, is_whole

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike
    from pathlib import Path


Pair = tuple[float, float]

FEWEST_LENGTHS = 10
"""How many correlation lengths a period needs, to have enough different waves."""


_FARTHEST = 1e30
"""The largest length, and one over the least, whose ratios to others still have squares."""


def length_faults(what: str, value: object, cure: str = "") -> list[str]:
    """Return the sentence for what is no positive number; none for one that is.

    >>> length_faults("alpha", -0.1), length_faults("alpha", 0.1)
    (['alpha must be a positive number, not -0.1'], [])
    """
    if (real_number(value) or 0.0) > 0.0:
        return []
    return [f"{what} must be a positive number{cure}, not {shown(value)}"]


def pair_of(what: str, value: Any, faults: list[str]) -> Pair:
    """Return positive numbers for x and for y, of one number or of a pair.

    >>> pair_of("size", 400, [])
    (400.0, 400.0)
    """
    both = _both(value)
    if len(both) == 2 and not any(length_faults(what, each) for each in both):
        if not all(1.0 / _FARTHEST <= each <= _FARTHEST for each in both):
            limits = f"{1.0 / _FARTHEST:g} .. {_FARTHEST:g}"
            faults.append(f"{what} is {shown(value)}; give it in a unit of which it is {limits}")
        return float(both[0]), float(both[1])
    faults.append(
        f"{what} must be a positive number, or two of them for x and y, not {shown(value)}"
    )
    return 1.0, 1.0


def period_or_not(periodic: object) -> list[str]:
    """Return the sentence for what says neither that a field is periodic nor that it is not."""
    if isinstance(periodic, (bool, np.bool_)):
        return []
    return [f"periodic must be True or False, not {shown(periodic)}"]


def cells_of(cells: Any, faults: list[str]) -> tuple[int, int]:
    """Return how many cells there are along x and y, of one number or of a pair.

    >>> cells_of((640, 320), [])
    (640, 320)
    """
    numbers = _both(cells)
    if len(numbers) == 2 and all(is_whole(number, 2) for number in numbers):
        return int(numbers[0]), int(numbers[1])
    faults.append(
        f"cells must be a whole number of 2 or more, or two of them for x and y, not {shown(cells)}"
    )
    return 2, 2


def seed_of(seed: Any, faults: list[str]) -> np.random.SeedSequence:
    """Return the sequence of seeds that a number stands for, or one that is given.

    >>> seed_of(3, []).entropy
    3
    """
    if isinstance(seed, np.random.SeedSequence):
        return seed
    if is_whole(seed, 0):
        return np.random.SeedSequence(int(seed))
    faults.append(
        f"seed must be a whole number of 0 or more, or a numpy.random.SeedSequence, not "
        f"{shown(seed)}"
    )
    return np.random.SeedSequence(0)


def period_faults(alpha: Pair, size: Pair) -> list[str]:
    """Return the sentences for periods too short for random waves; none for long ones.

    >>> period_faults((0.1, 0.1), (400.0, 400.0))
    []
    """
    lengths = correlation_lengths(alpha, size)
    # A size of 20 / alpha may be less by a rounding.
    if min(lengths) * (1.0 + 1e-12) >= FEWEST_LENGTHS:
        return []
    enough = tuple(_rounded_up(min(2.0 * FEWEST_LENGTHS / each, 1e300)) for each in alpha)
    why = (
        f"a periodic surface of {size[0]:.6g} x {size[1]:.6g} and alpha {alpha} has "
        f"{lengths[0]:.3g} x {lengths[1]:.3g} correlation lengths 2/alpha, too few for its waves, "
        f"of which it needs {FEWEST_LENGTHS} x {FEWEST_LENGTHS}; write size={enough} or more, or "
        f"periodic=False"
    )
    return [why]


def heights_of(heights: Any, faults: list[str], *, periodic: bool) -> Array:
    """Return heights as a read-only copy in float64. Shape: heights (rows, columns)."""
    try:
        argument = as_argument("the array of heights", heights, SurfaceError)
    except SurfaceError as fault:
        faults += fault.faults
        return np.zeros((2, 2))
    if argument.dtype.kind not in "iuf":
        faults.append(f"heights must be real numbers, not an array of {argument.dtype}")
        return np.zeros((2, 2))
    if argument.ndim != 2:
        faults.append(
            f"heights must have two dimensions, rows along y and columns along x, not the shape "
            f"{argument.shape}"
        )
        return np.zeros((2, 2))
    stored = np.array(as_doubles(argument), order="C")
    least = 2 if periodic else 3
    if min(stored.shape) < least:
        faults.append(
            f"heights of shape {stored.shape} are too few; give {least} x {least} or more, for "
            f"2 x 2 cells"
        )
    if (bad := np.argwhere(~np.isfinite(stored))).size:
        row, column = map(int, bad[0])
        faults.append(
            f"{len(bad)} of {stored.size} heights {'is' if len(bad) == 1 else 'are'} not finite, "
            f"the first {stored[row, column]} at heights[{row}, {column}]; cut these out, or fill "
            f"them with heights around them"
        )
    elif (steepest := np.abs(stored).max(initial=0.0)) > _FARTHEST:
        faults.append(
            f"heights reach {steepest:.3g}; give them in a unit in which they are numbers "
            f"of {_FARTHEST:g} at most"
        )
    stored.setflags(write=False)
    return stored


def _rounded_up(number: float) -> float:
    """Return the next larger number of five digits."""
    step = 10.0 ** (math.floor(math.log10(number)) - 4)
    return float(f"{math.ceil(number / step) * step:.6g}")


def _both(value: Any) -> tuple[Any, ...]:
    """Return the entries of a pair, or a number twice."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        return tuple(value)
    return value, value


CONVERGED = 16
"""How many cells a correlation length needs where light is scattered several times."""

_SMOOTH = 0.3
_OF_SMOOTH = 5
"""The largest alpha at which little light is scattered twice, and how many cells do there."""


MISSING = {2: 0.12, 3: 0.066, 4: 0.047, 5: 0.031, 8: 0.013, 16: 0.002}
"""By cells a correlation length, the share of the light of several events that is not transmitted
(alpha 1, index 1.5, incidence 1 rad; docs/surfaces.md has the table)."""


def correlation_lengths(
    alpha: tuple[float, float], size: tuple[float, float]
) -> tuple[float, float]:
    """Return how many correlation lengths, 2 / alpha, a surface of random waves has.

    >>> correlation_lengths((1.0, 0.5), (80.0, 80.0))
    (40.0, 20.0)
    """
    return size[0] * alpha[0] / 2.0, size[1] * alpha[1] / 2.0


def converged_cells(alpha: tuple[float, float], size: tuple[float, float]) -> tuple[int, int]:
    """Return how many cells are enough for light of any number of events.

    >>> converged_cells((1.0, 0.5), (80.0, 80.0))
    (640, 320)
    """
    along_x, along_y = (_cells(CONVERGED, n) for n in correlation_lengths(alpha, size))
    return along_x, along_y


def warn_of_coarse(
    alpha: tuple[float, float], size: tuple[float, float], cells: tuple[int, int]
) -> None:
    """Warn of a mesh that is too coarse for its roughness."""
    needed = CONVERGED if max(alpha) > _SMOOTH else _OF_SMOOTH
    lengths = correlation_lengths(alpha, size)
    enough = tuple(_cells(needed, length) for length in lengths)
    if all(have >= need for have, need in zip(cells, enough, strict=True)):
        return
    had = min(have / length for have, length in zip(cells, lengths, strict=True))
    why = (
        f"a mesh of {cells[0]} x {cells[1]} cells has {had:.4g} a correlation length 2/alpha, and "
        f"needs {needed} at alpha {max(alpha):.4g}: slopes are lost, and {_missing(had)} of the "
        f"light that is transmitted after several events"
    )
    ways = f"cells={enough}", f"--cells {','.join(map(str, enough))}"
    cure = Cure.of("{} are enough".format, *ways)
    warnings.warn(Fault(why, cure), MeshWarning, stacklevel=calls_up())


def _cells(each: int, lengths: float) -> int:
    # The rounding of a product is no cell more; what no machine has memory for is told as such.
    return max(2, math.ceil(min(each * lengths * (1.0 - 1e-12), 1e18)))


def _missing(cells: float) -> str:
    """Return the share of light that is lost with so many cells a correlation length."""
    share = np.interp(math.log(cells), np.log([*MISSING]), [*MISSING.values()])
    return f"{'more than' if cells < min(MISSING) else 'about'} {100.0 * share:.2g} %"


_CURE = "cut out a part of it"
_LARGEST = 256 * 1024 * 1024


def read_heights(path: str | PathLike[str]) -> Array:
    """Read the heights of a file, row by row."""
    file = input_file(path, SurfaceError)
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
