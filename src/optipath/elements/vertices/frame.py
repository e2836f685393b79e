"""The frame of light at a vertex, or beside it, made when somebody looks at it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError
from optipath.kernels.catalogue import ARRIVING, REFLECTED
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.frames import Frame
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.memory import enough_for
from optipath.values.arrays.shapes import joint_shape
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy.typing as npt

    from optipath.elements.vertices.coordinates import Coordinates
    from optipath.values.operands import Operand
    from optipath.values.resolved import Resolved

_THREE_AXES = 72
"""How many bytes the axes of a frame have."""


@dataclass(frozen=True)
class VertexFrame:
    """How light arrives at the last of some vertices, or how it leaves there.

    On its way from there it may be told in a frame that is turned about its direction.
    """

    points: Coordinates
    leaves: bool
    turns: tuple[Operand, ...] = ()

    def turned(self, *turns: Operand) -> VertexFrame:
        """Return the frame turned by more angles."""
        return replace(self, turns=(*self.turns, *turns))

    @property
    def names(self) -> set[str]:
        """The open parameters that it depends on."""
        values = (operand.value for operand in self._views)
        return {v.name for v in values if isinstance(v, Parameter) and not v.bound}

    def frame(self, given: Mapping[str, Resolved], cut: Callable[[Any], Any] = np.asarray) -> Frame:
        """Return the frame: x across the plane of incidence, and turned from there.

        Shape: returns (..., 3).
        """
        if any(operand.traced for operand in self._views) or any(
            is_traced(given[name].value) for name in self.names
        ):
            raise FrameError(
                "a frame is of numbers, not of vertices that JAX traces; look at it outside of "
                "jit and grad"
            )
        points = {id(o): cut(_doubles(o, given)) for o in self.points.operands}
        turns = [cut(_doubles(operand, given)) for operand in self.turns]
        shape = joint_shape(*(number.shape for number in (*points.values(), *turns)))
        with np.errstate(all="ignore"), enough_for(shape, _THREE_AXES, error=FrameError):
            planes = self.points.planes(REFLECTED if self.leaves else ARRIVING)
            axes = planes.numbers(NUMPY, lambda operand: points[id(operand)])
            x, z = (_vectors(axes[start : start + 3], shape) for start in (0, 3))
            y = np.cross(z, x)
            if turns:
                angle = np.asarray(sum(turns))[..., np.newaxis]
                c, s = np.cos(angle), np.sin(angle)
                x, y = c * x + s * y, c * y - s * x
        return Frame.trusted(x, y, z)

    @property
    def _views(self) -> tuple[Operand, ...]:
        return *self.points.operands, *self.turns


def _doubles(operand: Operand, given: Mapping[str, Resolved]) -> npt.NDArray[np.float64]:
    return operand.numbers(given).astype(np.float64, copy=False)


def _vectors(components: Any, shape: tuple[int, ...]) -> Any:
    return np.stack([np.broadcast_to(part, shape) for part in components], axis=-1)
