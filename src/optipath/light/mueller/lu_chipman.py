"""LuChipman: a Mueller matrix as a depolarizer behind a retarder behind a diattenuator."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.mueller.figures import norm

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.mueller.matrix import Mueller


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
        _, angle = _turn_of(self.retarder.matrix)
        return angle

    @property
    def retardance_vector(self) -> npt.NDArray[Any]:
        """The retardance times `fast_axis`, of shape (..., 3)."""
        axis, angle = _turn_of(self.retarder.matrix)
        return np.asarray(axis * angle[..., np.newaxis])

    @property
    def fast_axis(self) -> npt.NDArray[Any]:
        """The (S1, S2, S3) of the state that goes ahead of all others, of shape (..., 3).

        (1, 0, 0) for a `Retarder` at angle 0; 0 where nothing is retarded, and of either sign for
        a half-wave plate.
        """
        axis, _ = _turn_of(self.retarder.matrix)
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


def _turn_of(retarder: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Return the axis and the angle in [0, pi] of rotations, by the largest of four columns.

    Each column is the unit quaternion (cos R/2, sin R/2 times the axis) times one of its parts.
    """
    r = np.asarray(retarder)[..., 1:, 1:]
    xx, yy, zz = r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]
    x, y, z = (r[..., i, j] - r[..., j, i] for i, j in ((2, 1), (0, 2), (1, 0)))
    xy, xz, yz = (r[..., i, j] + r[..., j, i] for i, j in ((0, 1), (0, 2), (1, 2)))
    columns = np.stack(
        [
            np.stack([1 + xx + yy + zz, x, y, z], axis=-1),
            np.stack([x, 1 + xx - yy - zz, xy, xz], axis=-1),
            np.stack([y, xy, 1 - xx + yy - zz, yz], axis=-1),
            np.stack([z, xz, yz, 1 - xx - yy + zz], axis=-1),
        ],
        axis=-2,
    )
    largest = np.argmax(np.diagonal(columns, axis1=-2, axis2=-1), axis=-1)
    column = np.take_along_axis(columns, largest[..., np.newaxis, np.newaxis], axis=-2)[..., 0, :]
    column = np.where(column[..., :1] < 0.0, -column, column)
    sine = norm(column[..., 1:])
    axis = column[..., 1:] / np.where(sine == 0.0, 1.0, sine)[..., np.newaxis]
    return axis, np.asarray(2.0 * np.arctan2(sine, column[..., 0]))
