"""The light of a sweep in memory: whole, and what variables are computed of part by part."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.frames import Frame
from optipath.light.light import Light
from optipath.plan.light_noise import noise_at
from optipath.plan.running.pieces import pieces

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_grid import SweepGrid
    from optipath.sweeps.labels.light_quantities import LightQuantity

    Array = np.ndarray[Any, Any]

_AT_ONCE = 1 << 17
"""Of how many lights something is computed at a time: what is made on the way stays small."""


@dataclass(frozen=True, eq=False)
class SweptLight:
    """The light of a run at one detector, as it was computed.

    Shapes: stokes (..., 4); exponent (...).
    """

    plan: Plan
    grid: SweepGrid
    detector: str
    stokes: Any
    exponent: Any

    @property
    def dtype(self) -> np.dtype[Any]:
        """The precision of the plan."""
        return np.dtype(self.plan.dtype)

    @property
    def is_faint(self) -> bool:
        """Whether intensities may be too small for a float."""
        return bool(np.any(self.exponent))

    @property
    def components(self) -> tuple[Array, ...]:
        """S0 to S3, of the shape of the grid: views that cannot be written to."""
        stokes = self.stokes
        if self.is_faint:
            stokes = Light.of(stokes, Frame(), self.exponent).stokes
        parts = stokes if type(stokes) is tuple else np.moveaxis(np.asarray(stokes), -1, 0)
        return tuple(np.broadcast_to(part, self.grid.shape) for part in parts)

    def part(self, region: Sequence[slice]) -> Light:
        """Return the light of a part of what was run, which knows what of it is noise."""
        ran = self.grid.varied
        # Values of the part alone, so that nothing of the whole is looked at for its noise.
        given = ran.given(region)
        noise = (noise_at, self.plan.answers, self.detector, given, ())

        def cut(numbers: Any) -> Array:
            return np.broadcast_to(numbers, ran.shape)[tuple(region)]

        if type(self.stokes) is tuple:
            parts: Any = tuple(map(cut, self.stokes))
        else:
            parts = np.broadcast_to(self.stokes, (*ran.shape, 4))[*region, :]
        return Light.of(parts, Frame(), cut(self.exponent) if self.is_faint else 0, noise)

    def computed(self, quantity: LightQuantity, key: Sequence[int | slice]) -> Array:
        """Return a quantity of a part of the grid."""
        axes = [
            _places(range(size), index) for size, index in zip(self.grid.shape, key, strict=True)
        ]
        whole = tuple(map(len, axes))
        for place, size in enumerate(self.grid.varied.shape):
            if size < self.grid.shape[place]:
                axes[place] = range(min(len(axes[place]), 1))
        shape = tuple(map(len, axes))
        found = np.empty(prod(shape), self.dtype)
        for piece in pieces(shape, _AT_ONCE) if found.size else ():
            where = (*piece.where, *[slice(None)] * (len(axes) - len(piece.where)))
            several = [_places(axis, index) for axis, index in zip(axes, where, strict=True)]
            light = self.part([slice(axis.start, axis.stop, axis.step) for axis in several])
            found[piece.start : piece.stop] = np.ravel(quantity.of(light))
        ends = tuple(slice(None) if isinstance(index, slice) else 0 for index in key)
        found = found.reshape(shape)
        return (found if shape == whole else np.broadcast_to(found, whole).copy())[ends]


def _places(axis: range, index: int | slice) -> range:
    """Return the places of an axis that an index takes."""
    if isinstance(index, slice):
        return axis[index]
    place = axis[index]
    return range(place, place + 1)
