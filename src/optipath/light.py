"""Light: a Stokes vector in one reference frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError
from optipath.frames import Frame
from optipath.frozen import same
from optipath.kernels import turn_linear
from optipath.shapes import check_broadcast, real_array

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class Light:
    """A Stokes vector (S0, S1, S2, S3), or a batch of them, in one frame.

    Parameters
    ----------
    stokes : array_like, shape (..., 4)
        S0 the intensity, S1 horizontal over vertical (x over y), S2 diagonal over
        antidiagonal, S3 > 0 for a field that turns from x to y. A component that
        a detector does not read is NaN.
    frame : Frame, optional
        The frame the components refer to; the unit frame by default.

    Raises
    ------
    ShapeError
        If the last axis has not four elements.

    Examples
    --------
    >>> light = Light([1.0, 1.0, 0.0, 0.0])
    >>> light.in_frame(Frame().turned(np.pi / 4)).stokes.round(12)
    array([ 1.,  0., -1.,  0.])
    """

    stokes: Any
    frame: Frame = field(default_factory=Frame)

    def __post_init__(self) -> None:
        if not isinstance(self.frame, Frame):
            raise FrameError(f"the frame of a light must be a Frame, not {self.frame!r}")
        stokes = real_array("a Stokes vector", self.stokes, (4,))
        object.__setattr__(self, "stokes", stokes)

    @property
    def intensity(self) -> npt.NDArray[np.float64]:
        """S0, of shape (...)."""
        return np.asarray(self.stokes[..., 0])

    @property
    def dop(self) -> npt.NDArray[np.float64]:
        """The degree of polarisation, of shape (...); 0 where there is no light."""
        polarised = np.linalg.norm(self.stokes[..., 1:], axis=-1)
        dark = self.intensity == 0.0
        return np.asarray(np.where(dark, 0.0, polarised / np.where(dark, 1.0, self.intensity)))

    def in_frame(self, frame: Frame) -> Light:
        """Return the same light with its components given in another frame.

        Raises
        ------
        FrameError
            If the other frame has another direction.
        """
        if isinstance(frame, Frame):
            check_broadcast({"light": self.stokes.shape[:-1], "frame": frame.z.shape[:-1]})
        s0, s1, s2, s3 = np.moveaxis(self.stokes, -1, 0)
        parts = (s0, *turn_linear(self.frame.turn_to(frame), s1, s2), s3)
        return Light(np.stack(np.broadcast_arrays(*parts), axis=-1), frame)

    def __add__(self, other: object) -> Light:
        if not isinstance(other, Light):
            return NotImplemented
        shapes = {"light": self.stokes.shape[:-1], "other light": other.stokes.shape[:-1]}
        check_broadcast(shapes)
        return Light(self.stokes + other.in_frame(self.frame).stokes, self.frame)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Light):
            return NotImplemented
        return same(self.stokes, other.stokes) and self.frame == other.frame

    __hash__ = None  # type: ignore[assignment]
