"""Frames that are made when somebody asks for them, since most nobody looks at."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError
from optipath.light.array_axes import each_number
from optipath.light.frames import Frame
from optipath.values.arrays.jax_values import is_traced

if TYPE_CHECKING:
    from collections.abc import Callable


class FramesOnDemand:
    """What has frames, each a `Frame`, or what returns it when somebody asks."""

    def _keep_frames(self, **frames: Frame | Callable[[], Frame]) -> None:
        """Keep each by its name; one that is not made yet with an underscore before it."""
        for name, frame in frames.items():
            self.__dict__[name if type(frame) is Frame else f"_{name}"] = frame

    def _kept_frame(self, name: str) -> Any:
        """Return a frame as it is kept, which nobody has to make for it."""
        own = self.__dict__
        return own[name] if name in own else own[f"_{name}"]

    def _part_of_frame(
        self, name: str, batch: tuple[int, ...], change: Callable[[Any], Any]
    ) -> Frame | Callable[[], Frame]:
        """Return what `indexed_frame` does, or what returns it where nobody has to make it."""
        kept = self._kept_frame(name)
        if type(kept) is Frame and (
            kept.z.ndim == 1 or not is_traced(change(np.broadcast_to(0.0, batch)))
        ):
            return indexed_frame(kept, batch, change)
        return lambda: indexed_frame(getattr(self, name), batch, change)

    if not TYPE_CHECKING:  # Else any name would do for who checks types.

        def __getattr__(self, name: str) -> Any:
            own = self.__dict__
            if not name.startswith("frame") or f"_{name}" not in own:
                kind = type(self).__name__
                raise AttributeError(f"a {kind} has no attribute '{name}'", name=name, obj=self)
            own[name] = own[f"_{name}"]()
            return own[name]

    def __getstate__(self) -> dict[str, Any]:
        # What makes frames stays here.
        own = dict(self.__dict__)
        for later in [name for name in own if name.startswith("_frame")]:
            del own[later]
            own[later[1:]] = getattr(self, later[1:])
        return own


def indexed_frame(frame: Frame, batch: tuple[int, ...], change: Callable[[Any], Any]) -> Frame:
    """Return the frames that belong to a part of a batch.

    Examples
    --------
    >>> frames = Frame().turned([0.0, 0.5, 1.0])
    >>> indexed_frame(frames, (3,), lambda numbers: numbers[1]) == Frame().turned(0.5)
    True
    """
    if frame.z.ndim == 1:
        return frame
    axes = [np.broadcast_to(axis, (*batch, 3)) for axis in (frame.x, frame.y, frame.z)]
    x, y, z = [each_number(axis, change) for axis in axes]
    if is_traced(z):
        raise FrameError(
            "a frame is of numbers, not of an index that JAX traces; bring light to one frame "
            "before, light.in_frame(frame)[i], or look at it outside of jit and grad"
        )
    return Frame.trusted(x, y, z, frame.rounding)
