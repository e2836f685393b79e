"""Figures read off the entries of a Mueller matrix, shape (..., 4, 4), each over M00.

They are 0 where M00 is 0, but psi and delta, angles that are not there, NaN; NaN where M00 or
what an angle is of is no more than noise, as of crossed polarisers, where M00 is infinite or an
entry they need is not known; and exact in scale.
"""

from __future__ import annotations

import warnings
from math import sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import CoherenceWarning
from optipath.light.mueller import cloude
from optipath.light.polarization_state import direction, length, ratio
from optipath.values.arrays.jax_values import is_traced, known, namespace
from optipath.values.calls_up import calls_up

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from optipath.values.roundings import Array

_BCS = (0, 1), (2, 2), (2, 3)
_DEPOLARIZES, _MIXES = 0.02, 0.05
"""From where on a matrix is no r_p / r_s: beyond the noise of ellipsometers, of some 0.01."""


class MatrixFigures:
    """What can be read off a Mueller matrix, whatever its frames are."""

    matrix: Any

    @property
    def diattenuation(self) -> Array:
        """The length of the diattenuation vector, of shape (...).

        (max - min) / (max + min) of what is let through, over all states that come in: 0 for a
        retarder, 1 for an ideal polariser, 0 where M00 is 0.

        Examples
        --------
        >>> from optipath import Mueller
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
        >>> from optipath import Mueller
        >>> print(Mueller(np.diag([1.0, 0.5, 0.5, 0.5])).depolarization_index.round(12))
        0.5
        """
        matrix = known(self.matrix)
        flat = matrix.reshape(*matrix.shape[:-2], 16)
        return norm(self._over_m00(flat[..., 1:])) / sqrt(3.0)

    @property
    def psi(self) -> Array:
        """The ellipsometric psi of an isotropic sample, of shape (...), in [0, pi/2].

        tan psi = abs(r_p) / abs(r_s), with x along s and y along p in both frames, as
        `Interface` has them; from cos 2 psi : sin 2 psi = M01 : hypot(M22, M23), and NaN where
        all three are 0. Of a sample that does not depolarise: what depolarises has less of M22 and
        M23, and so a psi nearer to 0 or pi/2 (see `depolarization_index`).

        Examples
        --------
        >>> from optipath import Mueller
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
        >>> from optipath import Mueller
        >>> Mueller(np.diag([1.0, 0.0, 0.0, 0.0])).coherency.real.diagonal()
        array([0.25, 0.25, 0.25, 0.25])
        """
        return cloude.coherency(self.matrix)

    @property
    def cloude_eigenvalues(self) -> Array:
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
        >>> from optipath import Mueller
        >>> print(Mueller(np.diag([1.0, 1.0, 1.0, -1.0])).is_physical())
        False
        """
        return cloude.is_physical(self.matrix, tolerance)

    @property
    def noise(self) -> Array:
        """Which entries of `matrix` are no more than rounding, of shape (...)."""
        raise NotImplementedError

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
            near = np.abs(matrix / matrix[..., :1, :1] - _isotropic(matrix)).max(axis=(-2, -1))
        for bad, what in (
            (self.depolarization_index < 1.0 - _DEPOLARIZES, "depolarizes (index below 0.98)"),
            (near > _MIXES, "is not that of an isotropic sample in its frame of s and p"),
        ):
            if np.any(lit & bad):
                warnings.warn(
                    f"psi and Delta are read off a matrix that {what}, and is none of r_p / r_s; "
                    f"use the whole matrix",
                    CoherenceWarning,
                    stacklevel=calls_up(),
                )
                return

    def _over_m00(self, entries: Array) -> Array:
        """Return entries over M00; NaN where that is no more than noise."""
        whole = known(self.matrix)[..., 0, 0, np.newaxis]
        noise = (whole != 0.0) & (abs(whole) < self.noise[..., np.newaxis])
        return namespace(whole).where(noise, np.nan, ratio(entries, whole))  # type: ignore[no-any-return]


def _isotropic(matrix: Array) -> Array:
    """Return the matrix of an isotropic sample that is nearest to one, over M00."""
    found = np.zeros(matrix.shape)
    m = matrix / matrix[..., :1, :1]
    found[..., 0, 0] = found[..., 1, 1] = 1.0
    found[..., 0, 1] = found[..., 1, 0] = (m[..., 0, 1] + m[..., 1, 0]) / 2.0
    found[..., 2, 2] = found[..., 3, 3] = (m[..., 2, 2] + m[..., 3, 3]) / 2.0
    found[..., 2, 3] = (m[..., 2, 3] - m[..., 3, 2]) / 2.0
    found[..., 3, 2] = -found[..., 2, 3]
    return found


def norm(vector: Array) -> Array:
    """Return the length along the last axis, however small; at 0 its slope is 0."""
    return length(*(vector[..., i] for i in range(vector.shape[-1])))  # type: ignore[no-any-return]
