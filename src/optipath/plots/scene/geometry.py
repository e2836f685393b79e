"""A path drawn in space, as seen from a viewpoint: lines, faces, labels."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from matplotlib.transforms import Bbox

from optipath.errors import OptipathError
from optipath.faults import shown
from optipath.plots.axes import own_axes
from optipath.plots.colors import FAINT, INK, LINES
from optipath.plots.labels import Label, place_labels
from optipath.plots.scene.layout import scene_of
from optipath.plots.text import broken, draw_key

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from optipath.paths.path_graph import PathGraph
    from optipath.plots.scene.layout import Scene, SceneAngle, SceneNode, SceneRay
    from optipath.values.precision import Numbers


_SIZE = 8.0, 6.0
_AROUND, _LONGEST = 0.2, 0.6
"""What is free around, in links, and how long a link is at most, of the height or the width."""


def geometry(
    path: PathGraph,
    ax: Axes | None = None,
    *,
    view: tuple[float, float] | None = None,
    **values: Any,
) -> Axes:
    """Draw a path in space: rays, surfaces, planes of incidence, frames, angles and polarisation.

    Parameters
    ----------
    path : PathGraph
    ax : Axes, optional
        Where; by default in a figure of its own. Plain axes: what is in space is projected.
    view : tuple of float, optional
        Elevation and azimuth in degrees from which it is seen, as Matplotlib has them; by default
        one in which nodes are far apart.
    **values : float or str
        As in `PathGraph.trace`, a single number each.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import optipath as op
    >>> ax = op.plots.geometry(op.load_preset("npgr026", case="8"))
    >>> sorted(text.get_text() for text in ax.texts if "=" in text.get_text())
    ['delta = 48 deg', 'filter = 0 deg', 'phi = 20 deg', 'rho = 34 deg']
    """
    scene = scene_of(path, "geometry", **values)
    seen_from = None if view is None else _view_argument(view)
    ax = own_axes(ax, _SIZE)
    size, room = prepared_sheet(ax, 9.0, _SIZE[0])
    room = write_notes(ax, scene.notes, 0.85 * size, room)
    at: dict[str, Any] = {"loc": "lower center", "borderaxespad": 0.0}
    at["bbox_to_anchor"] = 0.5, ax.transAxes.inverted().transform((0.0, room.y0))[1]
    looks: dict[str, Any] = {"fontsize": 0.9 * size, "columnspacing": 1.4, "handlelength": 1.6}
    handles = key_to(scene)
    below = draw_key(ax, handles, len(handles), **at, **looks).get_window_extent().y1
    room = Bbox.from_extents(room.x0, below + 4, room.x1, room.y1)
    seen_from = seen_from or chosen_view(scene, room.width / room.height)
    draw_scene(ax, scene, seen_from, size / 9.0)
    lines = [np.asarray(line.get_xydata()) for line in ax.lines]
    faces = [np.asarray(patch.get_path().vertices) for patch in ax.patches]
    longest = _LONGEST * min(room.width, room.height) / scene.unit
    fit(ax, np.concatenate([*lines, *faces]), _AROUND * scene.unit, room, longest)
    place_labels(ax, _labels(scene, seen_from, size), lines, room)
    return ax


def _view_argument(view: Any) -> View:
    try:
        elevation, azimuth = (float(angle) for angle in view)
    except (TypeError, ValueError):
        elevation = azimuth = np.nan
    if not np.isfinite([elevation, azimuth]).all():
        raise OptipathError(f"view is {shown(view)}; give elevation and azimuth, as (24, -60)")
    return View(elevation, azimuth)


def _labels(scene: Scene, view: View, size: float) -> list[Label]:
    bold = {"fontsize": size * 1.1, "fontweight": "bold", "color": INK}
    results = [Label(node.name, view.points(node.at), bold) for node in scene.nodes]
    style = {"fontsize": size, "color": ANGLE_INK}
    return results + [Label(a.text, view.points(a.at), style, _LEADS_SOON) for a in scene.angles]


_LEADS_SOON = 0.7
"""From which distance on a line leads to the name of an angle, in heights of a line."""

ANGLE_INK = "#8b3f71"
"""Of the names of angles: the colour of their arcs, dark enough to read."""


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
    for corners in scene.planes.values():
        _face(ax, view.points(corners), FAINT, 0.09, 1.0)
    _faces(ax, scene, view)
    for ray in scene.rays:
        _ray(ax, scene, ray, view)
    for angle in scene.angles:
        _angle(ax, angle, view)
    # Rays that leave end soon, and have no room for a frame.
    leaving = {ray.name for ray in scene.rays if ray.leaves}
    for at, axes in (frame for port, frame in scene.frames.items() if port not in leaving):
        for axis, colour in zip(axes[:2], (X_COLOUR, Y_COLOUR), strict=True):
            ends = np.array([at, at + _FRAME * scene.unit * axis])
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


def key_to(scene: Scene) -> list[Artist]:
    """Return what a key shows of the lines and faces that are drawn."""
    s = "surface" in {node.role for node in scene.nodes}
    rays = scene.rays
    there = {
        f"x of a frame{' (s)' * s}": ("-", X_COLOUR, True),
        f"y{' (p)' * s}": ("-", Y_COLOUR, True),
        "polarisation": ("-", ELLIPSE, any(_has_ellipse(ray) for ray in rays)),
        "tap": ((0, (4, 2)), INK, any(ray.tap for ray in rays)),
        "no light": (_DOTS, FAINT, any(ray.is_dark and not ray.leaves for ray in rays)),
        "leaves the path": ("-", FAINT, any(ray.leaves for ray in rays)),
    }
    keys: list[Artist] = [
        Line2D([], [], color=colour, lw=1.4, ls=dashes, label=label)
        for label, (dashes, colour, is_drawn) in there.items()
        if is_drawn
    ]
    plane = Patch(color=FAINT, alpha=0.2, lw=0, label="plane of incidence")
    return [*keys, plane] if scene.planes else keys


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
            reach = 1.3 * _RADIUS * scene.unit * node.axis
            ends = view.points(np.array([node.at - reach, node.at + reach]))
            _line(ax, ends, color=INK, lw=1.3, zorder=4.5)
        if node.role == "surface":
            end = node.at + _NORMAL * scene.unit * np.asarray(node.normal)
            normal = view.points(np.array([node.at, end]))
            _line(ax, normal, color=FAINT, lw=0.9, ls=(0, (4, 3)), zorder=2.2)


def _ray(ax: Axes, scene: Scene, ray: SceneRay, view: View) -> None:
    colour, width = (FAINT, 0.9) if ray.leaves or ray.is_dark else (INK, 1.4)
    ends = view.points(np.array([ray.tail, ray.head]))
    dashes: Any = _DOTS if ray.is_dark else (0, (4, 2)) if ray.tap else "-"
    _line(ax, ends, color=colour, lw=width, ls=dashes, zorder=4.0)
    way = ends[1] - ends[0]
    if np.linalg.norm(way) > 0.1 * scene.unit:
        tip = ends[0] + (1.0 if ray.leaves else _ARROW_AT) * way
        draw_head(ax, tip, way, scene.unit * np.array(_ARROW), fc=colour, zorder=4.2)
    if _has_ellipse(ray):
        curve = view.points((ray.tail + ray.head) / 2.0 + np.asarray(ray.ellipse))
        _line(ax, curve, color=ELLIPSE, lw=1.4, zorder=5.0)
        if ray.turns:
            draw_turn(ax, curve, scene.unit, ELLIPSE, zorder=5.05)


def draw_head(ax: Axes, tip: Numbers, way: Numbers, size: Numbers, **style: Any) -> None:
    """Draw the head of an arrow. Shapes: tip, way (2,); size (2,)."""
    along = way / np.linalg.norm(way)
    foot, aside = tip - size[0] * along, size[1] * np.array([-along[1], along[0]])
    ax.add_patch(Polygon([tip, foot + aside, foot - aside], ec="none", **style))


def draw_turn(ax: Axes, curve: Numbers, unit: float, colour: str, zorder: float) -> None:
    """Draw an arrowhead on an ellipse (points, 2) where it is flattest."""
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


def _angle(ax: Axes, angle: SceneAngle, view: View) -> None:
    if not len(angle.arc):
        return
    arc, centre = view.points(angle.arc), view.points(angle.centre)
    _face(ax, np.concatenate([centre[None], arc]), ARC, 0.22, 3.0)
    _line(ax, arc, color=ARC, lw=1.5, zorder=5.2)
    if angle.about == "azimuth":
        for end in (arc[0], arc[-1]):
            _line(ax, np.array([centre, end]), color=ARC, lw=0.8, zorder=5.1)


def _face(ax: Axes, points: Numbers, colour: str, alpha: float, zorder: float) -> None:
    ax.add_patch(Polygon(points, fc=colour, ec="none", alpha=alpha, zorder=zorder))


def _line(ax: Axes, points: Numbers, **style: Any) -> None:
    ax.plot(points[:, 0], points[:, 1], solid_capstyle="round", **style)


_ELEVATIONS, _AZIMUTHS = (15.0, 24.0, 34.0, 46.0), np.arange(-180.0, 180.0, 15.0)
"""In degrees; the views among which one is chosen."""


class View(NamedTuple):
    """A direction of a parallel projection; elevation and azimuth in degrees."""

    elevation: float
    azimuth: float

    @property
    def sheet(self) -> Numbers:
        """The directions to the right and up on the sheet, and towards who looks, a row each."""
        c, s = np.cos(np.radians(self.azimuth)), np.sin(np.radians(self.azimuth))
        flat, high = np.cos(np.radians(self.elevation)), np.sin(np.radians(self.elevation))
        right, up = (-s, c, 0.0), (-high * c, -high * s, flat)
        return np.array([right, up, (flat * c, flat * s, high)])

    def points(self, points: Numbers) -> Numbers:
        """Return points of space (..., 3) on the sheet (..., 2)."""
        return np.asarray(points) @ self.sheet[:2].T


def chosen_view(scene: Scene, aspect: float) -> View:
    """Return the view in which nodes and rays are farthest apart, and surfaces are seen best."""
    views = [View(elevation, float(azimuth)) for elevation in _ELEVATIONS for azimuth in _AZIMUTHS]
    return max(views, key=lambda view: _merit(scene, view, aspect))


def _merit(scene: Scene, view: View, aspect: float) -> float:
    at = view.points(np.array([node.at for node in scene.nodes]))
    ends = view.points(np.array([(ray.tail, ray.head) for ray in scene.rays]))
    width, height = np.ptp(np.concatenate([at, ends.reshape(-1, 2)]), axis=0)
    size = max(width / aspect, height, 1e-9)
    # Nodes are far from one another, and from rays that pass them.
    distances = [float(np.linalg.norm(one - other)) for one, other in combinations(at, 2)]
    for ray, (tail, head) in zip(scene.rays, ends, strict=True):
        way = head - tail
        share = np.clip((at - tail) @ way / max(float(way @ way), 1e-30), 0.0, 1.0)
        apart = np.linalg.norm(at - tail - np.outer(share, way), axis=1)
        passed = [node.name not in (ray.start, ray.end) for node in scene.nodes]
        distances += [*(1.5 * apart[passed])]
    # Ellipses and surfaces are seen from aside, and rays not along themselves.
    towards = view.sheet[2]
    faces = [abs(float(ray.axes[2] @ towards)) for ray in scene.rays]
    faces += [abs(float(n.normal @ towards)) for n in scene.nodes if n.normal is not None]
    seen = 0.1 + np.mean(np.minimum(faces, 0.5)) + 0.8 * min(*faces, 0.3)
    ahead = np.mean([ray.axes[2] @ view.sheet[0] for ray in scene.rays])
    return float(min(distances, default=size) / size * seen * (1.0 + 0.05 * ahead))


_HALF, _RADIUS = 0.3, 0.24
"""Half the side of a surface, and the radius of a plate, of the length of a link."""


def outline(scene: Scene, node: SceneNode) -> Numbers:
    """Return the outline of a surface or a plate. Shape: returns (points, 3)."""
    normal, across = np.asarray(node.normal), np.asarray(node.across)
    along = np.cross(normal, across)
    if node.role == "plate":
        angle = np.linspace(0.0, 2.0 * np.pi, 49)[:, np.newaxis]
        circle = np.cos(angle) * across + np.sin(angle) * along
        return np.asarray(node.at + _RADIUS * scene.unit * circle)
    met = [ray.head for ray in scene.rays if ray.end == node.name]
    met += [ray.tail for ray in scene.rays if ray.start == node.name]
    # As far as light meets it, and half a side more.
    half, sides = _HALF * scene.unit, np.array([across, along]).T
    places = np.array([0.0 * node.at, *(point - node.at for point in met)]) @ sides
    (left, low), (right, high) = places.min(axis=0) - half, places.max(axis=0) + half
    corners = [(left, low), (right, low), (right, high), (left, high)]
    return np.array([node.at + a * across + b * along for a, b in corners])


def prepared_sheet(ax: Axes, points: float, usual: float) -> tuple[float, Bbox]:
    """Return the size of letters, of so many points where axes are as wide as usual, and the room.

    Shape: the room is in pixels.
    """
    ax.set_axis_off()
    figure: Any = ax.figure.figure
    figure.draw_without_rendering()  # Until then nobody knows how large axes are.
    whole = ax.get_window_extent()
    return points * float(np.clip(whole.width / figure.dpi / usual, 0.62, 1.1)), whole.padded(-2.0)


def write_notes(ax: Axes, notes: Sequence[str], points: float, room: Bbox) -> Bbox:
    """Write notes at the lower edge, and return the room above them."""
    said = broken("; ".join(notes), 0.88 * room.width / ax.figure.figure.dpi, points)
    style: dict[str, Any] = {"fontsize": points, "color": FAINT, "ha": "center", "va": "bottom"}
    text = ax.text(0.5, 0.0, said, transform=ax.transAxes, **style)
    below = text.get_window_extent().y1 + 2.0 if said else room.y0
    return Bbox.from_extents(room.x0, below, room.x1, room.y1)


def fit(ax: Axes, points: Numbers, around: Any, room: Bbox, longest: float) -> None:
    """Set limits by which points (n, 2) and what is around fill a part of the axes in pixels."""
    low, high = points.min(axis=0), points.max(axis=0)
    wide, tall = high - low + 2.0 * around
    per_unit = min(room.width / wide, room.height / tall, longest)
    set_limits(ax, (low + high) / 2.0, np.array([room.min, room.max]).mean(axis=0), per_unit)


def set_limits(ax: Axes, point: Numbers, pixel: Numbers, per_unit: float) -> None:
    """Set limits by which a point (2,) lies on a pixel, and a unit is so many pixels long."""
    whole = ax.get_window_extent()
    left, bottom = point - (pixel - [whole.x0, whole.y0]) / per_unit
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlim(left, left + whole.width / per_unit)
    ax.set_ylim(bottom, bottom + whole.height / per_unit)
