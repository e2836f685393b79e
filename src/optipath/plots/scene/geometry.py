"""A path drawn in space, as it is seen from aside."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.transforms import Bbox

from optipath.errors import OptipathError
from optipath.errors import shown as said
from optipath.plots.axes import own_axes
from optipath.plots.colors import INK
from optipath.plots.labels import Label, place_labels
from optipath.plots.scene.drawn_scene import (
    View,
    chosen_view,
    draw_scene,
    key_to,
    set_limits,
    write_notes,
)
from optipath.plots.scene.layout import scene_of
from optipath.plots.text import draw_key

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from optipath.paths.path_graph import PathGraph
    from optipath.plots.scene.scene import Scene
    from optipath.values.precision import Numbers


_SIZE = 8.0, 6.0
_USUAL = 620.0
"""The mean of width and height, in hundredths of an inch, at which texts are of 9 points."""

_LONGEST = 0.6
"""How long a link is drawn at most, of the height or the width."""


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
        The path.
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

    Raises
    ------
    PathError
        If the values are those of several paths.
    OptipathError
        If `ax` or `view` is none, or what is given is no path.

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
    ax.set_axis_off()
    figure: Any = ax.figure.figure
    figure.draw_without_rendering()  # Until then nobody knows how large axes are.
    whole, dots = ax.get_window_extent(), figure.dpi / 100.0
    size = 9.0 * float(np.clip(np.sqrt(whole.width * whole.height) / dots / _USUAL, 0.62, 1.1))
    notes = write_notes(ax, scene.notes, 0.85 * size)
    at: dict[str, Any] = {"loc": "lower center", "borderaxespad": 0.0}
    at["bbox_to_anchor"] = 0.5, (notes - whole.y0 + 2.0) / whole.height
    looks: dict[str, Any] = {"fontsize": 0.9 * size, "columnspacing": 1.4, "handlelength": 1.6}
    handles = key_to(scene)
    below = draw_key(ax, handles, len(handles), **at, **looks).get_window_extent().y1
    room = Bbox.from_extents(whole.x0 + 2, below + 4, whole.x1 - 2, whole.y1 - 2)
    seen_from = seen_from or chosen_view(scene, room.width / room.height)
    draw_scene(ax, scene, seen_from, size / 9.0)
    lines = [np.asarray(line.get_xydata()) for line in ax.lines]
    faces = [np.asarray(patch.get_path().vertices) for patch in ax.patches]
    _fit(ax, scene, [*lines, *faces], room)
    place_labels(ax, _labels(scene, seen_from, size), lines, room)
    return ax


def _view_argument(view: Any) -> View:
    try:
        elevation, azimuth = (float(angle) for angle in view)
    except (TypeError, ValueError):
        elevation = azimuth = np.nan
    if not np.isfinite([elevation, azimuth]).all():
        raise OptipathError(f"view is {said(view)}; give elevation and azimuth, as (24, -60)")
    return View(elevation, azimuth)


def _fit(ax: Axes, scene: Scene, drawn: list[Numbers], room: Bbox) -> None:
    """Set limits by which what is drawn fills a part of the axes."""
    points = np.concatenate(drawn)
    low, high = points.min(axis=0), points.max(axis=0)
    free = np.array([room.width, room.height])
    free -= 2.0 * (0.06 * free + 8.0)
    per_unit = float(np.min(free / np.maximum(high - low, 0.01 * scene.unit)))
    per_unit = min(per_unit, _LONGEST * min(room.width, room.height) / scene.unit)
    middle = np.array([room.x0 + room.x1, room.y0 + room.y1]) / 2.0
    set_limits(ax, (low + high) / 2.0, middle, per_unit)


def _labels(scene: Scene, view: View, size: float) -> list[Label]:
    bold = {"fontsize": size * 1.1, "fontweight": "bold", "color": INK}
    results = [Label(node.name, view.points(node.at), bold) for node in scene.nodes]
    style = {"fontsize": size, "color": ANGLE_INK}
    return results + [Label(a.text, view.points(a.at), style, _LEADS_SOON) for a in scene.angles]


_LEADS_SOON = 0.7
"""From which distance on a line leads to the name of an angle, in heights of a line."""

ANGLE_INK = "#8b3f71"
"""Of the names of angles: the colour of their arcs, dark enough to read."""
