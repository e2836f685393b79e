"""The frame of light at a vertex, made when somebody looks at it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import FrameError
from optipath.frames import Frame
from optipath.jax_values import is_traced
from optipath.kernels import ARRIVING, NUMPY, REFLECTED
from optipath.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.parameters import Resolved
    from optipath.vertices.coordinates import Coordinates


@dataclass(frozen=True)
class VertexFrame:
    """How light arrives at the last of some vertices, or how it leaves there.

    Attributes
    ----------
    points : Coordinates
        From the start of the chain to the point behind the vertex.
    leaves : bool
        Whether the frame is that of the reflected light.
    """

    points: Coordinates
    leaves: bool

    @property
    def names(self) -> set[str]:
        """The open parameters that it depends on."""
        values = (view.value for view in self.points.arguments)
        return {v.name for v in values if isinstance(v, Parameter) and not v.bound}

    def frame(self, given: Mapping[str, Resolved]) -> Frame:
        """Return the frame, with x across the plane of incidence.

        Raises
        ------
        FrameError
            If JAX traces the vertices.
        """
        if any(view.traced for view in self.points.arguments) or any(
            is_traced(given[name].value) for name in self.names
        ):
            raise FrameError(
                "a frame is of numbers, not of vertices that JAX traces; look at it outside of "
                "jit and grad"
            )
        numbers = [view.numbers(given) for view in self.points.arguments]
        axes = self.points.factory(REFLECTED if self.leaves else ARRIVING)(NUMPY)(*numbers)
        shape = np.broadcast_shapes(*(number.shape for number in numbers))
        x, z = (_vectors(axes[start : start + 3], shape) for start in (0, 3))
        return Frame.trusted(x, np.cross(z, x), z)


def _vectors(components: Any, shape: tuple[int, ...]) -> Any:
    return np.stack([np.broadcast_to(part, shape) for part in components], axis=-1)
