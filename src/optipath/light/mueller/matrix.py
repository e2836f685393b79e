"""Mueller: a 4x4 matrix between two reference frames, and the three parts that it has."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NoReturn, overload

import numpy as np

from optipath.errors import FrameError, LightError
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.exchange import MuellerExchange
from optipath.light.frames import Frame
from optipath.light.inherited_noise import inheriting, rounding
from optipath.light.light import Light
from optipath.light.mueller import cloude
from optipath.light.mueller.figures import MatrixFigures
from optipath.light.mueller.matrix_noise import noise_of_product
from optipath.light.mueller.polar_decomposition import polar_parts
from optipath.light.mueller.sphere_rotations import turn_of
from optipath.light.mueller.stacking import stacked
from optipath.light.refused_products import why_refused
from optipath.light.underflow import folded, normalise_exponent
from optipath.values.arrays.jax_values import check_known, is_jax, is_traced, known, namespace
from optipath.values.arrays.read_only import Unchanging, locked, read_only, same
from optipath.values.arrays.shapes import check_broadcast, real_array

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class Mueller(MatrixFigures, MuellerExchange, Unchanging):
    """What an optical system does to light: a matrix, or a batch, between two frames.

    ``M2 @ M1`` lets light meet M1 first; ``M @ light`` attenuates. Both turn the numbers from the
    frame that light leaves in to the one it is expected in; their directions must agree.

    Parameters
    ----------
    matrix : array_like, shape (..., 4, 4)
        Acts on Stokes vectors.
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

    matrix: Any
    frame_in: Frame = field(default_factory=Frame)
    frame_out: Frame = field(default_factory=Frame)

    def __post_init__(self) -> None:
        if not (isinstance(self.frame_in, Frame) and isinstance(self.frame_out, Frame)):
            raise FrameError("the frames of a Mueller matrix must be Frames; use Frame(x, y, z)")
        matrix = real_array("a Mueller matrix", self.matrix, (4, 4))
        kept = matrix if is_jax(matrix) else read_only(matrix, widened=False)
        object.__setattr__(self, "matrix", kept)

    @classmethod
    def of(cls, matrix: Any, frame_in: Frame, frame_out: Frame) -> Mueller:
        """Return what has been computed as a Mueller matrix: the array becomes read-only.

        Parameters
        ----------
        matrix : ndarray, shape (..., 4, 4)
            Nobody else has it.
        frame_in, frame_out : Frame
            Those of the light that comes in and that goes out.

        Returns
        -------
        Mueller
        """
        found = cls.__new__(cls)
        vars(found).update(matrix=locked(matrix), frame_in=frame_in, frame_out=frame_out)
        return found

    @overload
    def __matmul__(self, other: Mueller) -> Mueller: ...
    @overload
    def __matmul__(self, other: Light) -> Light: ...
    def __matmul__(self, other: Mueller | Light) -> Mueller | Light:
        matrix, batch = known(self.matrix), self.matrix.shape[:-2]
        if isinstance(other, Light):
            shapes = {"matrix": batch, "light": other.stokes.shape[:-1]}
            check_broadcast(shapes, fixed=("matrix",))
            aligned = other.in_frame(self.frame_in)
            if is_traced(matrix) or is_traced(aligned.mantissa):
                return Light.of((matrix @ aligned.stokes[..., np.newaxis])[..., 0], self.frame_out)
            stokes, exponent = normalise_exponent(aligned.mantissa, aligned.exponent)
            with np.errstate(over="ignore", invalid="ignore"):
                product = (matrix @ stokes[..., np.newaxis])[..., 0]
            stokes, exponent = folded(product, np.broadcast_to(exponent, product.shape[:-1]))
            noise = inheriting((aligned,), matrix[..., 0, 0], mixed=True, added=self.noise)
            return Light.of(stokes, self.frame_out, exponent, noise)
        if isinstance(other, Mueller):
            shapes = {"matrix": batch, "other matrix": other.matrix.shape[:-2]}
            check_broadcast(shapes, fixed=shapes)
            turn = stacked(ROTATION.rows(NUMPY, other.frame_out.turn_to(self.frame_in)))
            with np.errstate(over="ignore", invalid="ignore"):
                product = matrix @ turn @ known(other.matrix)
            both = Mueller.of(product, other.frame_in, self.frame_out)
            return both.with_noise(noise_of_product(*((m.matrix, m.noise) for m in (self, other))))
        if hasattr(other, "dtype") or not hasattr(type(other), "__rmatmul__"):
            raise LightError(why_refused(other))
        return NotImplemented

    def __rmatmul__(self, other: object) -> NoReturn:
        """Refuse what has no frames."""
        raise LightError(why_refused(other))

    @property
    def noise(self) -> npt.NDArray[Any]:
        """Which entries of `matrix` are no more than rounding: those below it, shape (...).

        The rounding of M00; of a product, and of the matrix of a path, what is left of the
        roundings of all factors: of crossed polarisers it is larger than M00.

        Examples
        --------
        >>> print(Mueller(np.eye(4)).noise)
        2.220446049250313e-16
        """
        own = self.__dict__
        if callable(own.get("_noise")):
            own["_noise"] = own["_noise"](self.matrix)
        if "_floor" not in own:
            least = rounding(known(self.matrix)[..., 0, :])
            own["_floor"] = locked(namespace(least).maximum(least, own.get("_noise", 0.0)))
        return own["_floor"]  # type: ignore[no-any-return]

    def with_noise(self, noise: npt.NDArray[Any] | Callable[[Any], Any]) -> Mueller:
        """Return the same matrix, of which more is noise than its own rounding.

        Parameters
        ----------
        noise : ndarray of shape (...), or callable
            The noise, or what returns it for the matrix when somebody asks.

        Returns
        -------
        Mueller
        """
        found = Mueller.of(self.matrix, self.frame_in, self.frame_out)
        found.__dict__["_noise"] = noise
        return found

    def __getstate__(self) -> dict[str, Any]:
        # What computes the noise stays here.
        return {**self.__dict__, "_noise": self.noise}

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
            depolarizer=Mueller(depolarizer, self.frame_out, self.frame_out),
            retarder=Mueller(retarder, self.frame_in, self.frame_out),
            diattenuator=Mueller(diattenuator, self.frame_in, self.frame_in),
        )

    def is_physical(self, tolerance: float | None = None) -> npt.NDArray[np.bool_]:
        """Tell whether some mixture of Jones matrices acts like this, shape (...).

        Parameters
        ----------
        tolerance : float, optional
            How far below 0, against the largest, an eigenvalue of `coherency` may be. By
            default 1e-9, or a hundred roundings of a matrix of less than double precision:
            1.2e-5 for float32.

        Raises
        ------
        ValueFault
            If the tolerance is no finite number >= 0.

        Examples
        --------
        >>> print(Mueller(np.diag([1.0, 1.0, 1.0, -1.0])).is_physical())
        False
        """
        return cloude.is_physical(self.matrix, tolerance)

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
