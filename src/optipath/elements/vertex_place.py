"""A vertex in its chain: its place, frames, normals, and whether Snell's law holds there."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.elements.vertex_chain import (
    VerticesByAngles,
    of_chain,
    pieces_of,
    refuse_changed,
)
from optipath.errors import FrameError, ValueFault
from optipath.faults import shown
from optipath.kernels.catalog import ARRIVING, EVENT_AT_VERTEX, INCIDENCE, REFLECTED, TURN_TO_FRAME
from optipath.kernels.kernel import Kernel
from optipath.kernels.primitives import NUMPY, Made, of_module
from optipath.kernels.vectors import dot, minus
from optipath.kernels.vertex_chain import (
    ALONG,
    LONGEST,
    SHORTEST,
    Event,
    PointsByAngles,
    points_of,
)
from optipath.light.frame import Frame
from optipath.materials.quantities import Quantity
from optipath.values.agreement import Agreement, text_of
from optipath.values.arrays import (
    check_broadcast,
    enough_for,
    joint_shape,
    same,
)
from optipath.values.curve_value import CurveValue, parameters_among
from optipath.values.domains import Domain
from optipath.values.jax_values import is_traced, namespace
from optipath.values.operands import Operand, Operation
from optipath.values.parameters import Parameter
from optipath.values.precision import as_doubles, is_whole, rounding_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import numpy.typing as npt

    from optipath.kernels.primitives import KernelFunction, Primitives
    from optipath.values.operands import ResultOf
    from optipath.values.parameters import Resolved

    Floats = npt.NDArray[np.float64]


_MOST = (1 << 31) - 1
_DOUBLE = np.dtype(np.float64)


@dataclass(frozen=True, eq=False)
class PlaceInChain:
    """Which vertex of a chain, as somebody says it; it may be none."""

    vertices: Any
    number: Any
    told: Any
    counted_by: str

    @property
    def count(self) -> int:
        """How many vertices there are; 0 where nothing says so."""
        if isinstance(self.vertices, VerticesByAngles):
            return len(self.vertices.incidences)
        if is_whole(self.told, most=_MOST):
            return int(self.told)
        value = self.vertices
        value = value.default if isinstance(value, Parameter) else value
        shape: tuple[int, ...] = getattr(value, "shape", ())
        return max(shape[-2] - 2, 0) if len(shape) > 1 else 0

    @property
    def tail(self) -> tuple[int, int]:
        """The axes of the points of one chain."""
        return max(self.count, 1) + 2, 3

    def faults(self, owner: str) -> list[str]:
        """Return what is wrong with the numbers, a sentence each."""
        result, name = [], self.counted_by
        if self.told is not None and not is_whole(self.told, most=_MOST):
            result.append(f"{owner}.{name} must be a whole number above 0, not {shown(self.told)}")
        elif not self.count and isinstance(self.vertices, Parameter):
            result.append(
                f"{owner}.vertices is a parameter without a default; tell the number of "
                f"{'vertices' if name == 'count' else name} of the chain, {name}=..."
            )
        if not is_whole(self.number, most=self.count or _MOST):
            up_to = f" of 1 .. {self.count}" if self.count else " above 0"
            argument = "a parameter" if isinstance(self.number, Parameter) else shown(self.number)
            result.append(f"{owner}.place must be a whole number{up_to}, not {argument}")
        return result

    @property
    def at(self) -> int:
        """The number; 1 or the last where it is no place, which is told as a fault."""
        return min(self.number if is_whole(self.number) else 1, max(self.count, 1))

    def points(self, *, around: bool = False) -> Coordinates:
        """Return the vertex between its neighbours; or all points up to the one behind it."""
        first, last = self.at - 1 if around else 0, self.at + 1
        if isinstance(self.vertices, VerticesByAngles):
            angles = [angle for _, angle, _ in self.vertices.parts("")]
            operands = tuple(Operand(angle, part) for angle in angles for part in ("cos", "sin"))
            backwards = self.vertices.backwards
            points = PointsByAngles(self.count, first, last, backwards=backwards)
            return Coordinates(operands, points)
        places = range(3 * first, 3 * last + 3)
        return Coordinates(tuple(Operand(self.vertices, at, self.tail) for at in places))


def same_points(first: Any, second: Any) -> bool:
    """Tell whether two chains are equal; points that are not finite are, where they stand alike."""
    if same(first, second):
        return True
    kinds = {getattr(chain, "dtype", None) for chain in (first, second)}
    return kinds == {_DOUBLE} and np.array_equal(first, second, equal_nan=True)


class Coordinates(NamedTuple):
    """Points of a chain: what is given of them, and what makes coordinates of it."""

    arguments: tuple[Operand, ...]
    points: PointsByAngles | None = None
    events: tuple[Operand, ...] = ()

    @property
    def operands(self) -> tuple[Operand, ...]:
        """All that is given of them."""
        return *self.events, *self.arguments

    def passed_to(self, kernel: Kernel, *before: Any) -> Operation:
        """Return the operation of a kernel of coordinates, with the events before them."""
        return Operation(kernel, (*before, *self.events, *self._coordinates(self.points)))

    def planes(self, kernel: Kernel, *frame: Operand, **how: Any) -> Operation:
        """Return the operation of a kernel of planes of incidence, by points, or else by angles."""
        points, events, known = self.points, self.events, how | {"events": len(self.events)}
        if points is not None:
            points, events, known = replace(points, axes=True), (), how | {"known": True}
        factory: Any = kernel.factory
        made = Made(factory.func, **factory.keywords, **known)
        arguments = *events, *frame, *self._coordinates(points)
        return Operation(replace(kernel, factory=made), arguments)

    def _coordinates(self, points: PointsByAngles | None) -> tuple[Operand | ResultOf, ...]:
        if points is None:
            return self.arguments
        return Operation(Kernel("points", None, points), self.arguments).results(points.gives)


@dataclass(frozen=True)
class EventsDomain(Domain):
    """A number of an `Event` for each vertex of a chain."""

    takes_parameters = False

    def described(self) -> str:
        return (
            "0 where light is reflected, 1 where it is refracted, 2 behind the end of a chain, or "
            "3 where there is no such chain"
        )

    def allows(self, numbers: Any) -> Any:
        events = (Event.REFLECTS, Event.REFRACTS, Event.BEHIND, Event.CANNOT)
        return namespace(numbers).isin(numbers, np.array(events))


EVENTS = EventsDomain("event", minimum=Event.REFLECTS, maximum=Event.CANNOT)
Events: TypeAlias = Annotated[Quantity, EVENTS]


_MORE = 1.0 + 2.0**-20
_LEAST, _MOST_SINGLE = _MORE * SHORTEST**2, LONGEST**2 / _MORE


@dataclass(frozen=True, eq=False)
class EventFits(Agreement):
    """Light can go from point to point as the event at a vertex says.

    The operands are the event, n in front, n and k behind, and the coordinates of three points.
    """

    owner: str

    shows_in_light = True

    def fits(self, xp: Any, *numbers: Any) -> Any:
        if xp is not np:
            return _fits(xp, *numbers)
        result = _surely_fits(*numbers)
        if not np.all(result):
            left = ~result
            result[left] = _fits(np, *(np.broadcast_to(n, left.shape)[left] for n in numbers))
        return result

    def sentence(self, *numbers: float) -> str:
        event, n1, n2, k, *points = numbers
        others = "give others, or bad='mask', by which the light of such chains is NaN"
        if event == Event.CANNOT:
            return f"there is no such chain, says the event at '{self.owner}'; {others}"
        three = np.reshape(points, (3, 3))
        with np.errstate(all="ignore"):
            lengths = np.max(np.abs(np.diff(three, axis=0)), axis=-1)
        if not np.all((lengths > SHORTEST) & (lengths < LONGEST)):
            return (
                f"the points around '{self.owner}' are {three.tolist()}; they must be finite, "
                f"and legs within {SHORTEST:g} .. {LONGEST:g}: {others}"
            )
        if k > 0.0:
            return (
                f"light is refracted at '{self.owner}' into a medium that absorbs, k = {k:g}; let "
                f"it be reflected there (R for T), {others}"
            )
        before, behind = map(text_of, self.operands[1:3], (n1, n2))
        most = math.degrees(math.acos(min(n1, n2) / max(n1, n2)))
        allowed = f"turns it by {most:.9g} deg at most" if most else "lets it go straight on"
        return (
            f"light is turned by {deviation(points):.9g} deg at '{self.owner}', but a refraction "
            f"from n = {before} into n = {behind} {allowed}; move the points, or give other "
            f"media, an event R in place of T, a specular vertex, or bad='mask'"
        )


def _fits(xp: Any, *numbers: Any) -> Any:
    event, n1, n2, k, *points = numbers
    *_, cos, _ = EVENT_AT_VERTEX.made_for(of_module(xp))(n1, n2, k, event, *points)
    # Indices that are none are told elsewhere.
    unsound = ~((n1 > 0.0) & (n2 > 0.0) & xp.isfinite(n1 + n2))
    return ~xp.isnan(cos) | (event == Event.BEHIND) | unsound


def goes_along(xp: Primitives) -> KernelFunction:
    """Make ``(n, event, n, k, event, ..., x0, y0, z0, ...) -> conditions``, one for each vertex.

    The first n is that in front; each is that light can go so, and that n is sound.
    """
    met = EVENT_AT_VERTEX.made_for(xp)

    def conditions(front: Any, *numbers: Any) -> tuple[Any, ...]:
        count = (len(numbers) - 6) // 6
        points, results = numbers[3 * count :], []
        for at in range(count):
            event, n, k = numbers[3 * at : 3 * at + 3]
            *_, cos, _ = met(front, n, k, event, *points[3 * at : 3 * at + 9])
            refracts = event == Event.REFRACTS
            sound = (event != Event.REFRACTS) | ((front > 0.0) & (n > 0.0))
            # No cosine is 2, and none that is NaN is less.
            results.append(((cos < 2.0) & sound) | (event == Event.BEHIND))
            front = xp.where(refracts, n, front)
        return tuple(results)

    return conditions


def _surely_fits(event: Any, n1: Any, n2: Any, k: Any, *points: Any) -> Any:
    """Return where light can go so by a margin, as nearly all does: by products alone."""
    start, here, end = points_of(points)
    before, behind = minus(here, start), minus(end, here)
    with np.errstate(over="ignore", invalid="ignore"):
        squares = dot(before, before), dot(behind, behind)
        product = squares[0] * squares[1]
        along = dot(before, behind)
        # Light may be turned by arccos(rarer / denser) at most.
        is_turned_less = np.maximum(n1, n2) * along > _MORE * np.minimum(n1, n2) * np.sqrt(product)
    fits = (event == Event.REFLECTS) | ((event == Event.REFRACTS) & (k == 0.0) & is_turned_less)
    for square in squares:
        fits &= (square > _LEAST) & (square < _MOST_SINGLE)
    return np.atleast_1d(fits | (event == Event.BEHIND))


def deviation(points: Any) -> float:
    """Return by how many degrees light is turned at the middle of three points."""
    half, across = INCIDENCE.made_for(of_module(np))(*map(np.float64, points))
    return 2.0 * math.degrees(math.atan2(half, across))


_TOLERANCE = 1e-6
_SURELY = 0.5
"""The part of the square of the tolerance that the rounding of a quick look leaves."""

_STRAIGHT = 1e-7
"""A bisector shorter than this is known to fewer digits than normals are checked to."""


def off_normals(
    chains: Floats, normals: npt.NDArray[Any], sides: Floats
) -> tuple[npt.NDArray[np.bool_], str]:
    """Return which chains (...) have normals (..., m, 3) off those of their vertices, in words too.

    A reflection's is along k_out - k_in, a refraction's along n2 k_out - n1 k_in; between equal
    media any will do. `sides` (..., m, 2) are n1 and n2.
    """
    count = chains.shape[-2] - 2
    if normals.dtype.kind not in "iuf":
        raise ValueFault(f"normals must be real numbers, not {shown(normals)}")
    if normals.shape[-2:] != (count, 3):
        raise ValueFault(f"normals must have shape (..., {count}, 3), not {normals.shape}")
    tolerance = max(_TOLERANCE, 2.0 * rounding_of(normals))
    normals = as_doubles(normals)
    _refuse_no_normals(normals)
    several = {"vertices": chains, "normals": normals, "materials": sides}
    batch = check_broadcast({name: each.shape[:-2] for name, each in several.items()})
    whole = [
        np.broadcast_to(each, (*batch, *each.shape[-2:])).reshape(-1, *each.shape[-2:])
        for each in several.values()
    ]
    far, worst, sentence = np.zeros(len(whole[0]), bool), tolerance, ""
    for piece in pieces_of(len(far)):
        part = [each[piece] for each in whole]
        if _surely_along(*part):
            continue
        with np.errstate(all="ignore"):
            off = np.nan_to_num(_off(*part))  # Points that are not finite are told elsewhere.
        far[piece] = np.any(off > tolerance, axis=-1)
        chain, place = map(int, np.unravel_index(np.argmax(off), off.shape))
        if off[chain, place] > worst:
            worst = float(off[chain, place])
            n1, n2 = part[2][chain, place]
            wanted = "the bisector of its legs" if n1 == n2 else "the one that refracts light so"
            sentence = (
                f"{_normal_of(place, piece.start + chain, batch)} is off {wanted} by "
                f"{np.degrees(worst):.3g} deg; it must be along it to within {tolerance:.2g} rad, "
                f"or be left out"
            )
    return far.reshape(batch), sentence


def _refuse_no_normals(normals: Floats) -> None:
    """Refuse what is no direction, whatever the chain."""
    for bad, problem in (
        (~np.isfinite(normals).all(axis=-1), "is not finite; give numbers"),
        (~normals.any(axis=-1), "has no length; give one with a direction of its own"),
    ):
        if bad.any():
            several = bad.reshape(-1, bad.shape[-1])
            chain, place = (int(index[0]) for index in np.nonzero(several))
            raise ValueFault(f"{_normal_of(place, chain, normals.shape[:-2])} {problem}")


def _normal_of(place: int, chain: int, batch: tuple[int, ...]) -> str:
    return f"the normal of vertex {place + 1}{of_chain(chain, batch)}"


def _surely_along(chains: Floats, normals: Floats, sides: Floats) -> bool:
    """Tell, by sin^2 = 1 - cos^2, whether all normals are along their vertices beyond doubt."""
    # Component by component, each for all chains: sums of rows, and no short last axis.
    points, n, n12 = (
        np.ascontiguousarray(np.moveaxis(each, 0, -1)) for each in (chains, normals, sides)
    )
    with np.errstate(all="ignore"):
        legs = points[1:] - points[:-1]
        legs /= np.sqrt(np.sum(legs * legs, axis=1))[:, np.newaxis]
        b = legs[1:] * n12[:, 1, np.newaxis] - legs[:-1] * n12[:, 0, np.newaxis]
        bb, nn, nb = (np.sum(u * v, axis=1) for u, v in ((b, b), (n, n), (n, b)))
        nb *= nb
        bent = bb >= _STRAIGHT * _STRAIGHT
        return bool(np.all((nn * bb - nb <= _SURELY * _TOLERANCE**2 * nb) & bent & (nb > 0.0)))


def _off(chains: Floats, normals: Floats, sides: Floats) -> Floats:
    """Return the angles between normals and those of vertices; none where light goes straight."""
    unit = _units(np.diff(chains, axis=-2))
    normal, (n1, n2) = _units(normals), np.moveaxis(sides, -1, 0)
    bisector = n2[..., np.newaxis] * unit[..., 1:, :] - n1[..., np.newaxis] * unit[..., :-1, :]
    along = np.abs(np.sum(normal * bisector, axis=-1))
    angle = np.arctan2(np.linalg.norm(np.cross(normal, bisector), axis=-1), along)
    straight = np.linalg.norm(bisector, axis=-1) < _STRAIGHT
    through = np.arcsin(np.minimum(np.abs(np.sum(normal * unit[..., 1:, :], axis=-1)), 1.0))
    grazes = np.where((n1 == n2) & (n1 > 0.0), through, 0.0)
    return np.asarray(np.where(straight, grazes, angle))


def _units(several: Floats) -> Floats:
    scaled = several / np.max(np.abs(several), axis=-1, keepdims=True)
    return np.asarray(scaled / np.linalg.norm(scaled, axis=-1, keepdims=True))


_THREE_AXES = 72
"""How many bytes the axes of a frame have."""


@dataclass(frozen=True)
class VertexFrame:
    """The frame of light at the last of some vertices, on arrival or departure, or turned."""

    points: Coordinates
    leaves: bool
    turns: tuple[Operand, ...] = ()

    def turned(self, *turns: Operand) -> VertexFrame:
        """Return the frame turned by more angles."""
        return replace(self, turns=(*self.turns, *turns))

    @property
    def axes(self) -> Operation:
        """The x and z of the frame before it is turned."""
        return self.points.planes(REFLECTED if self.leaves else ARRIVING)

    def turn_to(self, frame: Frame, *, back: bool = False) -> Operation:
        """Return the turn from this frame, before it is turned, to a world frame, or back."""
        axes = (Operand(axis, place, (3,)) for axis in (frame.x, frame.z) for place in range(3))
        return self.points.planes(TURN_TO_FRAME, *axes, leaves=self.leaves, back=back)

    @property
    def names(self) -> set[str]:
        """The open parameters that it depends on."""
        several = parameters_among([operand.value for operand in self._views])
        return {p.name for p in several if not (p.bound or isinstance(p, CurveValue))}

    def refuse_changed(self) -> None:
        """Raise where its points are no longer those of which the path was made."""
        refuse_changed(self.points.arguments[0].value)

    def frame(
        self, arguments: Mapping[str, Resolved], cut: Callable[[Any], Any] = np.asarray
    ) -> Frame:
        """Return the frame: x across the plane of incidence, and turned from there."""
        self.refuse_changed()
        if any(operand.traced for operand in self._views) or any(
            is_traced(arguments[name].value) for name in self.names
        ):
            raise FrameError(
                "a frame is of numbers, not of vertices that JAX traces; look at it outside of "
                "jit and grad"
            )
        numbers = {
            id(o): cut(o.numbers(arguments).astype(np.float64, copy=False)) for o in self._views
        }
        shape = joint_shape(*(number.shape for number in numbers.values()))
        with np.errstate(all="ignore"), enough_for(shape, _THREE_AXES, error=FrameError):
            axes = self.axes.numbers(NUMPY, lambda operand: numbers[id(operand)])
            whole = [np.broadcast_to(part, shape) for part in axes[:6]]
            x, z = np.stack(whole[:3], axis=-1), np.stack(whole[3:], axis=-1)
            y = np.cross(z, x)
            if self.turns:
                angle = np.asarray(sum(numbers[id(turn)] for turn in self.turns))[..., np.newaxis]
                c, s = np.cos(angle), np.sin(angle)
                x, y = c * x + s * y, c * y - s * x
        return Frame.trusted(x, y, z)

    @property
    def _views(self) -> tuple[Operand, ...]:
        return *self.points.operands, *self.turns


@dataclass(frozen=True, eq=False)
class AlongLeg(Agreement):
    """A world frame beside a vertex travels along the leg there.

    The operands are the z of the frame, and what the leg is made of.
    """

    link: str
    leg: Operation = field(compare=False)

    shows_in_light = True

    @classmethod
    def of(cls, link: str, frame: Frame, vertex: VertexFrame) -> AlongLeg:
        """Return it for the frame on one side of a link and the vertex on the other."""
        z = (Operand(frame.z, place, (3,)) for place in range(3))
        return cls((*z, *vertex.axes.operands()), link, vertex.axes)

    def fits(self, xp: Any, *numbers: Any) -> Any:
        off = minus(numbers[:3], self._along(xp, numbers))
        # Points that are not finite are told elsewhere.
        return ~(dot(off, off) > ALONG**2)

    def sentence(self, *numbers: float) -> str:
        own, along = (
            "(" + ", ".join(f"{float(n) + 0.0:.6g}" for n in vector) + ")"
            for vector in (numbers[:3], self._along(np, tuple(map(np.float64, numbers))))
        )
        return (
            f"link '{self.link}': light travels along {along}, and the world frame along {own}; "
            f"give Frame.from_direction(z, x) with the z of the light"
        )

    def _along(self, xp: Any, numbers: tuple[Any, ...]) -> Any:
        """Return the direction of the leg."""
        argument = dict(zip(map(id, self.operands[3:]), numbers[3:], strict=True))
        return self.leg.numbers(of_module(xp), lambda operand: argument[id(operand)])[3:6]
