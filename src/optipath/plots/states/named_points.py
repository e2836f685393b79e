"""Names beside points of a flat picture, none over another."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Bbox

from optipath.plots.line_colours import FAINT, INK

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

_DISTANCES = 12.0, 20.0, 30.0, 42.0, 56.0
"""How far from its point a name may stand, in points of a font; the nearest free place is taken."""

_ROUND = 16

_ON_LINES, _ON_ONE = 50_000, 200
"""At how many points of all lines, and of one at most, it is looked for names over them."""

_OVER = 1000
"""By how many points of lines a place is worse that another name takes."""

HALO = (withStroke(linewidth=2.5, foreground="white"),)
"""What keeps names readable over lines."""

_LEADER: dict[str, Any] = {
    "textcoords": "offset points",
    "arrowprops": {
        "arrowstyle": "-",
        "color": FAINT,
        "linewidth": 0.6,
        "shrinkA": 5.0,
        "shrinkB": 3.0,
    },
    "zorder": 8,
}


def name_points(
    ax: Axes, points: npt.NDArray[np.float64], names: Sequence[str], size: str = "small"
) -> None:
    """Write names beside points, where neither points nor other texts are, with lines to them.

    Of places that are free, one with few lines behind it is taken.

    Shape: points (n, 2).
    """
    figure: Any = ax.figure.figure
    figure.draw_without_rendering()
    taken = [text.get_window_extent() for text in ax.texts if text.get_text()]
    pixels = ax.transData.transform(points)
    lines = _on_lines(ax)
    mark = 5.0 * figure.dpi / 72.0
    taken += [Bbox.from_bounds(x - mark, y - mark, 2 * mark, 2 * mark) for x, y in pixels]
    for point, pixel, name in zip(points, pixels, names, strict=True):
        text: Any = ax.annotate(
            name,
            point,
            (0.0, 0.0),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=size,
            color=INK,
            path_effects=[*HALO],
            zorder=9,
        )
        own = text.get_window_extent()
        extent = np.array([own.width, own.height])
        places = [*_around(pixel, ax, figure.dpi / 72.0)]
        boxes = [Bbox([at - 0.55 * extent, at + 0.55 * extent]) for _, at in places]
        clashes = [
            _OVER * sum(box.overlaps(other) for other in taken) + _count(lines, box)
            for box in boxes
        ]
        best = int(np.argmin(clashes))
        text.set_position(places[best][0])
        taken.append(boxes[best])
        if np.hypot(*places[best][0]) > _DISTANCES[0] + 1.0:
            ax.annotate("", point, places[best][0], **_LEADER)


def _on_lines(ax: Axes) -> npt.NDArray[np.float64]:
    """Return points on all lines that are drawn, in pixels."""
    rows = [line.get_xydata() for line in ax.lines]
    for each in ax.collections:
        if isinstance(each, LineCollection):
            rows += each.get_segments()
    steps = [np.stack([row[:-1], row[1:]], axis=1) for row in map(np.asarray, rows)]
    ends = np.concatenate([np.empty((0, 2, 2)), *steps])
    count = min(max(_ON_LINES // max(len(ends), 1), 2), _ON_ONE)
    share = np.linspace(0.0, 1.0, count)[:, np.newaxis, np.newaxis]
    points = (ends[:, 0] + share * (ends[:, 1] - ends[:, 0])).reshape(-1, 2)
    pixels = ax.transData.transform(points)
    return np.asarray(pixels[np.isfinite(pixels).all(axis=1)])


def _count(points: npt.NDArray[np.float64], box: Bbox) -> int:
    """Return how many pixels of lines there are in a box, each of them once."""
    within = ((points >= box.min) & (points <= box.max)).all(axis=1)
    return min(len(np.unique(points[within].round(), axis=0)), _OVER - 1)


def _around(
    pixel: npt.NDArray[np.float64], ax: Axes, scale: float
) -> Iterator[tuple[tuple[float, float], npt.NDArray[np.float64]]]:
    """Yield offsets from a point and where they lead, the nearest and outward ones first."""
    box = ax.get_window_extent()
    centre = np.array([0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)])
    x, y = pixel - centre
    outward = np.arctan2(y, x) if np.hypot(x, y) > 1.0 else 0.25 * np.pi
    turns = sorted(np.arange(_ROUND) * 2.0 * np.pi / _ROUND, key=lambda turn: -np.cos(turn))
    for distance in _DISTANCES:
        for turn in turns:
            offset = distance * np.array([np.cos(outward + turn), np.sin(outward + turn)])
            yield (float(offset[0]), float(offset[1])), pixel + scale * offset
