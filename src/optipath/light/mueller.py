"""Mueller: a 4x4 matrix between two reference frames, and the three parts that it has.

Figures are of matrices (..., 4, 4) over M00. Where M00 is 0 they are 0, but psi and delta NaN; they
are NaN, too, where M00 or the argument of an angle is noise (crossed polarizers), infinite or
unknown.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import sqrt
from typing import TYPE_CHECKING, Any, Never, NoReturn, overload

import numpy as np

from optipath.errors import CoherenceWarning, FrameError, LightError
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.primitives import NUMPY
from optipath.light import decompositions
from optipath.light.array_axes import ArrayAxes, each_number, why_refused
from optipath.light.conventions import EllipsometricAngles, changed_matrix
from optipath.light.decompositions import polar_parts, reciprocal, stacked, turn_of
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.light.on_demand import FramesOnDemand, inherited_noise, rounding
from optipath.light.passive import check_becomes_light, nan_where_no_light
from optipath.light.polarization_state import direction, length, norm, ratio
from optipath.values.angles import warn
from optipath.values.arrays import Unchanging, check_broadcast, locked, read_only, real_array, same
from optipath.values.jax_values import check_known, is_jax, is_traced, known, namespace
from optipath.values.precision import coarser

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.light.conventions import Software
    from optipath.values.precision import Array


_SUMS = 4.0
"""How many roundings a sum of four products has, and the turn of frames before it."""

_BCS = (0, 1), (2, 2), (2, 3)
_DEPOLARIZES, _MIXES = 0.02, 0.05
"""From where on a matrix is no r_p / r_s: beyond the noise of ellipsometers, of some 0.01."""


class Mueller(FramesOnDemand, ArrayAxes, EllipsometricAngles, Unchanging):
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
    instead_of_numbers = (
        "whose frames would be lost; give mueller.matrix, as in op.MuellerElement(mueller.matrix)"
    )
    _written, _entry = "mueller.matrix", "mueller.matrix[..., 0, 0]"

    def __init__(
        self, matrix: Any, frame_in: Frame | None = None, frame_out: Frame | None = None
    ) -> None:
        frames = [Frame() if frame is None else frame for frame in (frame_in, frame_out)]
        if not all(isinstance(frame, Frame) for frame in frames):
            raise FrameError("the frames of a Mueller matrix must be Frames; use Frame(x, y, z)")
        matrix = real_array("a Mueller matrix", matrix, (4, 4))
        stored = matrix if is_jax(matrix) else read_only(matrix, widened=False)
        vars(self).update(matrix=stored, frame_in=frames[0], frame_out=frames[1])
        vars(self).update(_noise=0.0, _given=True)

    @cached_property
    def matrix(self) -> npt.NDArray[Any]:
        """The Mueller matrices, of shape (..., 4, 4); read-only."""
        return locked(vars(self)["_matrix"])  # type: ignore[no-any-return]

    @cached_property
    def frame_in(self) -> Frame:
        """The frame of the light that comes in."""
        return vars(self)["_frame_in"]()  # type: ignore[no-any-return]

    @cached_property
    def frame_out(self) -> Frame:
        """The frame of the light that goes out."""
        return vars(self)["_frame_out"]()  # type: ignore[no-any-return]

    @classmethod
    def of(
        cls,
        matrix: Any,
        frame_in: Frame | Callable[[], Frame],
        frame_out: Frame | Callable[[], Frame],
        noise: Any = None,
        *,
        given: bool = False,
    ) -> Mueller:
        """Return what has been computed as a Mueller matrix: the array becomes read-only.

        Parameters
        ----------
        matrix : ndarray, shape (..., 4, 4)
            Nobody else has it.
        frame_in, frame_out : Frame or callable
            Those of the light that comes in and that goes out, or what returns them when
            somebody asks.
        noise : ndarray of shape (...) or callable, optional
            What is noise beyond the rounding of the matrix, or what returns it for the matrix.
        given : bool, optional
            Whether it `is_given`.

        Returns
        -------
        Mueller
        """
        result = cls.__new__(cls)
        own = vars(result)
        own.update(_noise=0.0 if noise is None else noise, _given=given)
        own["_matrix"] = matrix
        own["frame_in" if type(frame_in) is Frame else "_frame_in"] = frame_in
        own["frame_out" if type(frame_out) is Frame else "_frame_out"] = frame_out
        return result

    @classmethod
    def from_(
        cls,
        convention: Software,
        matrix: Any,
        frame_in: Frame | None = None,
        frame_out: Frame | None = None,
    ) -> Mueller:
        """Return Mueller matrices out of those of other software.

        Parameters
        ----------
        convention : str
            As in `Light.to`.
        matrix : array_like, shape (..., 4, 4)
            As that software writes them.
        frame_in, frame_out : Frame, optional
            The frames of the light that comes in and that goes out; unit frames by default.

        Returns
        -------
        Mueller

        Examples
        --------
        >>> quarter = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1], [0, 0, -1, 0]]
        >>> Mueller.from_("mitsuba", quarter).matrix[3]
        array([0., 0., 1., 0.])
        """
        argument = real_array("a Mueller matrix", matrix, (4, 4))
        return cls(changed_matrix(convention, argument), frame_in, frame_out)

    @property
    def diattenuation(self) -> Array:
        """The length of the diattenuation vector, of shape (...).

        (max - min) / (max + min) of what is let through, over all states that come in: 0 for a
        retarder, 1 for an ideal polariser, 0 where M00 is 0.

        Examples
        --------
        >>> print(Mueller([[4, 2, 0, 0], [2, 4, 0, 0], [0, 0, 3, 0], [0, 0, 0, 3]]).diattenuation)
        0.5
        """
        return norm(self.diattenuation_vector)

    @property
    def diattenuation_vector(self) -> Array:
        """(M01, M02, M03) / M00, of shape (..., 3), in the frame of the light that comes in."""
        return self._over_m00(known(self.matrix)[..., 0, 1:])

    @property
    def polarizance(self) -> Array:
        """The degree of polarisation that unpolarised light leaves with, of shape (...)."""
        return norm(self.polarizance_vector)

    @property
    def polarizance_vector(self) -> Array:
        """(M10, M20, M30) / M00, of shape (..., 3), in the frame of the light that goes out."""
        return self._over_m00(known(self.matrix)[..., 1:, 0])

    @property
    def depolarization_index(self) -> Array:
        """The depolarisation index, of shape (...).

        1 for what a Jones matrix describes, 0 for an ideal depolariser;
        sqrt(sum of M_ij^2 - M00^2) / (sqrt(3) M00) by J. J. Gil and E. Bernabeu, Opt. Acta 33,
        185 (1986); 0 where M00 is 0.

        Examples
        --------
        >>> print(Mueller(np.diag([1.0, 0.5, 0.5, 0.5])).depolarization_index.round(12))
        0.5
        """
        matrix = known(self.matrix)
        flat = matrix.reshape(*matrix.shape[:-2], 16)
        return norm(self._over_m00(flat[..., 1:])) / sqrt(3.0)

    @property
    def retardance(self) -> npt.NDArray[Any]:
        """The retardance of `lu_chipman`'s retarder, in radians, in [0, pi], of shape (...)."""
        return self.lu_chipman().retardance

    @property
    def psi(self) -> Array:
        """The ellipsometric psi of an isotropic sample, of shape (...), in [0, pi/2].

        tan psi = abs(r_p) / abs(r_s), with x along s and y along p in both frames, as
        `Interface` has them; from cos 2 psi : sin 2 psi = M01 : hypot(M22, M23), and NaN where
        all three are 0. Of a sample that does not depolarise: what depolarises has less of M22 and
        M23, and so a psi nearer to 0 or pi/2 (see `depolarization_index`).

        Examples
        --------
        >>> glass = [[0.5, 0.3, 0, 0], [0.3, 0.5, 0, 0], [0, 0, -0.4, 0], [0, 0, 0, -0.4]]
        >>> print(np.tan(Mueller(glass).psi).round(12), Mueller(glass).delta.round(4))
        0.5 3.1416
        """
        B, C, S = self._bcs()
        rho = length(C, S)
        return self._where_there(0.5 * direction(rho, B), length(rho, B))

    @property
    def delta(self) -> Array:
        """The ellipsometric Delta of an isotropic sample, of shape (...), in (-pi, pi].

        The phase of r_p / r_s in ellipsometry's exp(+i w t), atan2(M23, M22): pi where a
        dielectric is met below Brewster's angle, between 0 and pi for a bare metal; NaN where
        M22 and M23 are both 0.
        """
        _, C, S = self._bcs()
        return self._where_there(direction(S, C), length(C, S))

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
        return decompositions.coherency(self.matrix)

    @property
    def cloude_eigenvalues(self) -> Array:
        """The eigenvalues of `coherency`, the largest first, of shape (..., 4); their sum is M00.

        What does not depolarise has one above 0; a physical matrix has none below 0.
        """
        return decompositions.eigenvalues(self.matrix)

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
        return decompositions.is_physical(self.matrix, tolerance)

    @cached_property
    def noise(self) -> Array:
        """Which entries of `matrix` are no more than rounding: those below it, shape (...).

        The rounding of M00; of a product, and of the matrix of a path, what is left of the
        roundings of all factors: of crossed polarisers it is larger than M00.

        Examples
        --------
        >>> print(Mueller(np.eye(4)).noise)
        2.220446049250313e-16
        """
        noise = vars(self)["_noise"]
        noise = noise(self.matrix) if callable(noise) else noise
        least = rounding(known(self.matrix)[..., 0, :])
        return locked(namespace(least).maximum(least, noise))  # type: ignore[no-any-return]

    @property
    def is_given(self) -> bool:
        """Whether its numbers, or some of its factors', come from outside, as measured ones do."""
        return bool(vars(self)["_given"])

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
        nearest = decompositions.nearest_physical(self.matrix)
        return Mueller.of(nearest, self.frame_in, self.frame_out)

    def reversed(self) -> Mueller:
        """Return what the same system does to light that goes back through it.

        It is that of whatever is reciprocal: light that goes back along a frame (x, y, z) has
        (x, -y, -z), and between these frames it meets Q M^T Q, Q = diag(1, 1, -1, 1) (Sekera,
        J. Opt. Soc. Am. 56, 1732 (1966)). What stands in a magnetic field is not, nor is the power
        that passes into a medium that absorbs, and a matrix does not know: reverse the element,
        or the path.

        Returns
        -------
        Mueller
            From the mirrored `frame_out` to the mirrored `frame_in`.

        Examples
        --------
        >>> from optipath import Retarder
        >>> back = Retarder(1.0, 0.3).mueller().reversed()
        >>> bool(np.allclose(back.matrix, Retarder(1.0, -0.3).mueller().matrix))
        True
        >>> print(back.frame_in.z)
        [ 0.  0. -1.]
        """

        def mirrored(name: str) -> Callable[[], Frame]:
            return lambda: getattr(self, name).reversed()

        frames = mirrored("frame_out"), mirrored("frame_in")
        matrix = reciprocal(self.matrix)
        return self.of(matrix, *frames, noise=lambda _: self.noise, given=self.is_given)

    def to(self, convention: Software) -> Array:
        """Return the matrices as other software writes them, of shape (..., 4, 4).

        ``M.to(name) @ light.to(name)`` is ``(M @ light).to(name)``.

        Parameters
        ----------
        convention : str
            As in `Light.to`.

        Returns
        -------
        ndarray, shape (..., 4, 4)

        Examples
        --------
        >>> from optipath import Interface
        >>> Interface(index=1.5, incidence=1.309).mueller().to("ellipsometry").round(3)[0]
        array([ 0.253, -0.146,  0.   ,  0.   ])
        """
        return changed_matrix(convention, self.matrix)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the matrix over its M00 as a map of its elements with Matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Where; a figure of its own by default, ``.figure`` of what is returned.

        Returns
        -------
        Axes

        Raises
        ------
        OptipathError
            If it is a batch, or the axes are something else.
        ParameterError
            If JAX traces it.
        MissingExtraError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import optipath as op
        >>> op.Retarder("90 deg", "0 deg").mueller().plot().get_title()
        'M / M00, with M00 = 1'
        """
        from optipath.plots import mueller  # noqa: PLC0415 - pictures stand above light

        return mueller(self, ax)

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
        behind = self._cached_frame("frame_out")
        judged = self.is_given and not light.is_measured
        stokes = known(aligned.stokes)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            product = (matrix @ stokes[..., np.newaxis])[..., 0]
        product = product.astype(coarser(matrix, stokes), copy=False)
        if is_traced(product):
            noise = None
            if judged:
                product = nan_where_no_light(matrix, self.noise, stokes, product)
        else:
            noise = inherited_noise((aligned,), matrix[..., 0, 0], mixed=True, added=self.noise)
            if judged:
                check_becomes_light(matrix, self.noise, stokes, product)
        return Light.of(product, behind, noise, **light.origin())

    def _behind(self, other: Mueller) -> Mueller:
        matrix, before = known(self.matrix), known(other.matrix)
        check_broadcast({"matrix": self.shape, "other matrix": other.shape})
        turn = stacked(ROTATION.rows(NUMPY, other.frame_out.turn_to(self.frame_in)))
        with np.errstate(over="ignore", invalid="ignore"):
            product = matrix @ turn @ before
        frames = other._cached_frame("frame_in"), self._cached_frame("frame_out")
        noise = noise_of_product(*((m.matrix, m.noise) for m in (self, other)))
        product = product.astype(coarser(matrix, before), copy=False)
        return Mueller.of(product, *frames, noise=noise, given=self.is_given or other.is_given)

    def __rmatmul__(self, other: Never) -> NoReturn:
        """Refuse what has no frames."""
        raise LightError(why_refused(other))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mueller):
            return NotImplemented
        for mueller in (self, other):
            check_known("mueller == mueller", mueller.matrix)
        frames = self.frame_in == other.frame_in and self.frame_out == other.frame_out
        return frames and same(known(self.matrix), known(other.matrix))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        frames = f"frame_in={self.frame_in!r}, frame_out={self.frame_out!r}"
        return f"Mueller(matrix={self.matrix!r}, {frames})"

    def __getstate__(self) -> dict[str, Any]:
        # What computes the noise stays here.
        return {**super().__getstate__(), "_noise": self.noise}

    def _each(self, change: Callable[[Any], Any]) -> Mueller:
        flat = each_number(known(self.matrix).reshape(*self.shape, 16), change)
        of_in, of_out = (
            self._part_of_frame(name, self.shape, change) for name in ("frame_in", "frame_out")
        )
        matrix = flat.reshape(*flat.shape[:-1], 4, 4)
        noise = lambda _: change(self.noise)  # noqa: E731 - hardly ever asked for
        return Mueller.of(matrix, of_in, of_out, noise, given=self.is_given)

    def _over_m00(self, entries: Array) -> Array:
        """Return entries over M00; NaN where that is no more than noise."""
        whole = known(self.matrix)[..., 0, 0, np.newaxis]
        noise = (whole != 0.0) & (abs(whole) < self.noise[..., np.newaxis])
        return namespace(whole).where(noise, np.nan, ratio(entries, whole))  # type: ignore[no-any-return]

    def _where_there(self, value: Array, size: Array) -> Array:
        """Return an angle, NaN where the vector whose direction it is is no longer than noise."""
        floor = ratio(self.noise, abs(known(self.matrix)[..., 0, 0]))
        return namespace(value).where(size <= floor, np.nan, value)  # type: ignore[no-any-return]

    def _bcs(self) -> Iterator[Array]:
        matrix = known(self.matrix)
        if not is_traced(matrix):
            self._warn_of_no_sample(matrix)
        return (self._over_m00(matrix[..., i, j, np.newaxis])[..., 0] for i, j in _BCS)

    def _warn_of_no_sample(self, matrix: Array) -> None:
        """Warn where there is no r_p / r_s: of what depolarizes, or mixes s and p."""
        lit = matrix[..., 0, 0] > self.noise
        with np.errstate(all="ignore"):
            m = matrix / matrix[..., :1, :1]
            # Isotropic, m01 = m10, m22 = m33, m23 = -m32, and m11 = 1.
            pairs = m[..., 0, 1] - m[..., 1, 0], m[..., 2, 2] - m[..., 3, 3]
            apart = np.abs([*pairs, m[..., 2, 3] + m[..., 3, 2], 2.0 * (m[..., 1, 1] - 1.0)])
            across = np.abs([m[..., :2, 2:], m[..., 2:, :2]]).max(axis=(0, -2, -1))
            mixes = np.maximum(0.5 * apart.max(axis=0), across) > _MIXES
        for bad, what in (
            (self.depolarization_index < 1.0 - _DEPOLARIZES, "depolarizes (index below 0.98)"),
            (mixes, "is not that of an isotropic sample in its frame of s and p"),
        ):
            if np.any(lit & bad):
                warn(
                    f"psi and Delta are read off a matrix that {what}, and is none of r_p / r_s; "
                    f"use the whole matrix",
                    CoherenceWarning,
                )
                return


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


def noise_of_product(behind: tuple[Any, Any], before: tuple[Any, Any]) -> Any:
    """Return the noise in a product of matrices, shape (...), by running error analysis."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        one, two = _size(*behind), _size(*before)
        both = one * two
        eps = float(namespace(both).finfo(both.dtype).eps)
        return one * before[1] + behind[1] * two + _SUMS * eps * both


def _size(matrix: Any, noise: Any) -> Any:
    """Return M00, which no entry exceeds, or the noise where that is more."""
    return namespace(matrix).maximum(abs(known(matrix)[..., 0, 0]), noise)
