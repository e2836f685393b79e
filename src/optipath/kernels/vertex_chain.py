"""Light along a chain of vertices: legs, incidences, planes of incidence, Snell's law.

The points of a chain are its start, one per specular reflection, and its end. The surface at a
vertex is perpendicular to the bisector of its two legs.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import nan
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from optipath.kernels.filters import align
from optipath.kernels.vectors import Vector, choice, cross, dot, minus, plus, times

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.primitives import KernelFunction, Primitives


SHORTEST, LONGEST = 1e-70, 1e70
"""The legs whose squares, and those of their products, keep all digits."""

_LEAST, _INVERSE = SHORTEST * SHORTEST, 1.0 / LONGEST


class Leg(NamedTuple):
    """The way from a vertex to the next."""

    along: Vector
    inverse: Any
    unit: Vector


def incidence(xp: Primitives) -> Callable[..., tuple[Any, Any]]:
    """Make ``(x0, y0, z0, ..., z2) -> (cos, sin)``: half |k_out - k_in| and half |k_out + k_in|."""
    along, between = legs(xp), incidence_between(xp)
    return lambda *coordinates: between(*along(points_of(coordinates)))


def incidence_between(xp: Primitives) -> Callable[[Leg, Leg], tuple[Any, Any]]:
    """Make ``(leg before, leg behind) -> (cos, sin)`` of the incidence, as `incidence` has it."""
    sqrt = xp.sqrt

    def met(before: Leg, behind: Leg) -> tuple[Any, Any]:
        across, together = minus(behind.unit, before.unit), plus(behind.unit, before.unit)
        return 0.5 * sqrt(dot(across, across)), 0.5 * sqrt(dot(together, together))

    return met


def points_of(coordinates: Sequence[Any]) -> list[Vector]:
    """Return coordinates in a row as points."""
    rows = range(0, len(coordinates), 3)
    return [(coordinates[i], coordinates[i + 1], coordinates[i + 2]) for i in rows]


def legs(xp: Primitives) -> Callable[..., list[Leg]]:
    """Make ``points, ended -> legs``, not finite if too short or long; straight after an end."""
    sqrt, where, chosen = xp.sqrt, xp.where, choice(xp)

    def between(points: Sequence[Vector], ended: Sequence[Any] = ()) -> list[Leg]:
        results: list[Leg] = []
        for start, end in pairwise(points):
            along = minus(end, start)
            if results and ended:
                along = chosen(ended[len(results) - 1], results[-1].along, along)
            squared = dot(along, along)
            inverse = 1.0 / sqrt(squared)
            # Both limits are 0 in single precision, which has none of the other numbers.
            stored = (squared > _LEAST) & (inverse > _INVERSE)
            inverse = where(stored, inverse, nan)
            results.append(Leg(along, inverse, times(inverse, along)))
        return results

    return between


class Event:
    """The numbers by which kernels tell what happens at a vertex of each path."""

    REFLECTS: ClassVar[float] = 0.0
    REFRACTS: ClassVar[float] = 1.0
    BEHIND: ClassVar[float] = 2.0
    CANNOT: ClassVar[float] = 3.0


def ended(events: Sequence[Any]) -> list[Any]:
    """Return the condition of each vertex that its chain has ended before."""
    return [event == Event.BEHIND for event in events]


def event_at_vertex(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n2, k, event, ..., x0, y0, z0, ...) -> (n1, n2, cos, sin)``.

    Of the last of some vertices: media and angle as `incidence_between` or `refracted` say; NaN
    into an absorbing medium and for an impossible event. Points behind the end of a chain are not
    used.
    """
    where, along = xp.where, legs(xp)
    reflection, refraction = incidence_between(xp), refracted(xp)

    def met(n1: Any, n2: Any, k: Any, *numbers: Any) -> tuple[Any, Any, Any, Any]:
        # Of n vertices there are n events and n + 2 points.
        count = (len(numbers) - 6) // 4
        events, points = numbers[:count], points_of(numbers[count:])
        *_, before, behind = along(points, ended(events))
        refracts = events[-1] == Event.REFRACTS
        both = refraction(n1, n2, before, behind), (n1, n2, *reflection(before, behind))
        m1, m2, c, s = (where(refracts, *two) for two in zip(*both, strict=True))
        cannot = (events[-1] == Event.CANNOT) | (refracts & (k > 0.0))
        return m1, m2, where(cannot, nan, c), where(cannot, nan, s)

    return met


STRAIGHT = 1e-6
"""The deviation between equal media, in radians, up to which light goes straight on."""

_STRAIGHT_IN_SINGLES, _BELOW_SINGLES = 5e-4, 1e-9
"""The same in single precision, thousands of roundings; and what such a 1 does not notice."""

_ROUNDINGS = 2.0**-10
"""One over how many roundings a cosine may be below 0, where light grazes the surface."""


def refraction_at_vertex(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n2, x0, y0, z0, ..., z2) -> (rarer, denser, cos, sin)``."""
    along, met = legs(xp), refracted(xp)
    return lambda n1, n2, *coordinates: met(n1, n2, *along(points_of(coordinates)))


def refracted(xp: Primitives) -> Callable[[Any, Any, Leg, Leg], tuple[Any, Any, Any, Any]]:
    """Make ``(n1, n2, leg before, leg behind) -> (rarer, denser, cos, sin)``.

    Both indices in order, and the angle to the normal in the rarer medium: power carried
    through a boundary is the same from either side (Stokes' relations), and from the rarer one
    nothing cancels near the critical angle. Not a number, where no surface refracts light so.

    By the vector form of Snell's law the normal is along N = n2 k_out - n1 k_in (Glassner, ed.,
    An Introduction to Ray Tracing, Academic Press 1989, ch. 4). With d = k_out - k_in,
    over the denser index, cos |N| = 1 - rarer / denser - d^2 / 2 and sin |N| = |k_in x k_out|.
    """
    sqrt, where, maximum, minimum = xp.sqrt, xp.where, xp.maximum, xp.minimum
    below_rounding = xp.below_rounding

    def met(n1: Any, n2: Any, before: Leg, behind: Leg) -> tuple[Any, Any, Any, Any]:
        rarer, denser = minimum(n1, n2), maximum(n1, n2)
        turned = minus(behind.unit, before.unit)
        squared = dot(turned, turned)
        # Of the points' differences: what is parallel in them comes to 0.
        across = times(behind.inverse * before.inverse, cross(behind.along, before.along))
        sine2 = dot(across, across)
        are_equal = rarer == denser
        cos = (denser - rarer) / denser - 0.5 * squared
        # By its own parts: a deviation that is known to few digits is one angle all the same.
        inverse = 1.0 / sqrt(where(are_equal, 1.0, cos * cos + sine2))
        cos = inverse * cos
        # Light along the normal has no slope of the sine, and needs none.
        slants = sine2 > 0.0
        sin = where(slants, inverse * sqrt(where(slants, sine2, 1.0)), 0.0)
        # Of equal media the surface may stand anyhow.
        grazes = 1.0 + _ROUNDINGS * cos >= 1.0
        cos = where(grazes, maximum(cos, 0.0), nan)
        one = dot(before.unit, before.unit)
        singles = below_rounding(one, _BELOW_SINGLES * one)
        limit = where(singles, _STRAIGHT_IN_SINGLES**2, STRAIGHT * STRAIGHT)
        straight = where(squared <= limit, 1.0, nan)
        return rarer, denser, where(are_equal, straight, cos), where(are_equal, 0.0, sin)

    return met


_PARALLEL = 2.0**-50
"""The sine of twice an incidence below which it is the rounding of the points."""

_PARALLEL_IN_SINGLES = 2.0**-19
"""The same in single precision."""

_NEARLY = 2.0**-26
"""The same below which half of the digits are, so that other knowledge of a plane is better."""


def _met(
    xp: Primitives, *, known: bool = False, events: int = 0
) -> Callable[..., tuple[list[Leg], list[Vector]]]:
    """Make ``([event, ...,] x0, y0, z0, ...) -> legs and the x of each vertex``.

    The points are all from the start of the chain to the one behind the last vertex.
    """
    along, planes = legs(xp), axes(xp)

    def met(*numbers: Any) -> tuple[list[Leg], list[Vector]]:
        vectors = points_of(numbers[events:])
        # Of n vertices there are n + 2 points.
        count = len(vectors) // 2 + 1 if known else len(vectors)
        several = along(vectors[:count], ended(numbers[:events]))
        return several, planes(several, vectors[count:])

    return met


def turn_between_planes(xp: Primitives, *, across: bool = False, **points: Any) -> KernelFunction:
    """Make ``(cos 2a, sin 2a)`` of the turn between the planes of the last two vertices."""
    met, aligned = _met(xp, **points), align(xp)

    def turned(*coordinates: Any) -> tuple[Any, ...]:
        several, (*_, x, new_x) = met(*coordinates)
        z, along = several[-2].unit, dot(x, new_x)
        if across:
            along = along - dot(x, z) * dot(new_x, z)
        return aligned(along, dot(z, cross(x, new_x)))

    return turned


ALONG = 1e-6
"""How far the direction of a world frame may be off that of a leg, as normals may be."""


def turn_to_frame(
    xp: Primitives, *, leaves: bool = False, back: bool = False, **points: Any
) -> KernelFunction:
    """Make ``(cos 2a, sin 2a)`` of the turn from the last vertex to a world frame, or back.

    The x and z of the frame follow the events. Not a number where its z is not along the leg.
    """
    events = points.get("events", 0)
    met, aligned, where, below_rounding = _met(xp, **points), align(xp), xp.where, xp.below_rounding

    def turned(*numbers: Any) -> tuple[Any, ...]:
        own, along = numbers[events : events + 3], numbers[events + 3 : events + 6]
        several, planes = met(*numbers[:events], *numbers[events + 6 :])
        x, z = planes[-1], several[-1 if leaves else -2].unit
        off, one = minus(along, z), dot(z, z)
        limit = where(below_rounding(one, _BELOW_SINGLES * one), _STRAIGHT_IN_SINGLES, ALONG)
        # Next to the normal, x is known to fewer digits than z.
        d = dot(x, own) - dot(x, z) * dot(own, z)
        e = dot(z, cross(own, x) if back else cross(x, own))
        return aligned(where(dot(off, off) <= limit * limit, d, nan), e)

    return turned


def axes_at_vertex(xp: Primitives, *, leaves: bool = False, **points: Any) -> KernelFunction:
    """Make ``(x, z)``, six numbers: how light arrives at the last vertex, or leaves it."""
    met, sqrt = _met(xp, **points), xp.sqrt

    def axes_of(*coordinates: Any) -> tuple[Any, ...]:
        several, planes = met(*coordinates)
        x, z = planes[-1], several[-1 if leaves else -2].unit
        # Next to the normal, where the plane is known to fewer digits than the direction.
        x = minus(x, times(dot(x, z), z))
        return *times(1.0 / sqrt(dot(x, x)), x), *z

    return axes_of


def axes(xp: Primitives) -> Callable[[Sequence[Leg], Sequence[Vector]], list[Vector]]:
    """Make ``(legs, known) -> x at each vertex``: k_out cross k_in, across the plane of incidence.

    Light along the normal, or straight through, takes the known x, or else keeps its own; the first
    of a chain takes one perpendicular to it.
    """
    sqrt, where, chosen = xp.sqrt, xp.where, choice(xp)

    def planes(several: Sequence[Leg], known: Sequence[Vector]) -> list[Vector]:
        least = _NEARLY if known else parallel(several[0].unit)
        result, x = [], (0.0, 0.0, 0.0) if known else perpendicular(several[0].unit)
        for vertex, (before, behind) in enumerate(pairwise(several)):
            # Of the points' differences: what is parallel in them comes to 0.
            across = times(behind.inverse * before.inverse, cross(behind.along, before.along))
            squared = dot(across, across)
            has_plane = squared > least * least
            own = times(1.0 / sqrt(where(has_plane, squared, 1.0)), across)
            x = chosen(has_plane, own, known[vertex] if known else x)
            result.append(x)
        return result

    def parallel(k: Vector) -> Any:
        # By what the rounding of a direction is, the sine that is none.
        one = dot(k, k)
        singles = xp.below_rounding(one, _BELOW_SINGLES * one)
        return where(singles, _PARALLEL_IN_SINGLES, _PARALLEL)

    def perpendicular(k: Vector) -> Vector:
        # What world x leaves of itself across the light, or world y where light goes along x.
        u, v, w = k
        near_x = u * u > 0.5
        across = chosen(
            near_x, (-(u * v), 1.0 - v * v, -(v * w)), (1.0 - u * u, -(u * v), -(u * w))
        )
        return times(1.0 / sqrt(dot(across, across)), across)

    return planes


@dataclass(frozen=True)
class PointsByAngles:
    """Makes ``(cos, sin of each incidence and then of each turn) -> (x, y, z of each point)``.

    Legs are of length 1. The middle one runs from the origin along the world's z, where the points
    lose no digit of a small angle; the plane of incidence at its start is across the world's x.
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

    def __call__(self, _: Primitives) -> KernelFunction:
        """Return the function of cosines and sines."""
        count, middle = self.reflections, self.reflections // 2
        first, last, order = self.first, self.last, 1
        if self.backwards:
            first, last, order = count + 1 - self.last, count + 1 - self.first, -1

        def points(*numbers: Any) -> tuple[Any, ...]:
            pairs = list(zip(numbers[::2], numbers[1::2], strict=True))
            # By vertex: its incidence, and the turn from the vertex before it to it.
            met = dict(enumerate(pairs[:count], 1))
            turned = dict(enumerate(pairs[count:], 2))
            result, across = {middle: _ORIGIN, middle + 1: _Z}, {}
            light = _Axes(_X, _Y, _Z)
            for vertex in range(middle + 1, last):
                light = light.turned(*turned[vertex]) if vertex in turned else light
                across[vertex] = light.x
                light = light.reflected(*met[vertex])
                result[vertex + 1] = plus(result[vertex], light.z)
            light = _Axes(_X, _Y, _Z)
            for vertex in range(middle, first, -1):
                across[vertex] = light.x
                light = light.before_reflection(*met[vertex])
                result[vertex - 1] = minus(result[vertex], light.z)
                if vertex in turned:
                    c, s = turned[vertex]
                    light = light.turned(c, -s)
            wanted = [result[point] for point in range(first, last + 1)][::order]
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

    def reflected(self, c: Any, s: Any) -> _Axes:
        """Return the axes behind a reflection: y and z turned on about x, as light is."""
        twice_c, twice_s = (c - s) * (c + s), 2.0 * s * c
        y = plus(times(twice_c, self.y), times(twice_s, self.z))
        z = minus(times(twice_s, self.y), times(twice_c, self.z))
        return _Axes(self.x, times(-1.0, y), z)

    def before_reflection(self, c: Any, s: Any) -> _Axes:
        """Return the axes before a reflection; the same turn, the other way round."""
        x, z, y = _Axes(self.x, self.z, self.y).reflected(c, s)
        return _Axes(x, y, z)


_ORIGIN: Vector = (0.0, 0.0, 0.0)
_X: Vector = (1.0, 0.0, 0.0)
_Y: Vector = (0.0, 1.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)
