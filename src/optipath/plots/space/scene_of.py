"""A path laid out in space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.chain_vertex import ChainVertex
from optipath.plots.space.placing import DrawnLink, Placing
from optipath.plots.space.posture import has_axis
from optipath.plots.space.scene import Scene, SceneFrame, SceneNode, ScenePlane, SceneRay
from optipath.plots.space.scene_angles import scene_angles
from optipath.plots.space.told_values import ToldPath, number, told_angle
from optipath.plots.states.ellipse_points import ellipse_points

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.paths.lights_along import LightOnLink
    from optipath.paths.path_graph import PathGraph

    Array = npt.NDArray[np.float64]

LARGEST_ELLIPSE = 0.18
"""How far the ellipse of wholly polarised light reaches from the ray, of the length of a link."""

_LEAVING = 0.5
"""How long light that leaves the path is drawn, of the length of a link."""

_NO_PLANE, _NARROWEST = 1e-6, 0.3
"""The sine of an incidence that has no plane, and how far a plane reaches at least."""

_FRAMES_AT = 0.2
"""How far from its node the frame of a port is drawn."""


def scene_of(path: PathGraph, what: str = "a scene", /, **values: Any) -> Scene:
    """Return a path laid out in space.

    What has world frames, or stands at the points of a chain, stands where it stands. All else is
    laid out by following the light from its source, in the frames of docs/conventions.md: x of a
    surface is along k_out cross k_in, azimuths turn the frame about the light.

    Examples
    --------
    >>> import optipath as op
    >>> scene = scene_of(op.load_preset("npgr026", case="8"))
    >>> [angle.text for angle in scene.angles]
    ['filter = 0 deg', 'phi = 20 deg', 'rho = 34 deg', 'delta = 48 deg']
    """
    return scene_with(ToldPath(path, what, values))


def scene_with(told: ToldPath) -> Scene:
    """Return a path with all its values laid out in space."""
    placing = Placing(told)
    rays = tuple(_ray(placing, each) for each in told.lights)
    schematic = not all(posture.told for posture in placing.postures.values())
    angles = scene_angles(told, placing)
    lengths = "lengths are chosen: each link is drawn 1 long"
    notes = [] if told.wiring.self_placed and not placing.by_angles else [lengths]
    return Scene(
        notes=(*notes, *placing.notes),
        schematic=schematic,
        unit=placing.unit,
        nodes=tuple(_nodes(told, placing)),
        rays=rays,
        planes=tuple(_planes(placing, rays)),
        frames=tuple(_frames(placing, {each.name: each for each in told.lights})),
        angles=angles,
    )


def _nodes(told: ToldPath, placing: Placing) -> list[SceneNode]:
    found = []
    order = dict.fromkeys([*(name for name, _ in told.wiring.order), *placing.at])
    for name in order:
        posture, kind = placing.postures[name], placing.wiring.elements[name].kind
        stands = placing.at[name], posture.normal, posture.across
        found.append(SceneNode(name, kind, *stands, posture.role, _axis(placing, name)))
    return found


def _axis(placing: Placing, name: str) -> Array | None:
    """Return the axis of a plate that has one."""
    posture, element = placing.postures[name], placing.wiring.elements[name]
    if posture.role != "plate" or not has_axis(element):
        return None
    angle = element.angle  # type: ignore[attr-defined]
    told = told_angle(angle)
    if not told.there:
        return None
    x, y, _ = posture.axes["in"].T
    turned = number(angle)
    return np.asarray(np.cos(turned) * x + np.sin(turned) * y)


def _ray(placing: Placing, each: LightOnLink) -> SceneRay:
    drawn = drawn_link(placing, each)
    x, y, _ = rows = drawn.axes.T
    dop = float(each.light.dop)
    ellipse = None
    if dop > 1e-9:  # Of NaN as well it is not told.
        points = ellipse_points(each.light, 49) * (LARGEST_ELLIPSE * placing.unit * min(dop, 1.0))
        ellipse = points @ np.array([x, y])
    ends = each.name, each.start, each.end, drawn.tail, drawn.head
    return SceneRay(*ends, rows, ellipse, each.light, not each.end, each.tap)


def drawn_link(placing: Placing, each: LightOnLink) -> DrawnLink:
    """Return where the light of a link, or of an outlet, is drawn."""
    if each.end:
        return placing.links[each.start, each.end, (each.leaves, each.enters)]
    axes = placing.postures[each.start].axes[each.leaves]
    tail = placing.tail_of(each.start, each.leaves)
    return DrawnLink(tail, tail + _LEAVING * placing.unit * axes[:, 2], axes)


def _planes(placing: Placing, rays: tuple[SceneRay, ...]) -> list[ScenePlane]:
    """Return a rectangle for each plane of incidence, which reaches as far as the links."""
    found = []
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
            found.append(ScenePlane(name, at + corners))
    return found


def _frames(placing: Placing, lit: dict[str, LightOnLink]) -> list[SceneFrame]:
    """Return the frames of the ports that light passes, beside their nodes."""
    found: dict[str, SceneFrame] = {}
    for each in lit.values():
        drawn, aside = drawn_link(placing, each), _FRAMES_AT * placing.unit
        away = aside * drawn.axes[:, 2]
        port = f"{each.start}.{each.leaves}"
        found.setdefault(port, SceneFrame(port, drawn.tail + away, drawn.axes.T))
        if each.end:
            port = f"{each.end}.{each.enters}"
            axes = placing.axes_entering((each.start, each.end, (each.leaves, each.enters)))
            found.setdefault(port, SceneFrame(port, drawn.head - away, axes.T))
    return [*found.values()]
