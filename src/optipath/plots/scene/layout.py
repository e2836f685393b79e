"""Scenes: a path laid out in space, every value a number, with its angles as arcs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.media import with_followed
from optipath.composer.placement import azimuth_of
from optipath.composer.port_frames import PortFrames
from optipath.composer.wiring import Wiring
from optipath.elements.boundary import BoundaryElement
from optipath.elements.vertex_chain import VerticesByAngles
from optipath.elements.vertices import ChainVertex
from optipath.errors import PathError
from optipath.materials.quantities import plain
from optipath.plots.light_texts import ellipse_points, lights_of_one
from optipath.plots.scene.placing import (
    DrawnLink,
    Placing,
    angles_at,
    has_axis,
    incidence_at,
    number,
)
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from optipath.composer.wiring import Link
    from optipath.elements.element import Element
    from optipath.light.light import Light
    from optipath.paths.energy import LightOnLink
    from optipath.paths.path_graph import PathGraph
    from optipath.values.precision import Numbers


class SceneNode(NamedTuple):
    """An element where it stands. Shapes: at (3,); normal, across (3,); axis (3,)."""

    name: str
    kind: str
    at: Numbers
    normal: Numbers | None
    across: Numbers | None
    role: str
    element: Element
    axis: Numbers | None


class SceneRay(NamedTuple):
    """The light of a link, or what leaves the path; tail, head (3,), ellipse (points, 3)."""

    name: str
    start: str
    end: str
    tail: Numbers
    head: Numbers
    axes: Numbers
    ellipse: Numbers | None
    light: Light
    leaves: bool
    tap: bool

    @property
    def turns(self) -> bool:
        """Whether its field turns, and is no line."""
        return self.ellipse is not None and bool(self.light.handedness)

    @property
    def is_dark(self) -> bool:
        """Whether there is no light, but for rounding."""
        return bool(np.isnan(self.light.dop))


class SceneAngle(NamedTuple):
    """An angle that has a name. Shapes: arc (points, 3); at (3,); centre (3,)."""

    name: str
    text: str
    arc: Numbers
    at: Numbers
    centre: Numbers
    about: str


class Scene(NamedTuple):
    """A path laid out in space.

    Planes of incidence are rectangles (4, 3) by nodes; frames a point (3,), axes (3, 3) by ports.
    """

    notes: tuple[str, ...]
    unit: float
    nodes: tuple[SceneNode, ...]
    rays: tuple[SceneRay, ...]
    planes: dict[str, Numbers]
    frames: dict[str, tuple[Numbers, Numbers]]
    angles: tuple[SceneAngle, ...]

    def as_json(self) -> dict[str, Any]:
        """Return what the page draws, for `json.dumps`; no NaN among it."""
        return {
            "notes": [*self.notes],
            "nodes": [
                _fields(node, "name", "kind", "at", "normal", "across", "role")
                for node in self.nodes
            ],
            "rays": [
                {
                    **_fields(ray, "name", "ellipse", "leaves", "tap"),
                    "from": _list(ray.tail),
                    "to": _list(ray.head),
                    "intensity": plain(float(ray.light.intensity)),
                }
                for ray in self.rays
            ],
            "planes": [{"corners": _list(corners)} for corners in self.planes.values()],
            "frames": [
                {"at": _list(at), "x": _list(axes[0]), "y": _list(axes[1])}
                for at, axes in self.frames.values()
            ],
            "angles": [_fields(angle, "text", "arc", "at") for angle in self.angles],
        }


def _fields(record: Any, *names: str) -> dict[str, Any]:
    values = {name: getattr(record, name) for name in names}
    return {name: _list(v) if isinstance(v, np.ndarray) else v for name, v in values.items()}


def _list(numbers: Numbers) -> Any:
    return (np.asarray(numbers, float) + 0.0).tolist()


_SAME_ANGLE = 1e-9
"""By how much angles differ that are the same but for rounding, in radians."""


class ShownValue(NamedTuple):
    """A value of a path by its name, and whether there is one."""

    name: str
    text: str
    there: bool = True


def quantity_text(value: float, unit: str) -> str:
    """Return a value in base units as pictures write it: five digits, and the unit.

    >>> quantity_text(-0.0, "deg"), quantity_text(1.164278e-3, "um")
    ('0 deg', '1164.3 um')
    """
    return f"{in_unit(value, unit) + 0.0:.5g} {unit}".strip()


def shown_value(value: Any, unit: str = "deg") -> ShownValue:
    """Return a value by the name of its parameter, or the formula of a multiple."""
    if not isinstance(value, Parameter):
        return ShownValue("", quantity_text(number(value), unit))
    if not bool(Operand(value, "present").numbers()):
        return ShownValue(value.name, f"{value.name} = none", there=False)
    text = quantity_text(number(value), value.unit or unit)
    return ShownValue(value.formula, f"{value.formula} = {text}")


def shown_incidence(value: Any, front: float) -> ShownValue:
    """Return the incidence in radians at a surface, by its name if it is given."""
    message = shown_value(value)
    if message.name and abs(number(value) - front) <= _SAME_ANGLE:
        return message
    front = front if front > _SAME_ANGLE else 0.0
    return ShownValue("incidence", f"incidence = {quantity_text(front, 'deg')}")


LARGEST_ELLIPSE = 0.18
"""How far the ellipse of wholly polarised light reaches from the ray, of the length of a link."""

_LEAVING = 0.5
"""How long light that leaves the path is drawn, of the length of a link."""

_NO_PLANE, _NARROWEST = 1e-6, 0.3
"""The sine of an incidence that has no plane, and how far a plane reaches at least."""

_FRAMES_AT = 0.2
"""How far from its node the frame of a port is drawn."""


def scene_of(
    path: PathGraph, what: str = "a scene", lights: Sequence[LightOnLink] = (), /, **values: Any
) -> Scene:
    """Return a path laid out in space, with its lights if they are known.

    World frames and chain points are kept. All else is laid out by following the light from its
    source, in the frames of docs/conventions.md: x of a surface is along k_out cross k_in.
    """
    lights = lights_of_one(path, what, values, lights)
    parameters = path.parameters.items()
    defaults = {n: p.default for n, p in parameters if not p.bound and p.default is not None}
    path = path.bind(**{**defaults, **values})
    for each in lights:
        if not np.isfinite(each.light.stokes).all():
            raise PathError(
                f"{what} draws light, which is not a number on '{each.name}'; give other values"
            )
    wiring = Wiring(with_followed(path.graph)[0], keep="all")
    placing = Placing(wiring)
    rays = tuple(_ray(placing, each) for each in lights)
    lengths = "lengths are chosen: each link is drawn 1 long"
    notes = [] if wiring.self_placed and not placing.by_angles else [lengths]
    names = dict.fromkeys([*(name for name, _ in wiring.order), *placing.at])
    return Scene(
        notes=(*notes, *placing.notes),
        unit=placing.unit,
        nodes=tuple(_node(placing, name) for name in names),
        rays=rays,
        planes=_planes(placing, rays),
        frames=_frames(placing, lights),
        angles=tuple(_angles(placing)),
    )


def _node(placing: Placing, name: str) -> SceneNode:
    posture, element = placing.postures[name], placing.wiring.elements[name]
    axis = None
    if posture.role == "plate" and has_axis(element):
        angle = element.angle  # type: ignore[attr-defined]
        if shown_value(angle).there:
            x, y, _ = posture.axes["in"].T
            axis = np.cos(number(angle)) * x + np.sin(number(angle)) * y
    stands = placing.at[name], posture.normal, posture.across
    return SceneNode(name, element.kind, *stands, posture.role, element, axis)


def _ray(placing: Placing, each: LightOnLink) -> SceneRay:
    drawn = drawn_link(placing, each)
    rows, dop, ellipse = drawn.axes.T, float(each.light.dop), None
    if dop > 1e-9:  # Of NaN as well it is not told.
        points = ellipse_points(each.light, 49) * (LARGEST_ELLIPSE * placing.unit * min(dop, 1.0))
        ellipse = points @ rows[:2]
    ends = each.name, each.start, each.end, drawn.tail, drawn.head
    return SceneRay(*ends, rows, ellipse, each.light, not each.end, each.tap)


def drawn_link(placing: Placing, each: LightOnLink) -> DrawnLink:
    """Return where the light of a link, or of an outlet, is drawn."""
    if each.end:
        return placing.links[each.start, each.end, (each.leaves, each.enters)]
    axes = placing.postures[each.start].axes[each.leaves]
    tail = placing.tail_of(each.start, each.leaves)
    return DrawnLink(tail, tail + _LEAVING * placing.unit * axes[:, 2], axes)


def _planes(placing: Placing, rays: tuple[SceneRay, ...]) -> dict[str, Numbers]:
    """Return a rectangle for each plane of incidence, which reaches as far as the links."""
    results = {}
    for name, element in placing.wiring.elements.items():
        posture, at = placing.postures[name], placing.at[name]
        if not isinstance(element, BoundaryElement | ChainVertex) or posture.normal is None:
            continue
        ends = [ray.tail for ray in rays if ray.end == name and np.allclose(ray.head, at)]
        ends += [ray.head for ray in rays if ray.start == name and not ray.leaves]
        across = np.cross(np.asarray(posture.across), posture.normal)
        least = _NARROWEST * placing.unit
        wide = max([least, *(abs(float((end - at) @ across)) for end in ends)])
        heights = [float((end - at) @ posture.normal) for end in ends]
        side, top = wide * across, max([least, *heights]) * posture.normal
        foot = min([0.0, *heights]) * posture.normal
        if abs(posture.axes["in"][:, 2] @ across) > _NO_PLANE:
            corners = np.array([foot - side, foot + side, top + side, top - side])
            results[name] = at + corners
    return results


def _frames(placing: Placing, lights: Iterable[LightOnLink]) -> dict[str, tuple[Numbers, Numbers]]:
    """Return the frames of the ports that light passes, beside their nodes."""
    results: dict[str, tuple[Numbers, Numbers]] = {}
    for each in lights:
        drawn, aside = drawn_link(placing, each), _FRAMES_AT * placing.unit
        away = aside * drawn.axes[:, 2]
        results.setdefault(f"{each.start}.{each.leaves}", (drawn.tail + away, drawn.axes.T))
        if each.end:
            axes = placing.axes_entering((each.start, each.end, (each.leaves, each.enters)))
            results.setdefault(f"{each.end}.{each.enters}", (drawn.head - away, axes.T))
    return results


_AT_SURFACE, _ABOUT_RAY, _ON_PLATE = 0.32, 0.3, 0.3
"""How large arcs are, of the length of a link."""

_SEEN = np.radians(1.0)
"""The least angle that is seen as one."""

_OF_AXES = "angle", "dichroic_angle"
"""The fields of elements that say how an axis stands to x, or by how much light is turned."""


def _angles(placing: Placing) -> Iterator[SceneAngle]:
    """Yield the angles of a path that have names, node by node as light travels."""
    for name in dict.fromkeys(name for name, _ in placing.wiring.order):
        for link in placing.links:
            if link[1] == name:
                yield from _azimuths(placing, link)
        element = placing.wiring.elements[name]
        if isinstance(element, BoundaryElement | ChainVertex):
            yield from _incidences(placing, name, element)
        elif placing.postures[name].role == "plate":
            yield from _plate_axes(placing, name, element)


def _incidences(placing: Placing, name: str, element: Any) -> Iterator[SceneAngle]:
    """Yield the angle between the light that arrives and the normal, or that is given behind."""
    posture, at = placing.postures[name], placing.at[name]
    normal: Any = posture.normal
    front = incidence_at(element, posture)
    value: Any = front
    if not isinstance(element, ChainVertex):
        value = element.incidence
        _, behind = angles_at(element)
        argument = number(value) if isinstance(value, Parameter) else front
        if abs(argument - front) > 1e-9 and abs(argument - behind) < 1e-9:
            out, size = posture.axes["transmitted"][:, 2], _AT_SURFACE * placing.unit
            yield _arc(shown_value(value), at, -normal, out, behind, size)
    elif (argument := angles_in_chain(element)[0]) is not None:
        value = argument
    message = shown_incidence(value, front)
    arriving = -posture.axes["in"][:, 2]
    yield _arc(message, at, normal, arriving, front, _AT_SURFACE * placing.unit)


def _azimuths(placing: Placing, link: Link) -> Iterator[SceneAngle]:
    """Yield the turn of the frame that light enters in against that in which it left."""
    wiring, value = placing.wiring, azimuth_of(placing.wiring, link)
    if link[0] in wiring.self_placed and link[1] in wiring.self_placed:
        _, value = angles_in_chain(wiring.elements[link[1]])
    if isinstance(value, Parameter):
        message = shown_value(value.alone() if value.is_signed else value)
    elif abs(value := float(PortFrames(wiring).turn(link))) > _SEEN:
        message = ShownValue("turn", f"turn = {quantity_text(value, 'deg')}")
    else:
        return
    drawn = placing.links[link]
    is_surface = placing.postures[link[1]].role == "surface"
    first, second = (drawn.axes[:, 1], -drawn.axes[:, 0]) if is_surface else drawn.axes.T[:2]
    centre = drawn.tail + 0.72 * (drawn.head - drawn.tail)
    size = _ABOUT_RAY * placing.unit
    yield _turn(message, centre, (first, second), number(value), size, "azimuth")


def _plate_axes(placing: Placing, name: str, element: Any) -> Iterator[SceneAngle]:
    """Yield the angles of the axes of a plate against x of its frame."""
    x, y, _ = placing.postures[name].axes["in"].T
    size = _ON_PLATE * placing.unit
    for field in _OF_AXES:
        value = getattr(element, field, None)
        if isinstance(value, Parameter):
            message = shown_value(value)
            angle = number(value) if message.there else 0.0
            result = _turn(message, placing.at[name], (x, y), angle, size, "axis")
            if not message.there:
                result = result._replace(arc=result.arc[:0], at=placing.at[name])
            yield result
            size *= 1.25


def _arc(
    message: ShownValue, at: Numbers, first: Numbers, second: Numbers, angle: float, size: float
) -> SceneAngle:
    """Return the arc from one direction to another, which are an angle apart."""
    across = second - (second @ first) * first
    length = np.linalg.norm(across)
    towards = across / length if length > 1e-12 else np.zeros(3)
    return _turn(message, at, (first, towards), angle, size, "incidence")


def _turn(
    message: ShownValue,
    at: Numbers,
    sides: tuple[Numbers, Numbers],
    angle: float,
    size: float,
    about: str,
) -> SceneAngle:
    """Return the arc of a turn from one direction towards another at a right angle to it."""
    first, second = sides
    steps = np.linspace(0.0, angle, 2 + int(abs(angle) / 0.08))[:, np.newaxis]
    arc = at + size * (np.cos(steps) * first + np.sin(steps) * second)
    # An angle that is not seen has its name where it would open.
    reach = size if abs(angle) > _SEEN else 0.0
    middle = at + reach * (np.cos(angle / 2) * first + np.sin(angle / 2) * second)
    return SceneAngle(message.name, message.text, arc, middle, at, about)


def angles_in_chain(element: Any) -> tuple[Any, Any]:
    """Return the incidence at a surface, and the turn of its plane from the one before, in rad."""
    chain = element.vertices if isinstance(element, ChainVertex) else None
    if not isinstance(chain, VerticesByAngles):
        return None, None
    place = int(element.place)
    way = -1 if chain.backwards else 1
    turn = chain.turns[::way][place - 2] if place > 1 else None
    return chain.incidences[::way][place - 1], turn
