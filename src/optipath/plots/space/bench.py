"""A path drawn flat, with the symbols of an optical bench."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Polygon
from matplotlib.transforms import Bbox

from optipath.plots.line_colours import FAINT, INK
from optipath.plots.own_axes import own_axes
from optipath.plots.space.bench_symbols import ELLIPSE, dial, draw_symbol
from optipath.plots.space.bench_texts import values_below
from optipath.plots.space.flat_sheet import direction_at, flat_sheet, in_rows
from optipath.plots.space.placed_labels import Label, place_labels
from optipath.plots.space.scene_of import scene_with
from optipath.plots.space.told_values import ToldPath
from optipath.plots.states.ellipse_points import ellipse_points

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph
    from optipath.plots.space.flat_sheet import FlatRay, FlatSheet
    from optipath.plots.space.scene import Scene, SceneRay

    Array = npt.NDArray[np.float64]

_WIDTH, _ROW, _PLANE = 9.0, 2.1, 5.4
"""The width of a picture of its own, and the height of one row, or of a plane, in inches."""

_POINTS = 8.5
_LETTER = 0.6
"""How wide a letter is about, in heights of a line."""

_ABOVE, _BELOW = 0.45, 0.38
"""What is free above the beam and between the beam and the names, in lengths of a link."""

_DIALS = "dials show what is seen when one looks at the source: x of the frame to the right, y up"
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
        If `ax` is none.

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
    if ax is None:
        rows = in_rows(flat, scene, _most(widest, _WIDTH, _POINTS))
        count = len({float(at[1]) for at in rows.at.values()})
        ax = own_axes(None, (_WIDTH, _ROW * count + 0.4 if flat.straight else _PLANE))
    ax = own_axes(ax, (_WIDTH, _ROW))
    ax.set_axis_off()
    figure: Any = ax.get_figure(root=True)
    figure.draw_without_rendering()  # Until then nobody knows how large axes are.
    whole, inch = ax.get_window_extent(), figure.dpi
    size = _POINTS * float(np.clip(whole.width / inch / _WIDTH, 0.66, 1.1))
    flat = in_rows(flat, scene, _most(widest, whole.width / inch, size))
    below = _note(ax, scene, size)
    room = Bbox.from_extents(whole.x0 + 2, below + 3, whole.x1 - 2, whole.y1 - 2)
    lines = max(map(len, texts.values())) * 1.3 * size * inch / 72.0 if flat.straight else 0.0
    _fit(ax, flat, room, lines)
    _draw(ax, scene, flat)
    if flat.straight:
        _write_below(ax, flat, texts, size)
    else:
        _write_beside(ax, scene, flat, texts, (size, room))
    return ax


def _most(widest: int, inches: float, points: float) -> int:
    """Return how many nodes may stand in a row of so many inches."""
    return max(int(inches * 72.0 / ((widest + 1.5) * _LETTER * points)), 2)


def _note(ax: Axes, scene: Scene, size: float) -> float:
    """Write at the lower edge what was chosen, and return how high that reaches in pixels."""
    figure: Any = ax.get_figure(root=True)
    whole = ax.get_window_extent()
    columns = int(whole.width / (0.52 * 0.85 * size * figure.dpi / 72.0))
    said = textwrap.fill("; ".join([_DIALS, *scene.notes]), max(columns, 20))
    style: Any = {"fontsize": 0.85 * size, "color": FAINT, "ha": "center", "va": "bottom"}
    text = ax.text(0.5, 0.0, said, transform=ax.transAxes, **style)
    return float(text.get_window_extent().y1)


def _fit(ax: Axes, flat: FlatSheet, room: Bbox, lines: float) -> None:
    """Set limits by which a sheet fills a part of the axes; texts below take so many pixels."""
    points = np.array([*flat.at.values(), *(p for ray in flat.rays for p in np.vstack(ray.pieces))])
    low, high = points.min(axis=0), points.max(axis=0)
    side = 0.5 if flat.straight else 0.8
    wide, tall = high - low + [2.0 * side, _ABOVE + (_BELOW if flat.straight else _ABOVE)]
    per_unit = min(room.width / wide, (room.height - lines) / tall)
    whole = ax.get_window_extent()
    middle = np.array([(room.x0 + room.x1) / 2.0, (room.y0 + lines + room.y1) / 2.0])
    down = (_ABOVE - _BELOW) / 2.0 if flat.straight else 0.0
    centre = (low + high) / 2.0 + [0.0, down]
    left, bottom = centre - (middle - [whole.x0, whole.y0]) / per_unit
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlim(left, left + whole.width / per_unit)
    ax.set_ylim(bottom, bottom + whole.height / per_unit)


def _draw(ax: Axes, scene: Scene, flat: FlatSheet) -> None:
    for ray, drawn in zip(scene.rays, flat.rays, strict=True):
        _beam(ax, ray, drawn)
    for node in scene.nodes:
        normal = None if node.normal is None else flat.sheet @ node.normal
        at, way = flat.at[node.name], direction_at(node, scene, flat)
        draw_symbol(ax, node, at, way, normal)
        if node.axis is not None:
            frames = [frame for frame in scene.frames if frame.port == f"{node.name}.in"]
            turned = frames[0].axes[:2] @ node.axis
            dial(ax, at, np.array([-turned, turned]), INK)


def _beam(ax: Axes, ray: SceneRay, drawn: FlatRay) -> None:
    colour, width = (FAINT, 0.8) if ray.leaves else (INK, 1.2)
    for tail, head in drawn.pieces:
        style = (0, (4, 2)) if ray.tap else "-"
        ax.plot(*np.array([tail, head]).T, color=colour, lw=width, ls=style, zorder=3)
        along = (head - tail) / np.linalg.norm(head - tail)
        tip = head if ray.leaves or len(drawn.pieces) > 1 else tail + 0.3 * (head - tail)
        aside = 0.025 * np.array([-along[1], along[0]])
        foot = tip - 0.08 * along
        ax.add_patch(Polygon([tip, foot + aside, foot - aside], fc=colour, ec="none", zorder=3.1))
    if not ray.leaves and ray.light.intensity > 0.0:
        _polarisation(ax, ray.light, drawn.middle)


def _polarisation(ax: Axes, light: Light, at: Array) -> None:
    """Draw the ellipse of light in a dial, and a star for light that has none."""
    if light.dop > 1e-9:
        points = ellipse_points(light, 49) * min(float(light.dop), 1.0)
        dial(ax, at, points, ELLIPSE)
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
    turn = np.linspace(0.0, 2.0 * np.pi, 25)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    lines = [piece for ray in flat.rays for piece in ray.pieces]
    lines += [ray.middle + r * circle for ray in flat.rays for r in (0.08, 0.16)]
    for node in scene.nodes:
        reach = 0.3 if node.normal is not None else 0.18
        lines += [flat.at[node.name] + r * reach * circle for r in (0.4, 0.7, 1.0)]
    style = {"fontsize": size, "color": INK, "linespacing": 1.15}
    labels = [Label("\n".join(told), flat.at[name], style, 1.0) for name, told in texts.items()]
    place_labels(ax, labels, lines, room)
