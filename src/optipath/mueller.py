"""Mueller: a 4x4 matrix between two reference frames."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from optipath.errors import FrameError
from optipath.faint import folded, near_one
from optipath.frames import Frame
from optipath.frozen import same
from optipath.jax_values import is_jax
from optipath.kernels import NUMPY, ROTATION
from optipath.light import Light
from optipath.shapes import check_broadcast, real_array

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
        given = self.matrix
        matrix = given if is_jax(given) else real_array("a Mueller matrix", given, (4, 4))
        object.__setattr__(self, "matrix", matrix)

    @overload
    def __matmul__(self, other: Mueller) -> Mueller: ...
    @overload
    def __matmul__(self, other: Light) -> Light: ...
    def __matmul__(self, other: Mueller | Light) -> Mueller | Light:
        batch = self.matrix.shape[:-2]
        if isinstance(other, Light):
            check_broadcast({"matrix": batch, "light": other.stokes.shape[:-1]})
            aligned = other.in_frame(self.frame_in)
            stokes, exponent = near_one(aligned.mantissa, aligned.exponent)
            product = (self.matrix @ stokes[..., np.newaxis])[..., 0]
            exponent = np.broadcast_to(exponent, product.shape[:-1])
            stokes, exponent = folded(product, exponent)
            return Light(stokes, self.frame_out, exponent)
        if isinstance(other, Mueller):
            check_broadcast({"matrix": batch, "other matrix": other.matrix.shape[:-2]})
            turn = _turn_matrix(other.frame_out, self.frame_in)
            return Mueller(self.matrix @ turn @ other.matrix, other.frame_in, self.frame_out)
        return NotImplemented

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mueller):
            return NotImplemented
        frames = self.frame_in == other.frame_in and self.frame_out == other.frame_out
        return frames and same(self.matrix, other.matrix)

    __hash__ = None  # type: ignore[assignment]


def _turn_matrix(leaves: Frame, enters: Frame) -> npt.NDArray[np.float64]:
    return stacked(ROTATION.rows(NUMPY, leaves.turn_to(enters)))


def stacked(rows: Any) -> npt.NDArray[np.float64]:
    """Return rows of elementwise entries as one array of shape (..., 4, 4)."""
    entries = np.broadcast_arrays(*(entry for row in rows for entry in row))
    flat = np.stack(entries, axis=-1)
    return flat.reshape(*flat.shape[:-1], 4, 4)
