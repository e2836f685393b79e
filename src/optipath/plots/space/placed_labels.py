"""Names that are set where they cover nothing, with a line to what they name."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.transforms import Bbox

from optipath.plots.line_colours import FAINT

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

    Array = npt.NDArray[np.float64]

_DIRECTIONS = np.radians(np.arange(0.0, 360.0, 22.5))
_STEPS = 0.6, 1.0, 1.7, 2.6, 3.8, 5.2, 7.0, 9.5, 12.5
"""How far from what they name texts are tried, in heights of a line."""


class Label(NamedTuple):
    """A text, and what it names.

    Attributes
    ----------
    text : str
        What is written.
    at : ndarray of shape (2,)
        What it names, in the data of the axes.
    style : dict
        How Matplotlib writes it.
    leader : float
        From which distance on a line leads to the text, in heights of a line.
    """

    text: str
    at: Array
    style: dict[str, Any]
    leader: float = 1.4


def place_labels(
    ax: Axes, labels: list[Label], lines: list[Array], within: Bbox, solids: Sequence[Patch] = ()
) -> None:
    """Write each text near what it names, over no other text and over few lines.

    Parameters
    ----------
    ax : Axes
        Where; its limits stay as they are.
    labels : list of Label
        The most important first.
    lines : list of ndarray of shape (points, 2)
        What should not be covered, in data.
    within : Bbox
        What texts must not leave, in pixels.
    solids : sequence of Patch, optional
        What is drawn and no text should touch.
    """
    shapes = [solid.get_path().transformed(solid.get_transform()) for solid in solids]
    filled = [(shape, shape.get_extents()) for shape in shapes]
    crowd = [_dense(ax.transData.transform(line)) for line in lines if len(line)]
    drawn = np.concatenate(crowd) if crowd else np.zeros((0, 2))
    anchors = ax.transData.transform(np.array([label.at for label in labels]).reshape(-1, 2))
    drawn = np.concatenate([drawn, np.repeat(anchors, 3, axis=0)])
    taken: list[Bbox] = []
    for label, anchor in zip(labels, anchors, strict=True):
        text = ax.annotate(
            label.text,
            tuple(label.at),
            (0.0, 0.0),
            textcoords="offset pixels",
            ha="center",
            va="center",
            annotation_clip=False,
            zorder=10,
            **label.style,
        )
        box = text.get_window_extent()
        half = np.array([box.width, box.height]) / 2.0
        offset = _best(anchor, half, drawn, (taken, filled), within)
        middle = anchor + offset
        taken.append(Bbox([middle - half, middle + half]).padded(5.0))
        _move(ax, text, label, offset, half)


def _move(ax: Axes, text: Any, label: Label, offset: Array, half: Array) -> None:
    scale = 72.0 / text.figure.figure.dpi
    text.set_position(tuple(offset * scale))
    text.set_anncoords("offset points")
    away = np.abs(offset) - half
    if max(away) > label.leader * 2.0 * half[1]:
        # To the nearest edge of the text.
        near = offset - np.clip(offset, -half, half) * 0.92
        ax.annotate(
            "",
            tuple(label.at),
            tuple(near * scale),
            textcoords="offset points",
            annotation_clip=False,
            zorder=3.5,
            arrowprops={"arrowstyle": "-", "lw": 0.6, "color": FAINT, "shrinkA": 0, "shrinkB": 2},
        )


def _best(
    anchor: Array, half: Array, drawn: Array, boxes: tuple[list[Bbox], list[Any]], within: Bbox
) -> Array:
    """Return the offset at which a text of so many pixels covers least."""
    found: list[tuple[float, tuple[float, float]]] = []
    line, (taken, filled) = 2.0 * half[1], boxes
    for step in _STEPS:
        for direction in _DIRECTIONS:
            way = np.array([np.cos(direction), np.sin(direction)])
            # The edge of the text, and not its middle, is so far away.
            offset = way * step * line + np.sign(way.round(9)) * half * np.minimum(
                abs(way) * 1.3, 1
            )
            box = Bbox([anchor + offset - half, anchor + offset + half])
            cost = 1.3 * step + 0.4 * (way[0] < 0.0) + 0.2 * (way[1] < 0.0)
            cost += 1e6 * _outside(box, within)
            cost += 1e4 * sum(box.padded(1.0).overlaps(other) for other in taken)
            around = box.padded(2.0)
            near = [shape for shape, extent in filled if around.overlaps(extent)]
            cost += 1e3 * sum(shape.intersects_bbox(around) for shape in near)
            covered = (
                (drawn[:, 0] > around.x0)
                & (drawn[:, 0] < around.x1)
                & (drawn[:, 1] > around.y0)
                & (drawn[:, 1] < around.y1)
            )
            cost += 0.35 * min(int(covered.sum()), 40)
            found.append((cost, (offset[0], offset[1])))
    return np.array(min(found)[1])


def _outside(box: Bbox, within: Bbox) -> float:
    """Return by how many pixels a box leaves another."""
    return float(
        max(within.x0 - box.x0, 0.0)
        + max(box.x1 - within.x1, 0.0)
        + max(within.y0 - box.y0, 0.0)
        + max(box.y1 - within.y1, 0.0)
    )


def _dense(line: Array, apart: float = 4.0) -> Array:
    """Return points along a line of pixels that are so far apart at most."""
    found = [line[:1]]
    for tail, head in pairwise(line):
        count = max(int(np.linalg.norm(head - tail) / apart), 1)
        share = np.arange(1, count + 1)[:, np.newaxis] / count
        found.append(tail + share * (head - tail))
    return np.concatenate(found)
