"""Height fields: rough surfaces as heights over a plane, of which a mesh of triangles is made."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.extras import needing
from optipath.faults import did_you_mean
from optipath.materials.quantities import YES_OR_NO
from optipath.paths.files.schema import Faults
from optipath.surfaces.random_field import LARGEST, Pair, pair_of, random_field
from optipath.values.arrays import ComparedByFields, Unchanging, as_argument
from optipath.values.files import bytes_of, input_file
from optipath.values.precision import Array, as_doubles

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike
    from pathlib import Path

    from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False, repr=False)
class HeightField(Unchanging, ComparedByFields):
    """A rough surface: heights z over x and y, in cells of two flat triangles each.

    ``heights[i, j]`` is that at ``x = j dx``, ``y = i dy``; z points up. The diagonal of each
    cell goes from its corner (0, 0) to (1, 1), and a normal is that of a triangle. Heights and
    sizes are in one unit, whichever that is.

    Parameters
    ----------
    heights : array_like, shape (rows, columns)
        Kept as a read-only copy in float64.
    size : float or pair of float
        The lengths of the sides, along x and along y.
    periodic : bool, optional
        Whether the first row and column follow the last ones again. Then n vertices make n
        cells along an axis, else n - 1.
    alpha : pair of float, optional
        The roughness of a random field along x and y; None for others.

    Raises
    ------
    SurfaceError
        If heights are not finite, not of two dimensions or fewer than those of 2 x 2 cells, or
        if sizes are not positive; with all faults at once.

    Examples
    --------
    >>> field = HeightField.beckmann(0.25, size=160.0, cells=320, seed=1)
    >>> field
    HeightField.beckmann of alpha (0.25, 0.25), 320 x 320 cells, 160 x 160, periodic
    >>> [round(slope, 3) for slope in field.mean_square_slopes], 0.25**2 / 2
    ([0.031, 0.031], 0.03125)
    """

    heights: Array
    size: Pair
    periodic: bool = False
    alpha: Pair | None = None

    def __post_init__(self) -> None:
        faults = Faults()
        periodic = bool(faults.attempt("", YES_OR_NO.check, "periodic", self.periodic))
        heights = faults.attempt("", heights_of, self.heights, periodic=periodic)
        size = pair_of("size", self.size, faults)
        alpha = None if self.alpha is None else pair_of("alpha", self.alpha, faults)
        SurfaceError.raise_for(faults)
        vars(self).update(heights=heights, size=size, periodic=periodic, alpha=alpha)

    @classmethod
    def beckmann(
        cls,
        alpha: float,
        alpha_y: float | None = None,
        size: float | Pair = 400.0,
        cells: int | tuple[int, int] | None = None,
        waves: int = 1000,
        seed: int | np.random.SeedSequence = 0,
        *,
        periodic: bool = True,
    ) -> HeightField:
        """Draw a random surface whose slopes have Beckmann's distribution.

        Heights have variance 1 and slopes alpha^2 / 2 along an axis, with the density
        ``exp(-tan(theta)^2 / alpha^2) / (pi alpha^2)``, as E. Heitz has it, "Generating procedural
        Beckmann surfaces" (2015). A periodic surface has these variances over its period, each
        of them to rounding; one that is not has them up to what a part of a larger surface has by
        chance. On its mesh of 16 cells a correlation length, 2 / alpha, mean squares of slopes are
        0.2 % less.

        Parameters
        ----------
        alpha : float
            The roughness, along x.
        alpha_y : float, optional
            That along y; the same by default.
        size : float or pair of float, optional
            The lengths of the sides along x and y, 400 by default, in deviations of the heights.
        cells : int or pair of int, optional
            How many cells there are along x and y; by default 16 for each correlation length.
        waves : int, optional
            How many cosine waves are drawn, 1000 by default. Less than 10 have neither these
            variances nor this density.
        seed : int or SeedSequence, optional
            The same seed gives the same bits; 0 by default.
        periodic : bool, optional
            Whether the surface goes on after its last cells with its first, so that no light is
            lost at its border; it does by default. Wave vectors are rounded for it to whole numbers
            of waves, and some 560 different ones are left of 1000 on 40 correlation lengths.

        Returns
        -------
        HeightField

        Raises
        ------
        SurfaceError
            If one of these is not as said, if a period has less than 10 correlation lengths, or if
            the mesh is larger than the memory; with all faults at once.

        Warns
        -----
        MeshWarning
            If there are fewer cells than light of several events needs: 16 a correlation
            length, or 5 up to alpha 0.3.

        Examples
        --------
        >>> brushed = HeightField.beckmann(0.3, 0.1, size=(100.0, 300.0), seed=7)
        >>> brushed.cells, brushed.isotropic
        ((240, 240), False)
        """
        return cls(*random_field(alpha, alpha_y, size, cells, waves, seed, periodic=periodic))

    @classmethod
    def flat(cls) -> HeightField:
        """Return the flat surface, which goes on for ever.

        >>> HeightField.flat().is_flat
        True
        """
        return cls(np.zeros((2, 2)), (1.0, 1.0), periodic=True)

    @classmethod
    def from_heights(
        cls, heights: ArrayLike, size: float | Pair, *, periodic: bool = False
    ) -> HeightField:
        """Return the surface of heights that have been measured or computed.

        Parameters
        ----------
        heights : array_like, shape (rows, columns)
            Rows along y, columns along x.
        size : float or pair of float
            The lengths of the sides along x and y, in the unit of the heights. A map that is not
            periodic has its last vertices at the ends of these.
        periodic : bool, optional
            Whether the first row and column follow the last ones again; not by default, since
            heights that differ there would make a step.

        Returns
        -------
        HeightField

        Examples
        --------
        >>> HeightField.from_heights([[0.0, 0.1, 0.0]] * 3, size=2.0)
        HeightField of 2 x 2 cells, 2 x 2, not periodic
        """
        return cls(heights, size, periodic)  # type: ignore[arg-type]

    @classmethod
    def from_file(
        cls, path: str | PathLike[str], size: float | Pair, *, periodic: bool = False
    ) -> HeightField:
        """Return the surface of a file of heights, such as that of an atomic force microscope.

        Parameters
        ----------
        path : str or PathLike
            Plain text (``.txt``, ``.csv``, ``.dat`` or ``.asc``; a line for each row, numbers
            separated by blanks or commas, ``#`` before remarks), an array of NumPy's (``.npy``), or
            a picture (``.tif`` or ``.tiff``, extra: tiff).
        size : float or pair of float
            The lengths of the sides along x and y, in the unit of the heights; heights in another
            unit are scaled in Python and given to `from_heights`.
        periodic : bool, optional
            As `from_heights` takes it.

        Returns
        -------
        HeightField

        Raises
        ------
        SurfaceError
            If the file is not there or holds something else, or as the class does.
        MissingExtraError
            If it is a picture, and tifffile is not installed.
        """
        file = input_file(path, SurfaceError)
        try:
            return cls.from_heights(read_heights(file), size, periodic=periodic)
        except SurfaceError as fault:
            raise SurfaceError(*fault.faults, about=str(path)) from None

    @cached_property
    def is_flat(self) -> bool:
        """Whether all heights are the same."""
        return bool(np.all(self.heights == self.heights[0, 0]))

    @property
    def isotropic(self) -> bool:
        """Whether its statistics have no direction: a random field of one alpha, or a flat one."""
        return self.is_flat if self.alpha is None else self.alpha[0] == self.alpha[1]

    @property
    def cells(self) -> tuple[int, int]:
        """How many cells there are, along x and along y."""
        rows, columns = self.heights.shape
        open_end = not self.periodic
        return columns - open_end, rows - open_end

    @property
    def spacing(self) -> tuple[float, float]:
        """How far vertices are apart, along x and along y: dx and dy."""
        return self.size[0] / self.cells[0], self.size[1] / self.cells[1]

    @cached_property
    def deviation(self) -> float:
        """The standard deviation of the heights."""
        return float(np.std(self.heights))

    @cached_property
    def mean_square_slopes(self) -> tuple[float, float]:
        """The means over all triangles of the squares of slopes, along x and along y."""
        vertices = self.vertices()
        along_x, along_y = (
            (np.diff(vertices, axis=axis) / step) ** 2
            for axis, step in zip((1, 0), self.spacing, strict=True)
        )
        # An edge inside the mesh belongs to two triangles, one at a border to one.
        slopes_x = along_x[:-1].mean() + along_x[1:].mean()
        slopes_y = along_y[:, :-1].mean() + along_y[:, 1:].mean()
        return float(slopes_x) / 2.0, float(slopes_y) / 2.0

    def vertices(self) -> Array:
        """Return the heights (cells_y + 1, cells_x + 1) of all corners, a period's border twice.

        >>> HeightField.from_heights([[0.0, 1.0], [2.0, 3.0]], 2.0, periodic=True).vertices()
        array([[0., 1., 0.],
               [2., 3., 2.],
               [0., 1., 0.]])
        """
        return np.pad(self.heights, (0, 1), mode="wrap") if self.periodic else self.heights

    def __hash__(self) -> int:  # type: ignore[override]
        return hash((self.heights.shape, self.size, self.periodic, self.alpha))

    def __repr__(self) -> str:
        kind = "" if self.alpha is None else f".beckmann of alpha {self.alpha},"
        of = f"{'' if kind else ' of'} {self.cells[0]} x {self.cells[1]} cells"
        period = "periodic" if self.periodic else "not periodic"
        return f"HeightField{kind}{of}, {self.size[0]:.6g} x {self.size[1]:.6g}, {period}"


def heights_of(heights: Any, *, periodic: bool) -> Array:
    """Return heights as a read-only copy in float64. Shape: heights (rows, columns)."""
    least, array = 2 if periodic else 3, as_argument("the array of heights", heights, SurfaceError)
    if array.dtype.kind not in "iuf" or array.ndim != 2 or min(array.shape) < least:
        raise SurfaceError(
            f"heights are an array of {array.dtype} of shape {array.shape}; give real numbers, "
            f"rows along y and columns along x, {least} x {least} or more"
        )
    stored = np.array(as_doubles(array), order="C")
    if (bad := np.argwhere(~np.isfinite(stored))).size:
        row, column = map(int, bad[0])
        raise SurfaceError(
            f"{len(bad)} of {stored.size} heights are not finite, the first "
            f"{stored[row, column]} at heights[{row}, {column}]; cut these out, or fill them with "
            f"heights around them"
        )
    if (highest := np.abs(stored).max()) > LARGEST:
        raise SurfaceError(
            f"heights reach {highest:.3g}; give them in a unit of at most {LARGEST:g}"
        )
    stored.setflags(write=False)
    return stored


_MOST_BYTES = 256 * 1024 * 1024
"""How many bytes a file of heights may have."""


def read_heights(file: Path) -> Array:
    """Read the heights of a file, row by row."""
    ending = file.suffix.lower()
    if ending not in _READERS:
        near = did_you_mean(ending, _READERS)
        raise SurfaceError(f"a file of heights cannot end in '{file.suffix}'{near}")
    if file.is_fifo() and _READERS[ending] is not _text:
        raise SurfaceError("is a pipe; give a file")
    try:
        return _READERS[ending](file)
    except OSError as fault:
        raise SurfaceError(f"cannot be read: {fault.strerror or 'it is damaged'}") from None
    except (ValueError, EOFError, MemoryError) as fault:
        raise SurfaceError(f"is no table of heights: {' '.join(str(fault).split())}") from None


def _text(file: Path) -> Array:
    """Read numbers separated by blanks or commas, with ``#`` before remarks."""
    lines = bytes_of(file, _MOST_BYTES).decode("utf-8-sig").splitlines()
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
