"""The angles of a path that have names, as arcs in space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.placement import azimuth_of
from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.chain_vertex import ChainVertex
from optipath.plots.space.chain_angles import angles_in_chain
from optipath.plots.space.fixed_places import incidence_at
from optipath.plots.space.posture import angles_at
from optipath.plots.space.scene import SceneAngle
from optipath.plots.space.told_values import ToldAngle, number, told_angle, told_incidence
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from optipath.composer.wiring import Link
    from optipath.plots.space.placing import Placing
    from optipath.plots.space.told_values import ToldPath

    Array = npt.NDArray[np.float64]

_AT_SURFACE, _ABOUT_RAY, _ON_PLATE = 0.32, 0.3, 0.3
"""How large arcs are, of the length of a link."""

_SEEN = np.radians(1.0)
"""The least angle that is seen as one."""

_OF_AXES = "angle", "dichroic_angle"
"""The fields of elements that say how an axis stands to x, or by how much light is turned."""


def scene_angles(told: ToldPath, placing: Placing) -> tuple[SceneAngle, ...]:
    """Return the angles of a path that have names, node by node as light travels."""
    found: list[SceneAngle] = []
    names = dict.fromkeys(name for name, _ in told.wiring.order)
    for name in names:
        for link in placing.links:
            if link[1] == name:
                found += _azimuths(placing, link)
        element = placing.wiring.elements[name]
        if isinstance(element, BoundaryElement | ChainVertex):
            found += _incidences(placing, name, element)
        elif placing.postures[name].role == "plate":
            found += _axes(placing, name, element)
    return tuple(found)


def _incidences(placing: Placing, name: str, element: Any) -> Iterator[SceneAngle]:
    """Yield the angle between the light that arrives and the normal, or that is given behind."""
    posture, at = placing.postures[name], placing.at[name]
    normal: Any = posture.normal
    front = incidence_at(element, posture)
    value: Any = front
    if not isinstance(element, ChainVertex):
        value = element.incidence
        _, behind = angles_at(element)
        given = number(value) if isinstance(value, Parameter) else front
        if abs(given - front) > 1e-9 and abs(given - behind) < 1e-9:
            out, size = posture.axes["transmitted"][:, 2], _AT_SURFACE * placing.unit
            yield _arc(told_angle(value), at, -normal, out, behind, size)
    elif (given := angles_in_chain(element)[0]) is not None:
        value = given
    told = told_incidence(value, front)
    arriving = -posture.axes["in"][:, 2]
    yield _arc(told, at, normal, arriving, front, _AT_SURFACE * placing.unit)


def _azimuths(placing: Placing, link: Link) -> Iterator[SceneAngle]:
    """Yield the turn of the frame that light enters in against that in which it left."""
    wiring, value = placing.wiring, azimuth_of(placing.wiring, link)
    if link[0] in wiring.self_placed and link[1] in wiring.self_placed:
        _, value = angles_in_chain(wiring.elements[link[1]])
    if not isinstance(value, Parameter):
        return
    told, drawn = told_angle(value, signed=False), placing.links[link]
    is_surface = placing.postures[link[1]].role == "surface"
    first, second = (drawn.axes[:, 1], -drawn.axes[:, 0]) if is_surface else drawn.axes.T[:2]
    centre = drawn.tail + 0.72 * (drawn.head - drawn.tail)
    size = _ABOUT_RAY * placing.unit
    yield _turn(told, centre, (first, second), number(value), size, "azimuth")


def _axes(placing: Placing, name: str, element: Any) -> Iterator[SceneAngle]:
    """Yield the angles of the axes of a plate against x of its frame."""
    x, y, _ = placing.postures[name].axes["in"].T
    size = _ON_PLATE * placing.unit
    for field in _OF_AXES:
        value = getattr(element, field, None)
        if isinstance(value, Parameter):
            told = told_angle(value)
            angle = number(value) if told.there else 0.0
            found = _turn(told, placing.at[name], (x, y), angle, size, "axis")
            yield found if told.there else found._replace(arc=found.arc[:0], at=placing.at[name])
            size *= 1.25


def _arc(
    told: ToldAngle, at: Array, first: Array, second: Array, angle: float, size: float
) -> SceneAngle:
    """Return the arc from one direction to another, which are an angle apart."""
    across = second - (second @ first) * first
    length = np.linalg.norm(across)
    towards = across / length if length > 1e-12 else np.zeros(3)
    return _turn(told, at, (first, towards), angle, size, "incidence")


def _turn(
    told: ToldAngle, at: Array, sides: tuple[Array, Array], angle: float, size: float, about: str
) -> SceneAngle:
    """Return the arc of a turn from one direction towards another at a right angle to it."""
    first, second = sides
    steps = np.linspace(0.0, angle, 2 + int(abs(angle) / 0.08))[:, np.newaxis]
    arc = at + size * (np.cos(steps) * first + np.sin(steps) * second)
    # An angle that is not seen has its name where it would open.
    reach = size if abs(angle) > _SEEN else 0.0
    middle = at + reach * (np.cos(angle / 2) * first + np.sin(angle / 2) * second)
    return SceneAngle(told.name, told.text, arc, middle, at, about)
