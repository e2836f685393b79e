"""A path drawn flat, with the symbols of an optical bench."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.transforms import Bbox

from optipath.plots.line_colours import FAINT, INK
from optipath.plots.own_axes import own_axes
from optipath.plots.space.bench_symbols import DIAL, ELLIPSE, dial, draw_symbol
from optipath.plots.space.bench_texts import values_below
from optipath.plots.space.drawn_scene import draw_head, draw_turn
from optipath.plots.space.flat_sheet import direction_at, flat_sheet, in_rows, nearest_symbols
from optipath.plots.space.placed_labels import Label, place_labels
from optipath.plots.space.scene_of import LARGEST_ELLIPSE, scene_with
from optipath.plots.space.solids import outline
from optipath.plots.space.told_values import ToldPath
from optipath.values.cures import cure

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.paths.path_graph import PathGraph
    from optipath.plots.space.flat_sheet import FlatRay, FlatSheet
    from optipath.plots.space.scene import Scene, SceneNode, SceneRay

    Array = npt.NDArray[np.float64]

_WIDTH, _ROW, _PLANE = 9.0, 2.1, 5.4
"""The width of a picture of its own, and the height of one row, or of a plane, in inches."""

_POINTS = 8.5
_LETTER = 0.6
"""How wide a letter is about, in heights of a line."""

_ABOVE, _BELOW, _BESIDE = 0.4, 0.38, np.array([0.8, 0.45])
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
    OptipathError
        If `ax` is none, or what is given is no path.

    Examples
    --------
    >>> import optipath as op
    >>> ax = op.plots.bench(op.load_preset("malus"), angle="30 deg")
    >>> sorted(text.get_text().replace("\n", ", ") for text in ax.texts)[0]
    'analyzer, angle = 30 deg'
    """
    told = ToldPath(path, "bench", values)
    scene = scene_with(told)
    flat = flat_sheet(scene)
    texts = {
        node.name: [node.name, *values_below(told.wiring.elements[node.name])]
        for node in scene.nodes
    }
    widest = max(len(line) for lines in texts.values() for line in lines)
    rows = -(-len(flat.at) // _most(widest, _WIDTH, _POINTS))
    ax = own_axes(ax, (_WIDTH, _ROW * rows + 0.4 if flat.straight else _PLANE))
    ax.set_axis_off()
    figure: Any = ax.figure.figure
    figure.draw_without_rendering()  # Until then nobody knows how large axes are.
    whole, inch = ax.get_window_extent(), figure.dpi
    size = _POINTS * float(np.clip(whole.width / inch / _WIDTH, 0.66, 1.1))
    below = _note(ax, scene, flat, size)
    room = Bbox.from_extents(whole.x0 + 2, below + 3, whole.x1 - 2, whole.y1 - 2)
    if flat.straight:
        lines = (max(map(len, texts.values())) + 0.7) * 1.3 * size * inch / 72.0
        most = _most(widest, whole.width / inch, size)
        flat = _fit_rows(ax, scene, flat, most, (room, lines))
    else:
        _fit_plane(ax, flat, room)
    _draw(ax, scene, flat)
    drawn: list[Any] = [*ax.lines, *ax.patches]
    for line in drawn:
        line.set_linewidth(min(size / _POINTS, 1.0) * line.get_linewidth())
    if flat.straight:
        _write_below(ax, flat, texts, size)
    else:
        _write_beside(ax, scene, flat, texts, (size, room))
    return ax


def _most(widest: int, inches: float, points: float) -> int:
    """Return how many nodes may stand in a row of so many inches."""
    return max(int(inches * 72.0 / ((widest + 1.5) * _LETTER * points)), 2)


def _note(ax: Axes, scene: Scene, flat: FlatSheet, size: float) -> float:
    """Write at the lower edge what was chosen, and return how high that reaches in pixels."""
    figure: Any = ax.figure.figure
    whole = ax.get_window_extent()
    columns = int(whole.width / (0.52 * 0.85 * size * figure.dpi / 72.0))
    notes = [_DIALS, *scene.notes]
    if not flat.straight and nearest_symbols(scene, flat) < 2.0 * DIAL:
        way = cure("op.plots.geometry(path)", "--kind geometry")
        notes.append(f"symbols lie over one another: {way} draws this path in space")
    said = textwrap.fill("; ".join(notes), max(columns, 20))
    style: Any = {"fontsize": 0.85 * size, "color": FAINT, "ha": "center", "va": "bottom"}
    text = ax.text(0.5, 0.0, said, transform=ax.transAxes, **style)
    return float(text.get_window_extent().y1)


def _fit_rows(
    ax: Axes, scene: Scene, flat: FlatSheet, most: int, where: tuple[Bbox, float]
) -> FlatSheet:
    """Return a straight set-up in rows of so many nodes at most, which fill a part of the axes.

    Below each row there is room for texts, so many pixels high.
    """
    room, lines = where
    rows = -(-len(flat.at) // most)
    each = -(-len(flat.at) // rows)
    step, row = room.width / each, room.height / rows
    per_unit = max(min(step, (row - lines) / (_ABOVE + _BELOW)), 1.0)
    row = min(row, lines + _ROOMY * per_unit)
    found = in_rows(flat, scene, each, (step / per_unit, row / per_unit))
    spare = (room.height - rows * row) / 2.0
    first = np.array([room.x0 + step / 2.0, room.y1 - spare - _ABOVE * per_unit])
    _set_limits(ax, np.zeros(2), first, per_unit)
    return found


def _fit_plane(ax: Axes, flat: FlatSheet, room: Bbox) -> None:
    """Set limits by which a sheet fills a part of the axes, with room for texts beside it."""
    points = np.array([*flat.at.values(), *(p for ray in flat.rays for p in np.vstack(ray.pieces))])
    low, high = points.min(axis=0), points.max(axis=0)
    wide, tall = high - low + 2.0 * _BESIDE
    per_unit = min(room.width / wide, room.height / tall, _LONGEST * room.height)
    middle = np.array([room.x0 + room.x1, room.y0 + room.y1]) / 2.0
    _set_limits(ax, (low + high) / 2.0, middle, per_unit)


def _set_limits(ax: Axes, point: Array, pixel: Array, per_unit: float) -> None:
    """Set limits by which a point lies on a pixel."""
    whole = ax.get_window_extent()
    left, bottom = point - (pixel - [whole.x0, whole.y0]) / per_unit
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlim(left, left + whole.width / per_unit)
    ax.set_ylim(bottom, bottom + whole.height / per_unit)


def _draw(ax: Axes, scene: Scene, flat: FlatSheet) -> None:
    for ray, drawn in zip(scene.rays, flat.rays, strict=True):
        _beam(ax, ray, flat, drawn)
    for node in scene.nodes:
        at, way = flat.at[node.name], direction_at(node, scene, flat)
        draw_symbol(ax, node, at, way, _face(scene, flat, node))
        if node.axis is not None:
            axes = next(frame.axes for frame in scene.frames if frame.port == f"{node.name}.in")
            dial(ax, at, flat.in_dial(axes, np.array([-node.axis, node.axis])), INK)


def _face(scene: Scene, flat: FlatSheet, node: SceneNode) -> Array | None:
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
    if not (ray.leaves or ray.is_dark):
        _polarisation(ax, ray, flat, drawn.middle)


def _polarisation(ax: Axes, ray: SceneRay, flat: FlatSheet, at: Array) -> None:
    """Draw the ellipse of light in a dial, and a star for light that has none."""
    if ray.ellipse is not None:
        points = flat.in_dial(ray.axes, ray.ellipse) / (LARGEST_ELLIPSE * flat.unit)
        seen = dial(ax, at, points, ELLIPSE)
        if ray.turns:
            draw_turn(ax, seen, 1.0, ELLIPSE, zorder=6.2)
        return
    dial(ax, at, np.zeros((0, 2)), FAINT)
    for way in 0.6 * _STAR:
        dial_line = np.array([at - 0.15 * way, at + 0.15 * way])
        ax.plot(*dial_line.T, color=FAINT, lw=1.0, zorder=6.1)


def _write_below(ax: Axes, flat: FlatSheet, texts: dict[str, list[str]], size: float) -> None:
    for name, lines in texts.items():
        at = flat.at[name] - [0.0, _BELOW]
        style: Any = {"fontsize": size, "ha": "center", "va": "top", "linespacing": 1.15}
        ax.text(at[0], at[1], "\n".join(lines), color=INK, **style)


def _write_beside(
    ax: Axes,
    scene: Scene,
    flat: FlatSheet,
    texts: dict[str, list[str]],
    where: tuple[float, Bbox],
) -> None:
    """Write texts where they cover neither beams nor symbols."""
    size, room = where
    lines = [np.array(line.get_xydata()) for line in ax.lines]
    style = {"fontsize": size, "color": INK, "linespacing": 1.15}
    labels = [
        Label("\n".join(texts[n.name]), flat.at[n.name], style, 2.0 if n.normal is None else 0.8)
        for n in scene.nodes
    ]
    place_labels(ax, labels, lines, room, ax.patches)
