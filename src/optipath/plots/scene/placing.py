"""Placing: where every node and link of a path is in space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.placement import azimuth_of, frame_at
from optipath.composer.wiring import link_text
from optipath.elements.boundary import BoundaryElement, angles_of, operands_of
from optipath.elements.ends import Detector, Terminal
from optipath.elements.interface import Mirror
from optipath.elements.medium import Medium
from optipath.elements.retarders import FaradayRotator, Rotator
from optipath.elements.splitters import Splitter
from optipath.elements.vertex_chain import VerticesByAngles, vertices_from_angles
from optipath.elements.vertices import ChainVertex
from optipath.kernels.vertex_chain import Event
from optipath.materials.material import Material
from optipath.values.operands import Operand

if TYPE_CHECKING:
    from optipath.composer.wiring import Link, Wiring
    from optipath.elements.element import Element
    from optipath.values.precision import Numbers


_ASIDE = np.radians([40.0, -40.0, 75.0, -75.0])
"""By how much taps, and lights that meet, are turned out of the way of other light."""

_SIDEWAYS = 0.6
"""How far light that comes back along its way is drawn beside it."""

_BACK, _ROOM = 3.0, 0.3
"""How long the way back is on which there should be room, and how much, in lengths of a link."""

_START = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""The axes of the first source, a column each: light goes to the right, y is up."""


def number(value: Any) -> float:
    """Return the number of a value that is known."""
    return float(Operand(value).numbers())


class DrawnLink(NamedTuple):
    """A link where it is drawn. Shapes: tail, head (3,); axes (3, 3)."""

    tail: Numbers
    head: Numbers
    axes: Numbers


class Posture(NamedTuple):
    """The frames of the ports of an element; normal, across (3,)."""

    axes: dict[str, Numbers]
    normal: Numbers | None
    across: Numbers | None
    role: str
    told: bool = True

    def turned(self, basis: Numbers) -> Posture:
        """Return the same in another basis (3, 3)."""
        axes = {port: basis @ own for port, own in self.axes.items()}
        normal, across = (None if v is None else basis @ v for v in (self.normal, self.across))
        return self._replace(axes=axes, normal=normal, across=across)


class Placing:
    """Where the nodes and links of a path are drawn. Shape: at (3,)."""

    def __init__(self, wiring: Wiring) -> None:
        self.wiring = wiring
        self.at: dict[str, Numbers] = {}
        self.postures: dict[str, Posture] = {}
        self.links: dict[Link, DrawnLink] = {}
        self.notes: dict[str, None] = {}
        self._begins: dict[tuple[str, str], Numbers] = {}
        for name, element in wiring.elements.items():
            if axes := _own_axes_of(wiring, name):
                self.postures[name] = _posture_in_space(element, axes)
            if isinstance(element, ChainVertex):
                self.at[name] = _chain_points(element)[int(element.place)]
        legs, self._lengths = _legs_of_chains(wiring)
        self.by_angles = not legs
        self.unit = float(np.median(legs)) if legs else 1.0
        self._follow()

    def note(self, sentence: str) -> None:
        """Say once what was chosen."""
        self.notes[sentence] = None

    def _follow(self) -> None:
        """Draw link after link, forwards where that can be, else backwards to other sources."""
        left = sorted(
            self.wiring.graph.edges(keys=True),
            key=lambda e: (self.wiring.order.get((e[0], e[2][0]), 0), e in self.wiring.taps),
        )
        while left:
            forwards = [link for link in left if link[0] in self.at]
            backwards = [each for each in left if each[0] not in self.at and each[1] in self.at]
            # What comes back goes where there is room, and so comes last.
            onwards = [link for link in forwards if not self._comes_back(link[0], link[2][0])]
            if onwards or (forwards and not backwards):
                link = (onwards or forwards)[0]
                self.links[link] = self._forwards(link)
            elif backwards:
                link = backwards[0]
                self.links[link] = self._backwards(link)
            else:
                self._begin(left[0][0])
                continue
            left.remove(link)
        for name in self.wiring.elements:
            if name not in self.at:
                self._begin(name)

    def _begin(self, name: str) -> None:
        """Place a node that nothing else places."""
        sources = [n for n in self.at if not self.wiring.elements[n].inputs]
        element = self.wiring.elements[name]
        port = (*element.outputs, *element.inputs)[0]
        self._stand(name, np.array([0.0, 0.0, -1.6 * len(sources) * self.unit]), port, _START)

    def _stand(self, name: str, at: Numbers, port: str, axes: Numbers) -> None:
        """Place a node by the axes of one of its ports."""
        self.at[name] = at
        if name not in self.postures:
            usual = posture_of(self.wiring.elements[name])
            self.postures[name] = usual.turned(axes @ usual.axes[port].T)
        if not self.postures[name].told:
            self.note(
                f"schematic: nothing says by which angle '{name}' turns light; drawn at 45 deg"
            )

    def _comes_back(self, name: str, port: str) -> bool:
        """Return whether light leaves a port along the way on which it arrived."""
        element, axes = self.wiring.elements[name], self.postures[name].axes
        if isinstance(element, ChainVertex):
            # What comes behind a chain of angles may stand beside it.
            following = self.wiring.self_placed.intersection(self.wiring.graph.successors(name))
            if following or not isinstance(element.vertices, VerticesByAngles):
                return False
        if port not in {"reflected", "out"} or "in" not in axes:
            return False
        return bool(np.linalg.norm(axes["in"][:, 2] + axes[port][:, 2]) < 1e-6)

    def tail_of(self, name: str, port: str) -> Numbers:
        """Return where light (3,) begins that leaves a port: beside where it arrived, or there."""
        if not self._comes_back(name, port):
            return self.at[name]
        if (name, port) not in self._begins:
            self.note(f"light that '{name}' sends back is drawn beside the way it came")
            axes = self.postures[name].axes
            aside, way = axes["in"][:, 1], axes[port][:, 2]
            sides = [self.at[name] + _SIDEWAYS * self.unit * each for each in (aside, -aside)]
            free = [self._free(side, way) for side in sides]
            # To where y is, unless another beam or element is there.
            other = free[0] < _ROOM and free[1] > free[0]
            self._begins[name, port] = sides[int(other)]
        return self._begins[name, port]

    def _free(self, start: Numbers, way: Numbers) -> float:
        """Return how far a beam keeps from what is placed, in lengths of a link."""
        beam = start + np.linspace(0.0, _BACK * self.unit, 31)[:, np.newaxis] * way
        share = np.linspace(0.0, 1.0, 11)[:, np.newaxis]
        lines = [link.tail + share * (link.head - link.tail) for link in self.links.values()]
        taken = np.concatenate([*lines, np.array([*self.at.values()])])
        distances = np.linalg.norm(beam[:, np.newaxis] - taken, axis=2)
        return float(distances.min()) / self.unit

    def axes_entering(self, link: Link) -> Numbers:
        """Return the axes in which the light of a link enters, a column each."""
        _, end, (_, enters) = link
        axes, drawn = self.postures[end].axes[enters], self.links[link]
        if np.linalg.norm(axes[:, 2] - drawn.axes[:, 2]) < 1e-9:
            return axes
        return drawn.axes @ _turn_about_z(self._azimuth(link))

    def _azimuth(self, link: Link) -> float:
        return number(azimuth_of(self.wiring, link))

    def _forwards(self, link: Link) -> DrawnLink:
        """Draw a link from where it begins."""
        start, end, (leaves, enters) = link
        tail, axes = self.tail_of(start, leaves), self.postures[start].axes[leaves]
        if end in self.at:
            return self._closed(link, tail, axes)
        if link in self.wiring.taps and end not in self.postures:
            beside = [e for e in self.links if (e[0], e[2][0]) == (start, leaves)]
            taps = {*beside}.intersection(self.wiring.taps)
            axes = axes @ _turn_about_x(_ASIDE[len(taps) % len(_ASIDE)])
            self.note("taps, which only read light, are drawn dashed and aside")
        head = tail + self._lengths.get(link, self.unit) * axes[:, 2]
        self._stand(end, head, enters, axes @ _turn_about_z(self._azimuth(link)))
        return DrawnLink(tail, head, axes)

    def _backwards(self, link: Link) -> DrawnLink:
        """Draw a link to a node that stands, from one that does not."""
        start, end, (leaves, enters) = link
        axes = self.postures[end].axes[enters] @ _turn_about_z(-self._azimuth(link))
        others = [other for other in self.links if (other[1], other[2][1]) == (end, enters)]
        if others and start not in self.postures:
            axes = axes @ _turn_about_x(_ASIDE[(len(others) - 1) % len(_ASIDE)])
            self.note(f"lights that meet at '{end}' are drawn from several sides")
        head = self.at[end]
        tail = head - self._lengths.get(link, self.unit) * axes[:, 2]
        self._stand(start, tail, leaves, axes)
        return DrawnLink(tail, head, axes)

    def _closed(self, link: Link, tail: Numbers, axes: Numbers) -> DrawnLink:
        """Draw a link between nodes that stand both."""
        _, end, (_, enters) = link
        way, along, posture = self.at[end] - tail, axes[:, 2], self.postures[end]
        length = np.linalg.norm(way)
        if length > 0.0 and np.linalg.norm(way / length - along) < 1e-9:
            return DrawnLink(tail, self.at[end], axes)
        if posture.normal is not None and posture.role != "plate":
            towards = posture.normal @ along
            distance = posture.normal @ way / towards if abs(towards) > 1e-9 else 0.0
            expected = posture.axes[enters][:, 2] @ along > 1.0 - 1e-9
            if expected and 0.2 * self.unit < distance < 5.0 * self.unit:
                self.note(f"light comes to '{end}' again at another place of its face")
                return DrawnLink(tail, tail + distance * along, axes)
        self.note(f"the picture cannot close: '{link_text(link)}' is drawn to where '{end}' stands")
        if length < 0.2 * self.unit:
            return DrawnLink(tail, tail + 0.5 * self.unit * along, axes)
        return DrawnLink(tail, self.at[end], _carried(axes, way / length))


def _carried(axes: Numbers, direction: Numbers) -> Numbers:
    """Return axes turned by the least turn that takes z to a direction."""
    cosine = float(axes[:, 2] @ direction)
    if cosine < -1.0 + 1e-12:
        return np.asarray(axes * np.array([1.0, -1.0, -1.0]))
    matrix = np.cross(np.cross(axes[:, 2], direction), np.eye(3)).T
    return np.asarray((np.eye(3) + matrix + matrix @ matrix / (1.0 + cosine)) @ axes)


_STRAIGHT_ON = 1e-12
"""The sine of an angle that is none."""


def _own_axes_of(wiring: Wiring, name: str) -> dict[str, Numbers]:
    """Return the axes (3, 3) that ports of a node have in the world."""
    element = wiring.elements[name]
    results = {}
    for port in (*element.inputs, *element.outputs):
        own = element.own_frame(port)
        frame = own.frame({}) if own is not None else frame_at(wiring, name, port)
        if frame is not None:
            results[port] = np.stack([frame.x, frame.y, frame.z], axis=-1)
    return results


def _posture_in_space(element: Element, axes: dict[str, Numbers]) -> Posture:
    """Return the posture of an element, some of whose ports have axes (3, 3) in the world."""
    usual, first = posture_of(element), next(iter(axes))
    turned = usual.turned(axes[first] @ usual.axes[first].T if usual.axes else np.eye(3))
    normal, across = turned.normal, turned.across
    leaves = [port for port in element.outputs if port in axes]
    if isinstance(element, ChainVertex):
        normal = _normal_of_vertex(element, axes["in"], axes[leaves[0]][:, 2])
        across = axes[first][:, 0]
    elif normal is not None and usual.role != "plate" and "in" in axes and leaves:
        normal = _normal(element, leaves[0], axes["in"], axes[leaves[0]][:, 2])
    message = usual.told or len(axes) > 1
    return Posture({**turned.axes, **axes}, normal, across, usual.role, message)


def _normal(element: Element, port: str, arriving: Numbers, leaves: Numbers) -> Numbers:
    """Return the normal of a surface between two directions, on the side that light comes from."""
    if port != "transmitted":
        return _bisector(arriving, leaves)
    front, behind = angles_at(element) if isinstance(element, BoundaryElement) else (0.0, 0.0)
    # The plane of incidence is across x, to either side.
    side = -1.0 if (front - behind) * (arriving[:, 1] @ leaves) > 0.0 else 1.0
    return np.asarray(side * np.sin(front) * arriving[:, 1] - np.cos(front) * arriving[:, 2])


def _normal_of_vertex(vertex: Any, arriving: Numbers, leaves: Numbers) -> Numbers:
    """Return the normal of a vertex, across which light is reflected or refracted.

    Of a refraction along n2 k_out - n1 k_in (A. Glassner, ed., An Introduction to Ray Tracing,
    1989, ch. 4).
    """
    by_number = "events" in vertex.domains()
    if not vertex.refracts or (by_number and vertex.event_here.numbers() == Event.REFLECTS):
        return _bisector(arriving, leaves)
    behind = vertex.index.n if isinstance(vertex.index, Material) else np.real(vertex.index)
    arrives = arriving[:, 2]
    across = number(behind) * leaves - number(vertex.front) * arrives
    length = np.linalg.norm(across)
    if length < _STRAIGHT_ON:
        return -arrives
    return np.asarray(-np.sign(across @ arrives) * across / length)


def _bisector(arriving: Numbers, leaves: Numbers) -> Numbers:
    across = leaves - arriving[:, 2]
    length = np.linalg.norm(across)
    # Light that grazes the surface is not turned, but its x tells the plane.
    return across / length if length > _STRAIGHT_ON else arriving[:, 1]


def incidence_at(element: Element, posture: Posture) -> float:
    """Return the incidence, in radians, of light at a surface with a normal."""
    if not isinstance(element, ChainVertex) and hasattr(element, "incidence"):
        return angles_at(element)[0]
    arrives, normal = posture.axes["in"][:, 2], np.asarray(posture.normal)
    across = np.linalg.norm(np.cross(arrives, normal))
    return float(np.arctan2(across, -np.dot(arrives, normal)))


def _chain_points(element: Any) -> Numbers:
    """Return the points of the chain of a vertex, shape (m + 2, 3)."""
    chain = element.vertices
    if isinstance(chain, VerticesByAngles):
        both = chain.incidences, chain.turns
        points = vertices_from_angles(*[[Operand(a).numbers() for a in row] for row in both])
        return points[::-1] if chain.backwards else points
    return np.asarray(Operand(chain).numbers(), float)


def _legs_of_chains(wiring: Wiring) -> tuple[list[float], dict[Link, float]]:
    """Return the distances of chains of points, and the lengths of the links before and behind."""
    legs: list[float] = []
    results: dict[Link, float] = {}
    for name, element in wiring.elements.items():
        if isinstance(element, ChainVertex) and not isinstance(element.vertices, VerticesByAngles):
            points, place = _chain_points(element), int(element.place)
            for side in (-1, 1):
                length = float(np.linalg.norm(points[place + side] - points[place]))
                legs.append(length)
                links = _links_beside(wiring, name, behind=side > 0)
                results |= dict.fromkeys(links, length / max(len(links), 1))
    return legs, results


def _links_beside(wiring: Wiring, name: str, *, behind: bool) -> list[Link]:
    """Return the links on one side of a node, as far as light goes straight on to other points."""
    outputs = wiring.elements[name].outputs
    links = wiring.links_to.get((name, "in"), [])
    if behind:
        links = wiring.links_from.get((name, outputs[0]), []) if outputs else []
    if len(links) != 1:
        return []
    start, end, _ = links[0]
    other = end if behind else start
    if other in wiring.self_placed:
        return []
    element = wiring.elements[other]
    goes_on = element.straight and (element.outputs if behind else element.inputs)
    return [links[0], *(_links_beside(wiring, other, behind=behind) if goes_on else [])]


_RIGHT = np.pi / 2.0
_SCHEMATIC = np.pi / 4.0


def _turn_about_x(angle: float) -> Numbers:
    """Return the matrix of a turn about x by an angle in radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def _turn_about_z(angle: float) -> Numbers:
    """Return the matrix of a turn about z by an angle in radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def posture_of(element: Element) -> Posture:
    """Return how the ports of an element stand to one another, by its values alone."""
    ports = (*element.inputs, *element.outputs)
    if isinstance(element, BoundaryElement):
        return _surface(ports, *angles_at(element), "surface")
    if isinstance(element, ChainVertex):
        return Posture({}, None, None, "surface")
    if isinstance(element, Mirror):
        return _surface(ports, 0.0, 0.0, "mirror")
    if isinstance(element, Splitter):
        return _surface(ports, _SCHEMATIC, _SCHEMATIC, "surface")
    if element.straight:
        return _straight(element, ports)
    return _surface(ports, _SCHEMATIC, _SCHEMATIC, "surface")._replace(told=False)


def angles_at(element: Any) -> tuple[float, float]:
    """Return the angles of light in front of a boundary and behind it, in radians."""
    front, behind = angles_of(np, *(operand.numbers() for operand in operands_of(element)))
    return float(front), float(behind)


def has_axis(element: Any) -> bool:
    """Tell whether the angle of an element is that of an axis, and no turn of the light.

    >>> import optipath as op
    >>> has_axis(op.Polarizer(0.3)), has_axis(op.Rotator(0.3)), has_axis(op.Medium(1.0))
    (True, False, False)
    """
    if getattr(element, "angle", None) is None or isinstance(element, Rotator | FaradayRotator):
        return False
    along = (element.retardance, element.dichroism) if isinstance(element, Medium) else (1.0,)
    return any(number(value) != 0.0 for value in along)


def _surface(ports: tuple[str, ...], front: float, behind: float, role: str) -> Posture:
    """Return ports about x = s, in the basis of x, the normal and along the surface.

    x is along k_out cross k_in (docs/conventions.md), which is the normal cross the light.
    """
    angles = {
        "in": _RIGHT - front,
        "reflected": front - _RIGHT,
        "transmitted": _RIGHT - behind,
        "back": behind - _RIGHT,
    }
    outward = angles["reflected"]
    axes = {port: _turn_about_x(angles.get(port, outward)) for port in ports}
    x, normal, _ = np.eye(3)
    return Posture(axes, normal, x, role)


def _straight(element: Element, ports: tuple[str, ...]) -> Posture:
    axes = {port: np.eye(3) for port in ports}
    if isinstance(element, Terminal):
        return Posture(axes, None, None, "detector" if isinstance(element, Detector) else "dump")
    if not element.inputs or element.merges:
        return Posture(axes, None, None, "other" if element.inputs else "source")
    x, _, z = np.eye(3)
    return Posture(axes, -z, x, "plate")
