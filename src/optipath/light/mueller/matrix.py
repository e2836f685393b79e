"""Mueller: a 4x4 matrix between two reference frames."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from optipath.errors import FrameError
from optipath.kernels import NUMPY, ROTATION
from optipath.light.frames import Frame
from optipath.light.light import Light
from optipath.light.mueller import cloude, figures
from optipath.light.mueller.lu_chipman import LuChipman
from optipath.light.mueller.polar_decomposition import polar_parts
from optipath.light.underflow import folded, normalise_exponent
from optipath.values.arrays.jax_values import is_traced, known
from optipath.values.arrays.read_only import same
from optipath.values.arrays.shapes import check_broadcast, real_array

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class Mueller:
    """What an optical system does to light: a matrix, or a batch, between two frames.

    ``M2 @ M1`` lets light meet M1 first; ``M @ light`` attenuates. Both turn the
    numbers from the frame that light leaves in to the frame it is expected in, and
    refuse frames whose directions differ.

    Parameters
    ----------
    matrix : array_like, shape (..., 4, 4)
        Acts on the Stokes vectors of `Light`.
    frame_in, frame_out : Frame, optional
        The frames of the light that comes in and that goes out; unit frames by default.

    Raises
    ------
    ShapeError
        If the last two axes have not four elements each.

    Examples
    --------
    >>> half = Mueller(np.diag([0.5, 0.5, 0.5, 0.5]))
    >>> (half @ half @ Light([1.0, 0.0, 0.0, 0.0])).stokes
    array([0.25, 0.  , 0.  , 0.  ])
    """

    matrix: Any
    frame_in: Frame = field(default_factory=Frame)
    frame_out: Frame = field(default_factory=Frame)

    def __post_init__(self) -> None:
        if not (isinstance(self.frame_in, Frame) and isinstance(self.frame_out, Frame)):
            raise FrameError("the frames of a Mueller matrix must be Frames; use Frame(x, y, z)")
        object.__setattr__(self, "matrix", real_array("a Mueller matrix", self.matrix, (4, 4)))

    @overload
    def __matmul__(self, other: Mueller) -> Mueller: ...
    @overload
    def __matmul__(self, other: Light) -> Light: ...
    def __matmul__(self, other: Mueller | Light) -> Mueller | Light:
        matrix, batch = known(self.matrix), self.matrix.shape[:-2]
        if isinstance(other, Light):
            check_broadcast({"matrix": batch, "light": other.stokes.shape[:-1]})
            aligned = other.in_frame(self.frame_in)
            if is_traced(matrix) or is_traced(aligned.mantissa):
                return Light((matrix @ aligned.stokes[..., np.newaxis])[..., 0], self.frame_out)
            stokes, exponent = normalise_exponent(aligned.mantissa, aligned.exponent)
            with np.errstate(over="ignore", invalid="ignore"):
                product = (matrix @ stokes[..., np.newaxis])[..., 0]
            exponent = np.broadcast_to(exponent, product.shape[:-1])
            stokes, exponent = folded(product, exponent)
            return Light(stokes, self.frame_out, exponent)
        if isinstance(other, Mueller):
            check_broadcast({"matrix": batch, "other matrix": other.matrix.shape[:-2]})
            turn = _turn_matrix(other.frame_out, self.frame_in)
            with np.errstate(over="ignore", invalid="ignore"):
                product = matrix @ turn @ known(other.matrix)
            return Mueller(product, other.frame_in, self.frame_out)
        return NotImplemented

    @property
    def diattenuation(self) -> npt.NDArray[Any]:
        """The length of the diattenuation vector, of shape (...).

        (max - min) / (max + min) of what is let through, over all states that come in: 0 for a
        retarder, 1 for an ideal polariser, 0 where M00 is 0.

        Examples
        --------
        >>> print(Mueller([[4, 2, 0, 0], [2, 4, 0, 0], [0, 0, 3, 0], [0, 0, 0, 3]]).diattenuation)
        0.5
        """
        return figures.norm(self.diattenuation_vector)

    @property
    def diattenuation_vector(self) -> npt.NDArray[Any]:
        """(M01, M02, M03) / M00, of shape (..., 3), in the frame of the light that comes in."""
        return figures.diattenuation_vector(known(self.matrix))

    @property
    def polarizance(self) -> npt.NDArray[Any]:
        """The degree of polarisation that unpolarised light leaves with, of shape (...)."""
        return figures.norm(self.polarizance_vector)

    @property
    def polarizance_vector(self) -> npt.NDArray[Any]:
        """(M10, M20, M30) / M00, of shape (..., 3), in the frame of the light that goes out."""
        return figures.polarizance_vector(known(self.matrix))

    @property
    def depolarization_index(self) -> npt.NDArray[Any]:
        """The depolarisation index, of shape (...).

        1 for what a Jones matrix describes, 0 for an ideal depolariser;
        sqrt(sum of M_ij^2 - M00^2) / (sqrt(3) M00) by J. J. Gil and E. Bernabeu, Opt. Acta 33,
        185 (1986); 0 where M00 is 0.

        Examples
        --------
        >>> print(Mueller(np.diag([1.0, 0.5, 0.5, 0.5])).depolarization_index.round(12))
        0.5
        """
        return figures.depolarization_index(known(self.matrix))

    @property
    def psi(self) -> npt.NDArray[Any]:
        """The ellipsometric psi of an isotropic sample, of shape (...), in [0, pi/2].

        tan psi = abs(r_p) / abs(r_s), with x along s and y along p in both frames, as
        `Interface` has them; from cos 2 psi : sin 2 psi = M01 : hypot(M22, M23).

        Examples
        --------
        >>> glass = [[0.5, 0.3, 0, 0], [0.3, 0.5, 0, 0], [0, 0, -0.4, 0], [0, 0, 0, -0.4]]
        >>> print(np.tan(Mueller(glass).psi).round(12), Mueller(glass).delta.round(4))
        0.5 3.1416
        """
        return figures.sample_psi(known(self.matrix))

    @property
    def delta(self) -> npt.NDArray[Any]:
        """The ellipsometric Delta of an isotropic sample, of shape (...), in (-pi, pi].

        The phase of r_p / r_s in ellipsometry's exp(+i w t), atan2(M23, M22): pi where a
        dielectric is met below Brewster's angle, between 0 and pi for a bare metal.
        """
        return figures.sample_delta(known(self.matrix))

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

    @property
    def coherency(self) -> npt.NDArray[np.complex128]:
        """Cloude's coherency matrix, Hermitian, of shape (..., 4, 4), with the trace M00.

        The mean of c_k conj(c_l) over Jones matrices T = c_0 s_0 + c_1 s_1 + c_2 s_2 + c_3 s_3
        that make the matrix up; s_0 is the unit matrix, and the others are Pauli's in the order
        of S1, S2, S3: diag(1, -1), [[0, 1], [1, 0]], [[0, -i], [i, 0]]. By S. R. Cloude, Optik
        75, 26 (1986).

        Examples
        --------
        >>> Mueller(np.diag([1.0, 0.0, 0.0, 0.0])).coherency.real.diagonal()
        array([0.25, 0.25, 0.25, 0.25])
        """
        return cloude.coherency(self.matrix)

    @property
    def cloude_eigenvalues(self) -> npt.NDArray[Any]:
        """The eigenvalues of `coherency`, the largest first, of shape (..., 4); their sum is M00.

        What does not depolarise has one above 0; a physical matrix has none below 0.
        """
        return cloude.eigenvalues(self.matrix)

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
        return Mueller(cloude.nearest_physical(self.matrix), self.frame_in, self.frame_out)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mueller):
            return NotImplemented
        frames = self.frame_in == other.frame_in and self.frame_out == other.frame_out
        return frames and same(known(self.matrix), known(other.matrix))

    __hash__ = None  # type: ignore[assignment]


def _turn_matrix(leaves: Frame, enters: Frame) -> npt.NDArray[np.float64]:
    return stacked(ROTATION.rows(NUMPY, leaves.turn_to(enters)))


def stacked(rows: Any) -> npt.NDArray[np.float64]:
    """Return rows of elementwise entries as one array of shape (..., 4, 4)."""
    entries = np.broadcast_arrays(*(entry for row in rows for entry in row))
    flat = np.stack(entries, axis=-1)
    return flat.reshape(*flat.shape[:-1], 4, 4)
