"""Mueller: a 4x4 matrix between two reference frames, and the three parts that it has."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NoReturn, overload

import numpy as np

from optipath.errors import FrameError, LightError
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.array_axes import ArrayAxes, each_number
from optipath.light.exchange import MuellerExchange
from optipath.light.frames import Frame
from optipath.light.inherited_noise import inheriting
from optipath.light.light import Light
from optipath.light.mueller import cloude
from optipath.light.mueller.drawn_matrix import DrawnMatrix
from optipath.light.mueller.figures import MatrixFigures
from optipath.light.mueller.matrix_noise import noise_of_product
from optipath.light.mueller.measured_matrices import (
    check_becomes_light,
    nan_where_no_light,
)
from optipath.light.mueller.polar_decomposition import polar_parts
from optipath.light.mueller.reciprocity import HasReciprocal
from optipath.light.mueller.sphere_rotations import turn_of
from optipath.light.mueller.stacking import stacked
from optipath.light.refused_products import why_refused
from optipath.light.underflow import folded, normalise_exponent, rounded_to
from optipath.values.arrays.jax_values import check_known, is_jax, is_traced, known
from optipath.values.arrays.read_only import Unchanging, locked, read_only, same
from optipath.values.arrays.shapes import check_broadcast, real_array
from optipath.values.precision import at_least_single, coarser

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class Mueller(HasReciprocal, ArrayAxes, MatrixFigures, MuellerExchange, DrawnMatrix, Unchanging):
    """What an optical system does to light: a matrix, or a batch, between two frames.

    ``M2 @ M1`` lets light meet M1 first; ``M @ light`` attenuates. Both turn the numbers from the
    frame that light leaves in to the one it is expected in; their directions must agree.

    Parameters
    ----------
    matrix : array_like, shape (..., 4, 4)
        Acts on Stokes vectors. As measured, of any scale; what it makes of light must be light,
        though it be brighter, unless that is ``Light(..., physical=False)``.
    frame_in, frame_out : Frame, optional
        Those of the light that comes in and that goes out; unit frames by default.

    Raises
    ------
    ShapeError
        If the last two axes have not four elements.

    Examples
    --------
    >>> half = Mueller(np.diag([0.5, 0.5, 0.5, 0.5]))
    >>> half @ half @ Light([1.0, 0.0, 0.0, 0.0])
    Light([0.25, 0.  , 0.  , 0.  ])
    """

    __array_ufunc__ = None  # NumPy's arrays leave products to it.
    _kind, _several = "Mueller matrix", "Mueller matrices"
    _attribute, _axes = "matrix", 2
    _written, _entry = "mueller.matrix", "mueller.matrix[..., 0, 0]"

    matrix: Any
    frame_in: Frame = field(default_factory=Frame)
    frame_out: Frame = field(default_factory=Frame)

    def __post_init__(self) -> None:
        if not (isinstance(self.frame_in, Frame) and isinstance(self.frame_out, Frame)):
            raise FrameError("the frames of a Mueller matrix must be Frames; use Frame(x, y, z)")
        matrix = real_array("a Mueller matrix", self.matrix, (4, 4))
        kept = matrix if is_jax(matrix) else read_only(matrix, widened=False)
        vars(self).update(matrix=kept, _given=True)

    @classmethod
    def of(
        cls,
        matrix: Any,
        frame_in: Frame | Callable[[], Frame],
        frame_out: Frame | Callable[[], Frame],
    ) -> Mueller:
        """Return what has been computed as a Mueller matrix: the array becomes read-only.

        Parameters
        ----------
        matrix : ndarray, shape (..., 4, 4)
            Nobody else has it.
        frame_in, frame_out : Frame or callable
            Those of the light that comes in and that goes out, or what returns them when
            somebody asks.

        Returns
        -------
        Mueller
        """
        found = cls.__new__(cls)
        vars(found)["matrix"] = locked(matrix)
        found._keep_frames(frame_in=frame_in, frame_out=frame_out)  # noqa: SLF001 - its own
        return found

    @overload
    def __matmul__(self, other: Mueller) -> Mueller: ...
    @overload
    def __matmul__(self, other: Light) -> Light: ...
    def __matmul__(self, other: Mueller | Light) -> Mueller | Light:
        if isinstance(other, Light):
            return self._attenuated(other)
        if isinstance(other, Mueller):
            return self._behind(other)
        if hasattr(other, "dtype") or not hasattr(type(other), "__rmatmul__"):
            raise LightError(why_refused(other))
        return NotImplemented

    def _attenuated(self, light: Light) -> Light:
        matrix = known(self.matrix)
        check_broadcast({"matrix": self.shape, "light": light.shape})
        aligned = light.in_frame(self.frame_in)
        behind = self._kept_frame("frame_out")
        judged = self.is_given and not light.is_measured
        origin = light.origin()
        if is_traced(matrix) or is_traced(aligned.mantissa):
            stokes = at_least_single(aligned.stokes)
            product = (matrix @ stokes[..., np.newaxis])[..., 0]
            product = product.astype(coarser(matrix, stokes))
            if judged:
                product = nan_where_no_light(matrix, self.noise, stokes, product)
            return Light.of(product, behind, **origin)
        stokes, exponent = normalise_exponent(at_least_single(aligned.mantissa), aligned.exponent)
        with np.errstate(over="ignore", invalid="ignore"):
            product = (matrix @ stokes[..., np.newaxis])[..., 0]
        exponent = np.broadcast_to(exponent, product.shape[:-1])
        if judged:
            check_becomes_light(matrix, self.noise, stokes, product)
        noise = inheriting((aligned,), matrix[..., 0, 0], mixed=True, added=self.noise)
        product, exponent = folded(*rounded_to(coarser(matrix, stokes), product, exponent))
        return Light.of(product, behind, exponent, noise, **origin)

    def _behind(self, other: Mueller) -> Mueller:
        matrix, before = known(self.matrix), known(other.matrix)
        check_broadcast({"matrix": self.shape, "other matrix": other.shape})
        turn = stacked(ROTATION.rows(NUMPY, other.frame_out.turn_to(self.frame_in)))
        with np.errstate(over="ignore", invalid="ignore"):
            product = matrix @ turn @ before
        frames = other._kept_frame("frame_in"), self._kept_frame("frame_out")
        noise = noise_of_product(*((m.matrix, m.noise) for m in (self, other)))
        both = Mueller.of(product.astype(coarser(matrix, before), copy=False), *frames)
        return both.with_noise(noise, given=self.is_given or other.is_given)

    def __rmatmul__(self, other: object) -> NoReturn:
        """Refuse what has no frames."""
        raise LightError(why_refused(other))

    def _each(self, change: Callable[[Any], Any]) -> Mueller:
        numbers = known(self.matrix)
        flat = each_number(numbers.reshape(*self.shape, 16), change)
        frames = (
            self._part_of_frame(name, self.shape, change) for name in ("frame_in", "frame_out")
        )
        matrix = flat.reshape(*flat.shape[:-1], 4, 4)
        part = Mueller.of(matrix, *frames)
        return part.with_noise(lambda _: change(self.noise), given=self.is_given)

    @property
    def retardance(self) -> npt.NDArray[Any]:
        """The retardance of `lu_chipman`'s retarder, in radians, in [0, pi], of shape (...)."""
        return self.lu_chipman().retardance

    def lu_chipman(self) -> LuChipman:
        """Return the matrix as a depolarizer behind a retarder behind a diattenuator.

        By S.-Y. Lu and R. A. Chipman, J. Opt. Soc. Am. A 13, 1106 (1996). See `LuChipman` for
        what is chosen where the parts are not unique. Not inside ``jax.jit``.

        Examples
        --------
        >>> quarter = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]]
        >>> parts = (Mueller(np.diag([0.8, 0.4, 0.4, 0.4])) @ Mueller(quarter)).lu_chipman()
        >>> print(parts.retardance_vector.round(4), parts.depolarization.round(4))
        [1.5708 0.     0.    ] 0.5
        """
        depolarizer, retarder, diattenuator = polar_parts(self.matrix)
        return LuChipman(
            depolarizer=Mueller.of(depolarizer, self.frame_out, self.frame_out),
            retarder=Mueller.of(retarder, self.frame_in, self.frame_out),
            diattenuator=Mueller.of(diattenuator, self.frame_in, self.frame_in),
        )

    def nearest_physical(self) -> Mueller:
        """Return the physical matrix with the least sum of squared differences.

        Without the part of `coherency` whose eigenvalues are negative; so M00 may grow.

        Examples
        --------
        >>> Mueller(np.diag([1.0, 1.0, 1.0, -1.0])).nearest_physical().matrix.diagonal().round(12)
        array([ 1.5,  0.5,  0.5, -0.5])
        """
        return Mueller.of(cloude.nearest_physical(self.matrix), self.frame_in, self.frame_out)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mueller):
            return NotImplemented
        for mueller in (self, other):
            check_known("mueller == mueller", mueller.matrix)
        frames = self.frame_in == other.frame_in and self.frame_out == other.frame_out
        return frames and same(known(self.matrix), known(other.matrix))

    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True)
class LuChipman:
    """The polar decomposition: ``depolarizer @ retarder @ diattenuator`` is the matrix.

    By S.-Y. Lu and R. A. Chipman, J. Opt. Soc. Am. A 13, 1106 (1996); from `Mueller.lu_chipman`.
    What does not depolarise has the parts of its Jones matrix and the unit matrix as depolarizer,
    however little it lets through: within the rounding of parts that let 1 through at most, so
    that crossed polarisers are told from depolarisers down to an M00 of 1e-10.
    No matrix is refused, and no noise makes a NaN. Where the parts are not unique:

    - behind an ideal polariser, the retarder is the least turn of the state it lets through into
      the one that goes out, and the depolarizer is the same along all axes;
    - of a depolarizer that leaves one axis, or none, the retarder is the least turn;
    - where the determinant of the lower right part of depolarizer and retarder is negative, the
      depolarizer has three negative axes, as the paper has it, but one where the smallest is 0
      within rounding.

    What is no physical matrix comes back changed where it lets more through than its M00 allows
    (the diattenuation is then 1), or where M00 is 0 (the diattenuator is then 0).

    Attributes
    ----------
    depolarizer : Mueller
        M00 is 1 and the lower right 3x3 part is symmetric; in the frame of the light that goes out.
    retarder : Mueller
        A rotation of (S1, S2, S3), from the frame that comes in to the one that goes out.
    diattenuator : Mueller
        Symmetric, with the M00 of the matrix; in the frame of the light that comes in.

    Examples
    --------
    >>> from optipath import Interface
    >>> parts = Interface(index=0.6 + 2.1j, incidence=1.0).mueller().lu_chipman()
    >>> print(parts.diattenuation.round(4), parts.retardance.round(4))
    0.2065 2.1267
    """

    depolarizer: Mueller
    retarder: Mueller
    diattenuator: Mueller

    @property
    def diattenuation(self) -> npt.NDArray[Any]:
        """The diattenuation of the diattenuator, in [0, 1], of shape (...)."""
        # Of a matrix next to the smallest floats, roundings are not small.
        return np.asarray(np.minimum(self.diattenuator.diattenuation, 1.0))

    @property
    def diattenuation_vector(self) -> npt.NDArray[Any]:
        """The diattenuation along S1, S2 and S3, of shape (..., 3)."""
        return self.diattenuator.diattenuation_vector

    @property
    def retardance(self) -> npt.NDArray[Any]:
        """The retardance, in radians, in [0, pi], of shape (...), with its digits at both ends."""
        _, angle = turn_of(self.retarder.matrix)
        return angle

    @property
    def retardance_vector(self) -> npt.NDArray[Any]:
        """The retardance times `fast_axis`, of shape (..., 3)."""
        axis, angle = turn_of(self.retarder.matrix)
        return np.asarray(axis * angle[..., np.newaxis])

    @property
    def fast_axis(self) -> npt.NDArray[Any]:
        """The (S1, S2, S3) of the state that goes ahead of all others, of shape (..., 3).

        (1, 0, 0) for a `Retarder` at angle 0; 0 where nothing is retarded, and of either sign for
        a half-wave plate.
        """
        axis, _ = turn_of(self.retarder.matrix)
        return axis

    @property
    def depolarization(self) -> npt.NDArray[Any]:
        """1 - abs(M11 + M22 + M33) / 3 of the depolarizer, its power to depolarise; shape (...)."""
        three = np.trace(self.depolarizer.matrix[..., 1:, 1:], axis1=-2, axis2=-1)
        return np.asarray(1.0 - np.abs(three) / 3.0)

    @property
    def polarizance_vector(self) -> npt.NDArray[Any]:
        """What the depolarizer makes of unpolarised light, along S1, S2 and S3; shape (..., 3)."""
        return self.depolarizer.polarizance_vector
