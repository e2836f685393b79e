"""What a path says itself of where it stands: world frames, and points of chains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.placement import frame_at
from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.chain_vertex import ChainVertex
from optipath.elements.vertices.by_angles import VerticesByAngles, vertices_from_angles
from optipath.kernels.geometry.events import Event
from optipath.plots.space.posture import angles_at, posture_of
from optipath.plots.space.told_values import number
from optipath.values.materials import Material
from optipath.values.operands import Operand

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.composer.wiring import Link, Wiring
    from optipath.elements.element import Element
    from optipath.light.frames import Frame
    from optipath.plots.space.posture import Posture

    Array = npt.NDArray[np.float64]


_STRAIGHT_ON = 1e-12
"""The sine of an angle that is none."""


def own_axes_of(wiring: Wiring, name: str) -> dict[str, Array]:
    """Return the axes that ports of a node have in the world.

    Shape: returns (3, 3).
    """
    element = wiring.elements[name]
    found = {}
    for port in (*element.inputs, *element.outputs):
        own = element.own_frame(port)
        frame = own.frame({}) if own is not None else frame_at(wiring, name, port)
        if frame is not None:
            found[port] = _columns(frame)
    return found


def posture_in_space(wiring: Wiring, name: str, axes: dict[str, Array]) -> Posture:
    """Return how the ports of a node stand in the world, of which some have axes there.

    Shape: axes (3, 3).
    """
    element = wiring.elements[name]
    usual = posture_of(element)
    first = next(iter(axes))
    basis = axes[first] @ usual.axes[first].T if usual.axes else np.eye(3)
    others = {port: basis @ own for port, own in usual.axes.items() if port not in axes}
    across = axes[first][:, 0] if usual.role in ("surface", "mirror", "plate") else None
    normal = None if usual.normal is None else basis @ usual.normal
    leaves = [port for port in element.outputs if port in axes]
    if normal is not None and usual.role != "plate" and "in" in axes and leaves:
        normal = _normal(element, leaves[0], axes["in"], axes[leaves[0]][:, 2])
    elif isinstance(element, ChainVertex):
        normal = _normal_of_vertex(element, axes["in"], axes[leaves[0]][:, 2])
    told = usual.told or len(axes) > 1
    return usual._replace(axes={**axes, **others}, normal=normal, across=across, told=told)


def _normal(element: Element, port: str, arriving: Array, leaves: Array) -> Array:
    """Return the normal of a surface between two directions, on the side that light comes from."""
    if port != "transmitted":
        return _bisector(arriving, leaves)
    front, behind = angles_at(element) if isinstance(element, BoundaryElement) else (0.0, 0.0)
    # The plane of incidence is across x, to either side.
    side = -1.0 if (front - behind) * (arriving[:, 1] @ leaves) > 0.0 else 1.0
    return np.asarray(side * np.sin(front) * arriving[:, 1] - np.cos(front) * arriving[:, 2])


def _normal_of_vertex(vertex: Any, arriving: Array, leaves: Array) -> Array:
    """Return the normal of a vertex, across which light is reflected or refracted.

    What refracts stands across n2 k_out - n1 k_in (A. Glassner, ed., An Introduction to Ray
    Tracing, 1989, ch. 4).
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


def _bisector(arriving: Array, leaves: Array) -> Array:
    across = leaves - arriving[:, 2]
    length = np.linalg.norm(across)
    # Light that grazes the surface is not turned, but its x tells the plane.
    return across / length if length > _STRAIGHT_ON else arriving[:, 1]


def incidence_at(element: Element, posture: Posture) -> float:
    """Return the angle between the light that arrives at a surface and its normal.

    Units: the result in radians.
    """
    if not isinstance(element, ChainVertex) and hasattr(element, "incidence"):
        return angles_at(element)[0]
    arrives, normal = posture.axes["in"][:, 2], np.asarray(posture.normal)
    across = np.linalg.norm(np.cross(arrives, normal))
    return float(np.arctan2(across, -np.dot(arrives, normal)))


def chain_points(element: Any) -> Array:
    """Return the points of the chain of a vertex, shape (m + 2, 3)."""
    chain = element.vertices
    if isinstance(chain, VerticesByAngles):
        incidences, turns = (
            [Operand(angle).numbers() for angle in angles]
            for angles in (chain.incidences, chain.turns)
        )
        points = vertices_from_angles(incidences, turns)
        return points[::-1] if chain.backwards else points
    return np.asarray(Operand(chain).numbers(), float)


def legs_beside_chains(wiring: Wiring) -> dict[Link, float]:
    """Return how long links before and behind chains of points are, which share a leg.

    Those of chains by angles have no length of their own.
    """
    found: dict[Link, float] = {}
    for name in wiring.self_placed:
        element: Any = wiring.elements[name]
        if isinstance(element.vertices, VerticesByAngles):
            continue
        points, place = chain_points(element), int(element.place)
        for beside, links in (
            (place - 1, _links_before(wiring, name)),
            (place + 1, _links_behind(wiring, name)),
        ):
            length = np.linalg.norm(points[beside] - points[place])
            found |= dict.fromkeys(links, float(length) / max(len(links), 1))
    return found


def _links_before(wiring: Wiring, name: str) -> list[Link]:
    links = wiring.links_to.get((name, "in"), [])
    if len(links) != 1 or links[0][0] in wiring.self_placed:
        return []
    start = links[0][0]
    element = wiring.elements[start]
    more = _links_before(wiring, start) if element.straight and element.inputs else []
    return [links[0], *more]


def _links_behind(wiring: Wiring, name: str) -> list[Link]:
    element = wiring.elements[name]
    links = wiring.links_from.get((name, element.outputs[0]), []) if element.outputs else []
    if len(links) != 1 or links[0][1] in wiring.self_placed:
        return []
    more = _links_behind(wiring, links[0][1]) if wiring.elements[links[0][1]].straight else []
    return [links[0], *more]


def _columns(frame: Frame) -> Array:
    return np.stack([frame.x, frame.y, frame.z], axis=-1)
