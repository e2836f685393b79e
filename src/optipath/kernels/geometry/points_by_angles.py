"""Points of a chain out of its angles: incidences, and turns from plane to plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.geometry.vectors import Vector, minus, plus, times

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


@dataclass(frozen=True)
class PointsByAngles:
    """Makes ``(cos, sin of each incidence and then of each turn) -> (x, y, z of each point)``.

    Legs are of length 1. The middle one runs from the origin along the world's z, where the
    points lose no digit of a small angle, and the plane of incidence at its start is the one
    across the world's x.

    Examples
    --------
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> PointsByAngles(1, 0, 2)(FLOAT)(0.0, 1.0)
    (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0)
    """

    reflections: int
    first: int
    last: int
    axes: bool = False
    backwards: bool = False

    @property
    def gives(self) -> int:
        """How many numbers it makes."""
        points = self.last - self.first + 1
        return 3 * (points + (points - 2) * self.axes)

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the function of cosines and sines."""
        del xp
        count, middle = self.reflections, self.reflections // 2
        first, last, order = self.first, self.last, 1
        if self.backwards:
            first, last, order = count + 1 - self.last, count + 1 - self.first, -1

        def points(*numbers: Any) -> tuple[Any, ...]:
            pairs = list(zip(numbers[::2], numbers[1::2], strict=True))
            # By vertex: its incidence, and the turn from the vertex before it to it.
            met = dict(enumerate(pairs[:count], 1))
            turned = dict(enumerate(pairs[count:], 2))
            found, across = {middle: _ORIGIN, middle + 1: _Z}, {}
            light = _Axes(_X, _Y, _Z)
            for vertex in range(middle + 1, last):
                light = light.turned(*turned[vertex]) if vertex in turned else light
                across[vertex] = light.x
                light = light.reflected(*met[vertex])
                found[vertex + 1] = plus(found[vertex], light.z)
            light = _Axes(_X, _Y, _Z)
            for vertex in range(middle, first, -1):
                across[vertex] = light.x
                light = light.before_reflection(*met[vertex])
                found[vertex - 1] = minus(found[vertex], light.z)
                light = light.before_turn(*turned[vertex]) if vertex in turned else light
            wanted = [found[point] for point in range(first, last + 1)][::order]
            if self.axes:
                wanted += [across[vertex] for vertex in range(first + 1, last)][::order]
            return tuple(number for vector in wanted for number in vector)

        return points


class _Axes(NamedTuple):
    """The axes of light on its way, with x across the plane of incidence."""

    x: Vector
    y: Vector
    z: Vector

    def turned(self, c: Any, s: Any) -> _Axes:
        x = plus(times(c, self.x), times(s, self.y))
        return _Axes(x, minus(times(c, self.y), times(s, self.x)), self.z)

    def before_turn(self, c: Any, s: Any) -> _Axes:
        return self.turned(c, -s)

    def reflected(self, c: Any, s: Any) -> _Axes:
        """Return the axes behind a reflection: y and z turned on about x, as light is."""
        twice_c, twice_s = (c - s) * (c + s), 2.0 * s * c
        y = plus(times(twice_c, self.y), times(twice_s, self.z))
        z = minus(times(twice_s, self.y), times(twice_c, self.z))
        return _Axes(self.x, times(-1.0, y), z)

    def before_reflection(self, c: Any, s: Any) -> _Axes:
        """Return the axes before a reflection; the same turn, the other way round."""
        twice_c, twice_s = (c - s) * (c + s), 2.0 * s * c
        y = minus(times(twice_s, self.z), times(twice_c, self.y))
        z = plus(times(twice_c, self.z), times(twice_s, self.y))
        return _Axes(self.x, y, times(-1.0, z))


_ORIGIN: Vector = (0.0, 0.0, 0.0)
_X: Vector = (1.0, 0.0, 0.0)
_Y: Vector = (0.0, 1.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)
