"""Optical bench: a path drawn flat, with symbols."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Circle, Polygon, Wedge

from optipath.elements.boundary import BoundaryElement
from optipath.elements.medium import Medium
from optipath.errors import PathError
from optipath.plots.axes import own_axes
from optipath.plots.colors import FAINT, INK, LINES
from optipath.plots.labels import Label, place_labels
from optipath.plots.scene.geometry import (
    draw_head,
    draw_turn,
    fit,
    outline,
    prepared_sheet,
    set_limits,
    write_notes,
)
from optipath.plots.scene.layout import (
    LARGEST_ELLIPSE,
    angles_in_chain,
    scene_of,
    shown_incidence,
    shown_value,
)
from optipath.plots.scene.placing import angles_at, has_axis, number
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.transforms import Bbox

    from optipath.elements.element import Element
    from optipath.paths.path_graph import PathGraph
    from optipath.plots.scene.layout import Scene, SceneNode, SceneRay
    from optipath.values.precision import Numbers


_WIDTH, _ROW, _PLANE = 9.0, 2.1, 5.4
"""The width of a picture of its own, and the height of one row, or of a plane, in inches."""

_POINTS = 8.5
_LETTER = 0.6
"""How wide a letter is about, in heights of a line."""

_ABOVE, _BELOW, _ASIDE = 0.4, 0.38, np.array([0.8, 0.45])
"""What is free above a beam, between it and names below, and around a plane, in links."""

_ROOMY, _LONGEST = 1.3, 0.45
"""The height of a row at most, and the length of a link in a plane, of the height."""

_DIALS = (
    "dials show what is seen when one looks at the source: to the right, what stands across this "
    "sheet; up, what lies in it"
)
_STAR = np.array([[np.cos(a), np.sin(a)] for a in np.radians([0.0, 60.0, 120.0])])


def bench(path: PathGraph, ax: Axes | None = None, **values: Any) -> Axes:
    r"""Draw a set-up that lies in one plane: lamp, plates, surfaces, detectors, and light.

    Parameters
    ----------
    path : PathGraph
        The path; its light stays in one plane.
    ax : Axes, optional
        Where; by default in a figure of its own. Long straight benches take several rows.
    **values : float or str
        As in `PathGraph.trace`, a single number each.

    Returns
    -------
    Axes

    Raises
    ------
    PathError
        If light leaves the plane, or the values are those of several paths.

    Examples
    --------
    >>> import optipath as op
    >>> ax = op.plots.bench(op.load_preset("malus"), angle="30 deg")
    >>> sorted(text.get_text().replace("\n", ", ") for text in ax.texts)[0]
    'analyzer, angle = 30 deg'
    """
    scene = scene_of(path, "bench", **values)
    flat = flat_sheet(scene)
    texts = {node.name: [node.name, *values_below(node.element)] for node in scene.nodes}
    widest = max(len(line) for lines in texts.values() for line in lines)
    rows = -(-len(flat.at) // _most(widest, _WIDTH, _POINTS))
    ax = own_axes(ax, (_WIDTH, _ROW * rows + 0.4 if flat.straight else _PLANE))
    size, room = prepared_sheet(ax, _POINTS, _WIDTH)
    notes = [_DIALS, *scene.notes]
    if not flat.straight and nearest_symbols(scene, flat) < 2.0 * DIAL:
        notes.append("symbols lie over one another: the picture 'geometry' has this path in space")
    room, inch = write_notes(ax, notes, 0.85 * size, room), ax.figure.figure.dpi
    if flat.straight:
        high = (max(map(len, texts.values())) + 0.7) * 1.3 * size * inch / 72.0
        most = _most(widest, room.width / inch, size)
        flat = _fit_rows(ax, scene, flat, most, (room, high))
    else:
        pieces = [np.vstack(ray.pieces) for ray in flat.rays]
        points = np.concatenate([[*flat.at.values()], *pieces])
        fit(ax, points, _ASIDE, room, _LONGEST * room.height)
    _draw(ax, scene, flat)
    drawn: list[Any] = [*ax.lines, *ax.patches]
    for line in drawn:
        line.set_linewidth(min(size / _POINTS, 1.0) * line.get_linewidth())
    style: dict[str, Any] = {"fontsize": size, "color": INK, "linespacing": 1.15}
    if flat.straight:
        for name, lines in texts.items():
            x, y = flat.at[name]
            ax.text(x, y - _BELOW, "\n".join(lines), ha="center", va="top", **style)
        return ax
    labels = [
        Label("\n".join(texts[n.name]), flat.at[n.name], style, 2.0 if n.normal is None else 0.8)
        for n in scene.nodes
    ]
    beams = [np.asarray(line.get_xydata()) for line in ax.lines]
    place_labels(ax, labels, beams, room, ax.patches)
    return ax


def _most(widest: int, inches: float, points: float) -> int:
    """Return how many nodes may stand in a row of so many inches."""
    return max(int(inches * 72.0 / ((widest + 1.5) * _LETTER * points)), 2)


def _fit_rows(
    ax: Axes, scene: Scene, flat: FlatSheet, most: int, where: tuple[Bbox, float]
) -> FlatSheet:
    """Return a straight set-up in rows of so many nodes at most, with room for texts in pixels."""
    room, lines = where
    rows = -(-len(flat.at) // most)
    each = -(-len(flat.at) // rows)
    step, row = room.width / each, room.height / rows
    per_unit = max(min(step, (row - lines) / (_ABOVE + _BELOW)), 1.0)
    row = min(row, lines + _ROOMY * per_unit)
    spare = (room.height - rows * row) / 2.0
    first = np.array([room.x0 + step / 2.0, room.y1 - spare - _ABOVE * per_unit])
    set_limits(ax, np.zeros(2), first, per_unit)
    order = sorted(flat.at, key=lambda name: float(flat.at[name][0]))
    at = {
        name: np.array([step * (place % each), -row * (place // each)]) / per_unit
        for place, name in enumerate(order)
    }
    rays, half = [], np.array([step / per_unit / 2.0, 0.0])
    for ray in scene.rays:
        tail = at[ray.start]
        head = at[ray.end] if ray.end else tail + half
        if tail[1] == head[1]:
            rays.append(FlatRay((np.array([tail, head]),), (tail + head) / 2.0))
            continue
        # What goes on in the next row goes as far as the middle between two nodes.
        pieces = np.array([tail, tail + half]), np.array([head - half, head])
        rays.append(FlatRay(pieces, head - half + [min(_FROM_EDGE, 0.5 * half[0]), 0.0]))
    return flat._replace(at=at, rays=tuple(rays))


def _draw(ax: Axes, scene: Scene, flat: FlatSheet) -> None:
    for ray, drawn in zip(scene.rays, flat.rays, strict=True):
        _beam(ax, ray, flat, drawn)
    for node in scene.nodes:
        at = flat.at[node.name]
        rays = [ray for ray in scene.rays if ray.end == node.name]
        rays += [ray for ray in scene.rays if ray.start == node.name]
        # Of light that arrives, or else that leaves.
        draw_symbol(ax, node, at, flat.sheet @ rays[0].axes[2], _face(scene, flat, node))
        if node.axis is not None:
            _, axes = scene.frames[f"{node.name}.in"]
            dial(ax, at, flat.in_dial(axes, np.array([-node.axis, node.axis])), INK)


def _face(scene: Scene, flat: FlatSheet, node: SceneNode) -> Numbers | None:
    """Return the normal of a surface on the sheet, and its two ends."""
    if node.normal is None or node.role == "plate":
        return None
    normal = flat.sheet @ node.normal
    across = np.array([-normal[1], normal[0]])
    corners = (outline(scene, node) - node.at) @ flat.sheet.T @ across / scene.unit
    at = flat.at[node.name]
    return np.array([normal, at + corners.min() * across, at + corners.max() * across])


def _beam(ax: Axes, ray: SceneRay, flat: FlatSheet, drawn: FlatRay) -> None:
    colour, width = (FAINT, 0.8) if ray.leaves or ray.is_dark else (INK, 1.2)
    style: Any = (0, (1, 2)) if ray.is_dark else (0, (4, 2)) if ray.tap else "-"
    for tail, head in drawn.pieces:
        ax.plot(*np.array([tail, head]).T, color=colour, lw=width, ls=style, zorder=3)
        tip = head if ray.leaves or len(drawn.pieces) > 1 else tail + 0.3 * (head - tail)
        draw_head(ax, tip, head - tail, np.array([0.08, 0.025]), fc=colour, zorder=3.1)
    if ray.leaves or ray.is_dark:
        return
    at = drawn.middle
    if ray.ellipse is not None:
        points = flat.in_dial(ray.axes, ray.ellipse) / (LARGEST_ELLIPSE * flat.unit)
        seen = dial(ax, at, points, ELLIPSE)
        if ray.turns:
            draw_turn(ax, seen, 1.0, ELLIPSE, zorder=6.2)
        return
    dial(ax, at, np.zeros((0, 2)), FAINT)
    for way in 0.09 * _STAR:  # For light that has no polarisation.
        ax.plot(*np.array([at - way, at + way]).T, color=FAINT, lw=1.0, zorder=6.1)


BLUE, ELLIPSE, _, _, FACE, LAMP = LINES
HIGH = 0.26
"""Half the height of a plate or the length of a surface."""

DIAL = 0.15
"""The radius of the dials in which axes and polarisation are seen face on."""

_LAYERS = {"layer-stack": 3}
_PALE = tuple(0.55 + 0.45 * part for part in to_rgb(FACE))
_SPLITTING = ("beam-splitter", "polarizing-beam-splitter")
_THIN: Any = (0.045, HIGH, "#bbbbbb", INK)
_BOXES: dict[str, Any] = {
    **dict.fromkeys(
        ("retarder", "waveplate", "elliptical-retarder", "medium"), (0.11, HIGH, _PALE, BLUE)
    ),
    **dict.fromkeys(("rotator", "faraday-rotator"), (0.2, 0.2, "#f7ecd0", INK)),
    **dict.fromkeys(_SPLITTING, (0.2, 0.2, _PALE, BLUE)),
}
"""Half the length and the height of the symbol of a kind, its face and its edge."""


def draw_symbol(ax: Axes, node: SceneNode, at: Numbers, way: Numbers, face: Numbers | None) -> None:
    """Draw the symbol of an element. Shapes: at (2,); way (2,); face (3, 2)."""
    if node.role == "source":
        # No name stands between its rays.
        ax.add_patch(Circle(tuple(at), 0.19, fc="none", ec="none"))
        for angle in np.arange(0.0, 2.0 * np.pi, np.pi / 4.0):
            ray = np.array([np.cos(angle), np.sin(angle)])
            ax.plot(*np.array([at + 0.13 * ray, at + 0.19 * ray]).T, color=INK, lw=1.0, zorder=5)
        _add(ax, Circle(tuple(at), 0.1, fc=LAMP, ec=INK))
    elif node.role == "detector":
        angle = float(np.degrees(np.arctan2(way[1], way[0])))
        _add(ax, Wedge(tuple(at), 0.17, angle - 90.0, angle + 90.0, fc="#555555", ec=INK))
    elif node.role == "dump":
        _box(ax, at + 0.1 * way, way, (0.1, 0.14, "white", INK))
    elif node.role == "plate" or node.kind in _SPLITTING:
        _box(ax, at, way, _BOXES.get(node.kind, _THIN))
        if node.kind in _SPLITTING and face is not None:
            middle = (face[1] + face[2]) / 2.0
            ends = middle + 0.45 * (face[1:] - middle)
            ax.plot(*ends.T, color=BLUE, lw=1.6, zorder=5)
    elif face is None or np.linalg.norm(face[0]) < 0.5:
        _add(ax, Circle(tuple(at), 0.07, fc="white", ec=INK))
    else:
        normal, *edge = face
        layers, is_mirror = _LAYERS.get(node.kind, 1), node.role == "mirror"
        depth = max(0.05 * (layers - 1), 0.09) * normal
        corners = np.array([edge[0], edge[1], edge[1] - depth, edge[0] - depth])
        _add(ax, Polygon(corners, fc="#9a9a9a" if is_mirror else _PALE, ec="none"), 4.0)
        for layer in range(layers):
            line = np.array(edge) - 0.05 * layer * normal
            ax.plot(*line.T, color=INK if is_mirror else BLUE, lw=1.6, zorder=5)


def dial(ax: Axes, at: Numbers, line: Numbers, colour: str, zorder: float = 6.0) -> Numbers:
    """Draw a dial at (2,) with a line (points, 2) as seen by one who looks at the source."""
    _add(ax, Circle(tuple(at), DIAL, fc="white", ec=FAINT, lw=0.7), zorder)
    # Who looks at the source has x to the right where y is up, and z comes to him.
    seen = at + 0.92 * DIAL * np.reshape(line, (-1, 2))
    if len(seen):
        style: Any = {"color": colour, "lw": 1.6, "solid_capstyle": "round"}
        ax.plot(*seen.T, zorder=zorder + 0.1, **style)
    return seen


def _box(ax: Axes, at: Numbers, way: Numbers, looks: tuple[float, float, Any, str]) -> None:
    length, height, face, edge = looks
    along, across = length * way, height * np.array([-way[1], way[0]])
    corners = [at - along - across, at + along - across, at + along + across, at - along + across]
    _add(ax, Polygon(np.array(corners), fc=face, ec=edge), 4.0)


def _add(ax: Axes, patch: Any, zorder: float = 5.0) -> None:
    patch.set(zorder=zorder, linewidth=min(patch.get_linewidth(), 0.9))
    ax.add_patch(patch)


_FIELDS = [
    *("angle", "retardance", "incidence", "reflectance", "thickness", "length", "verdet"),
    *("field", "dichroic_angle", "azimuth"),
]
"""What is told of an element, in this order."""

_ALWAYS = "angle", "incidence"


def values_below(element: Element) -> list[str]:
    """Return the values of an element that are written below its symbol."""
    domains, result = element.domains(), []
    for name in _FIELDS:
        if name == "angle" and isinstance(element, Medium) and not has_axis(element):
            continue
        if name in domains:
            value = getattr(element, name, None)
            if name == "incidence" and isinstance(element, BoundaryElement):
                result.append(shown_incidence(value, angles_at(element)[0]).text)
            else:
                result += _texts(name, value, domains[name].unit)
    incidence, turn = angles_in_chain(element)
    if incidence is not None:
        result.append(shown_incidence(incidence, number(incidence)).text)
    return result + _texts("azimuth", turn, "deg")


def _texts(name: str, value: Any, unit: str) -> list[str]:
    """Return the text of a value that is no array and not left at nothing."""
    is_named = isinstance(value, Parameter)
    if not is_named and (
        not isinstance(value, float | int) or (value == 0.0 and name not in _ALWAYS)
    ):
        return []
    said = shown_value(value, unit)
    bare = name == "angle" or (is_named and (name != "azimuth" or not said.there))
    return [said.text if bare else f"{name} {said.text}"]


_IN_PLANE = 1e-7
"""The sine of an angle out of the plane that is rounding."""


_FROM_EDGE = 0.2
"""How far from the edge polarisation is drawn, in lengths of a link."""


class FlatRay(NamedTuple):
    """A ray on a sheet. Shapes: pieces (2, 2); middle (2,)."""

    pieces: tuple[Numbers, ...]
    middle: Numbers


class FlatSheet(NamedTuple):
    """A scene on a sheet, a link being about 1 long. Shapes: sheet (2, 3); at (2,)."""

    sheet: Numbers
    at: dict[str, Numbers]
    rays: tuple[FlatRay, ...]
    straight: bool
    unit: float

    def in_dial(self, axes: Numbers, vectors: Numbers) -> Numbers:
        """Return transverse vectors (..., 2) as seen by one who looks at the source."""
        right = np.cross(self.sheet[1], self.sheet[0])
        return np.asarray(vectors @ np.array([right, np.cross(axes[2], right)]).T)


def flat_sheet(scene: Scene) -> FlatSheet:
    """Return a scene laid flat."""
    _, up, right = scene.rays[0].axes
    ways = np.array([ray.axes[2] for ray in scene.rays])
    aside = ways - np.outer(ways @ right, right)
    largest = max(aside, key=np.linalg.norm)
    straight = bool(np.linalg.norm(largest) < _IN_PLANE)
    if not straight:
        largest = largest / np.linalg.norm(largest)
        up = -largest if largest @ up < -_IN_PLANE else largest
    normal = np.cross(right, up)
    out = [ray.end or ray.start for ray in scene.rays if abs(ray.axes[2] @ normal) > _IN_PLANE]
    if out:
        raise PathError(
            f"bench draws set-ups in one plane, which light leaves at '{out[0]}'; draw 'geometry'"
        )
    sheet, origin = np.array([right, up]), scene.nodes[0].at
    at = {n.name: sheet @ (n.at - origin) / scene.unit for n in scene.nodes}
    ends = [
        np.array([ray.tail - origin, ray.head - origin]) @ sheet.T / scene.unit
        for ray in scene.rays
    ]
    flat = tuple(FlatRay((both,), both.mean(axis=0)) for both in ends)
    back = any(way @ right < 0.0 for way in ways)
    return FlatSheet(sheet, at, flat, straight and not back, scene.unit)


def nearest_symbols(scene: Scene, flat: FlatSheet) -> float:
    """Return how near two symbols are whose middles are nearest, dials of light included."""
    rays = zip(scene.rays, flat.rays, strict=True)
    dials = [drawn.middle for ray, drawn in rays if not (ray.leaves or ray.is_dark)]
    return min(
        (float(np.linalg.norm(a - b)) for a, b in combinations([*flat.at.values(), *dials], 2)),
        default=np.inf,
    )
