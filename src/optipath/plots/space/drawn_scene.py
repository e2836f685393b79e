"""The lines and faces of a scene, drawn on a sheet."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon

from optipath.plots.line_colours import FAINT, INK, LINES
from optipath.plots.space.solids import axis_line, outline

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from optipath.plots.space.scene import Scene, SceneAngle, SceneFrame, SceneNode, SceneRay
    from optipath.plots.space.view import View

    Array = npt.NDArray[np.float64]

X_COLOUR, ELLIPSE, Y_COLOUR, ARC, FACE, LAMP = LINES
_MIRROR = "#666666"

_FRAME = 0.15
"""How long x and y of a frame are drawn, of the length of a link."""

_DOTS: Any = (0, (1, 2))

_NORMAL = 0.5
"""How long a normal is drawn."""

_ARROW_AT, _ARROW = 0.72, (0.085, 0.028)
"""Where on a ray its arrow points to, and how long and wide it is."""


_TURN, _NARROW = (0.065, 0.025), 0.8
"""The head on an ellipse, and how wide the ellipse is at least, in widths of the head."""


def draw_scene(ax: Axes, scene: Scene, view: View, weight: float = 1.0) -> None:
    """Draw all of a scene but its names."""
    first = len(ax.lines)
    for plane in scene.planes:
        _face(ax, view.points(plane.corners), FAINT, 0.09, 1.0)
    _faces(ax, scene, view)
    for ray in scene.rays:
        _ray(ax, scene, ray, view)
    for angle in scene.angles:
        _angle(ax, angle, view)
    for frame in drawn_frames(scene):
        for axis, colour in zip(frame.axes[:2], (X_COLOUR, Y_COLOUR), strict=True):
            ends = np.array([frame.at, frame.at + _FRAME * scene.unit * axis])
            _line(ax, view.points(ends), color=colour, lw=1.4, zorder=5.5)
    for node in scene.nodes:
        if node.role in _MARKS:
            ax.plot(*view.points(node.at), **_MARKS[node.role], ls="", mec=INK, mew=0.9, zorder=7)
    for line in ax.lines[first:]:
        line.set_linewidth(weight * line.get_linewidth())
        line.set_markersize(weight * line.get_markersize())


_MARKS: dict[str, dict[str, Any]] = {
    "source": {"marker": "o", "ms": 8, "mfc": LAMP},
    "detector": {"marker": "D", "ms": 6.5, "mfc": INK},
    "dump": {"marker": "s", "ms": 6, "mfc": "white"},
    "other": {"marker": "o", "ms": 5, "mfc": "white"},
}


def lines_of(scene: Scene, view: View) -> list[Array]:
    """Return the lines of a scene that no text should cover, and what is to be seen of it.

    Shape: returns (points, 2).
    """
    found = [np.array([ray.tail, ray.head]) for ray in scene.rays]
    found += [_ellipse(ray) for ray in scene.rays if _has_ellipse(ray)]
    found += [_spokes(angle) for angle in scene.angles if len(angle.arc)]
    found += [outline(scene, node) for node in scene.nodes if node.normal is not None]
    found += [axis_line(scene, node) for node in scene.nodes if node.axis is not None]
    found += [_normal(scene, node) for node in scene.nodes if node.role == "surface"]
    for frame in drawn_frames(scene):
        x, y, _ = frame.at + _FRAME * scene.unit * frame.axes
        found.append(np.array([x, frame.at, y]))
    return [view.points(line) for line in found]


def drawn_frames(scene: Scene) -> list[SceneFrame]:
    """Return the frames that are drawn: those of links, since rays that leave end soon."""
    leaving = {ray.name for ray in scene.rays if ray.leaves}
    return [frame for frame in scene.frames if frame.port not in leaving]


def key_to(scene: Scene) -> list[Artist]:
    """Return what a key shows of the lines and faces that are drawn."""
    s = "surface" in {node.role for node in scene.nodes}
    found: list[Artist] = [
        Line2D([], [], color=X_COLOUR, lw=1.6, label="x of a frame" + " (s)" * s),
        Line2D([], [], color=Y_COLOUR, lw=1.6, label="y" + " (p)" * s),
    ]
    if any(_has_ellipse(ray) for ray in scene.rays):
        found.append(Line2D([], [], color=ELLIPSE, lw=1.4, label="polarisation"))
    if scene.planes:
        found.append(Patch(color=FAINT, alpha=0.2, lw=0, label="plane of incidence"))
    if any(ray.tap for ray in scene.rays):
        found.append(Line2D([], [], color=INK, lw=1.2, ls=(0, (4, 2)), label="tap"))
    if any(ray.is_dark and not ray.leaves for ray in scene.rays):
        found.append(Line2D([], [], color=FAINT, lw=1.0, ls=_DOTS, label="no light"))
    if any(ray.leaves for ray in scene.rays):
        found.append(Line2D([], [], color=FAINT, lw=1.0, label="leaves the path"))
    return found


def _faces(ax: Axes, scene: Scene, view: View) -> None:
    """Draw surfaces and plates, what is farther away first."""
    towards = view.sheet[2]
    standing = [node for node in scene.nodes if node.normal is not None]
    for node in sorted(standing, key=lambda node: float(node.at @ towards)):
        colour = {"mirror": _MIRROR, "plate": FAINT}.get(node.role, FACE)
        points = view.points(outline(scene, node))
        _face(ax, points, colour, 0.3 if node.role != "plate" else 0.16, 2.0)
        _line(ax, np.concatenate([points, points[:1]]), color=colour, lw=0.9, zorder=2.1)
        if node.axis is not None:
            _line(ax, view.points(axis_line(scene, node)), color=INK, lw=1.3, zorder=4.5)
        if node.role == "surface":
            _line(
                ax,
                view.points(_normal(scene, node)),
                color=FAINT,
                lw=0.9,
                ls=(0, (4, 3)),
                zorder=2.2,
            )


def _normal(scene: Scene, node: SceneNode) -> Array:
    return np.array([node.at, node.at + _NORMAL * scene.unit * np.asarray(node.normal)])


def _ray(ax: Axes, scene: Scene, ray: SceneRay, view: View) -> None:
    colour, width = (FAINT, 0.9) if ray.leaves or ray.is_dark else (INK, 1.4)
    ends = view.points(np.array([ray.tail, ray.head]))
    dashes: Any = _DOTS if ray.is_dark else (0, (4, 2)) if ray.tap else "-"
    _line(ax, ends, color=colour, lw=width, ls=dashes, zorder=4.0)
    way = ends[1] - ends[0]
    if np.linalg.norm(way) > 0.1 * scene.unit:
        tip = ends[0] + (1.0 if ray.leaves else _ARROW_AT) * way
        size = scene.unit * np.array(_ARROW)
        draw_head(ax, tip, way, size, fc=colour, zorder=4.2)
    if _has_ellipse(ray):
        curve = view.points(_ellipse(ray))
        _line(ax, curve, color=ELLIPSE, lw=1.4, zorder=5.0)
        if ray.turns:
            draw_turn(ax, curve, scene.unit, ELLIPSE, zorder=5.05)


def draw_head(ax: Axes, tip: Array, way: Array, size: Array, **style: Any) -> None:
    """Draw the head of an arrow.

    Shapes: tip, way (2,); size (2,).
    """
    along = way / np.linalg.norm(way)
    foot, aside = tip - size[0] * along, size[1] * np.array([-along[1], along[0]])
    ax.add_patch(Polygon([tip, foot + aside, foot - aside], ec="none", **style))


def draw_turn(ax: Axes, curve: Array, unit: float, colour: str, zorder: float) -> None:
    """Draw a head on an ellipse that shows how the field turns, where the ellipse is flattest.

    Shape: curve (points, 2).
    """
    size = unit * np.array(_TURN)
    narrow = np.linalg.svd(curve[:-1] - curve[:-1].mean(axis=0))[1][1]
    if narrow * np.sqrt(2.0 / len(curve[:-1])) < _NARROW * size[1]:
        return  # On what looks like a line a head would say that the field goes along it.
    steps = (curve[2:] - curve[:-2]) / unit
    # Of a circle the first one, whatever the rounding.
    place = int(np.argmax(np.linalg.norm(steps, axis=1).round(6)))
    way = steps[place] / np.linalg.norm(steps[place])
    tip = curve[place + 1] + 0.5 * size[0] * way
    draw_head(ax, tip, way, size, fc=colour, gid="turn", zorder=zorder)


def _has_ellipse(ray: SceneRay) -> bool:
    return ray.ellipse is not None and not ray.leaves


def _ellipse(ray: SceneRay) -> Array:
    return np.asarray((ray.tail + ray.head) / 2.0 + np.asarray(ray.ellipse))


def _spokes(angle: SceneAngle) -> Array:
    """Return a line that goes to and fro over the face of an angle."""
    centres = np.broadcast_to(angle.centre, angle.arc.shape)
    return np.stack([centres, angle.arc], axis=1).reshape(-1, 3)


def _angle(ax: Axes, angle: SceneAngle, view: View) -> None:
    if not len(angle.arc):
        return
    arc, centre = view.points(angle.arc), view.points(angle.centre)
    _face(ax, np.concatenate([centre[None], arc]), ARC, 0.22, 3.0)
    _line(ax, arc, color=ARC, lw=1.5, zorder=5.2)
    if angle.about == "azimuth":
        for end in (arc[0], arc[-1]):
            _line(ax, np.array([centre, end]), color=ARC, lw=0.8, zorder=5.1)


def _face(ax: Axes, points: Array, colour: str, alpha: float, zorder: float) -> None:
    ax.add_patch(Polygon(points, fc=colour, ec="none", alpha=alpha, zorder=zorder))


def _line(ax: Axes, points: Array, **style: Any) -> None:
    ax.plot(points[:, 0], points[:, 1], solid_capstyle="round", **style)
