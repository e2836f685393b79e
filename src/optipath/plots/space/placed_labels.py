"""Names that are set where they cover nothing, with a line to what they name."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.path import Path
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

_COVERED = 0.5
"""What four pixels of a line cost that are covered."""

_FREE = 3.0
"""How far texts are from what is drawn, in pixels."""

_APART = np.array([9.0, 5.0])
"""How far texts are from one another, in pixels across and up."""


class Label(NamedTuple):
    """A text, and what it names.

    Shape: at (2,).
    """

    text: str
    at: Array
    style: dict[str, Any]
    leader: float = 1.4


def place_labels(
    ax: Axes, labels: list[Label], lines: list[Array], within: Bbox, solids: Sequence[Patch] = ()
) -> None:
    """Write each text near what it names, over no other text and over few lines.

    Shape: lines (points, 2).
    """
    filled = [outline for solid in solids for outline in _outlines(solid)]
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
        taken.append(Bbox([middle - half - _APART, middle + half + _APART]))
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
    anchor: Array, half: Array, drawn: Array, shapes: tuple[list[Bbox], list[Path]], within: Bbox
) -> Array:
    """Return the offset at which a text of so many pixels covers least."""
    offsets, cost = _tried(half)
    low, high = anchor + offsets - half, anchor + offsets + half
    out = np.maximum(within.min - low, 0.0) + np.maximum(high - within.max, 0.0)
    cost += 1e6 * out.sum(axis=1)
    taken, solids = shapes
    cost += 1e4 * _overlap(low - 1.0, high + 1.0, taken).sum(axis=1)
    low, high = low - _FREE, high + _FREE
    # Where frames of two do not overlap they do not touch, which is soon found.
    for which, solid in np.argwhere(_overlap(low, high, [each.get_extents() for each in solids])):
        cost[which] += 1e3 * solids[solid].intersects_bbox(Bbox([low[which], high[which]]))
    covered = ((drawn > low[:, np.newaxis]) & (drawn < high[:, np.newaxis])).all(axis=2)
    cost += _COVERED * np.minimum(covered.sum(axis=1), 30)
    return np.asarray(offsets[np.argmin(cost)])


def _tried(half: Array) -> tuple[Array, Array]:
    """Return the offsets that are tried, and what they cost, which is least near and above."""
    ways = np.stack([np.cos(_DIRECTIONS), np.sin(_DIRECTIONS)], axis=-1)
    # The edge of the text, and not its middle, is so far away.
    edges = np.sign(ways.round(9)) * half * np.minimum(abs(ways) * 1.3, 1.0)
    steps = np.array(_STEPS)[:, np.newaxis]
    offsets = 2.0 * half[1] * steps[..., np.newaxis] * ways + edges
    left, below = ways.T.round(9) < 0.0
    cost = 1.3 * steps + 0.4 * left + 0.2 * below + 0.1 * abs(ways[:, 0])
    return offsets.reshape(-1, 2), cost.ravel()


def _overlap(low: Array, high: Array, boxes: list[Bbox]) -> npt.NDArray[np.bool_]:
    """Tell which rectangles overlap which boxes, shape (rectangles, boxes)."""
    corners = np.array([each.extents for each in boxes]).reshape(-1, 2, 2)
    apart = (low[:, np.newaxis] >= corners[:, 1]) | (high[:, np.newaxis] <= corners[:, 0])
    return np.asarray(~apart.any(axis=2))


def _outlines(solid: Patch) -> list[Path]:
    """Return the closed outlines of what is drawn, in pixels."""
    drawn = solid.get_path().transformed(solid.get_transform())
    # Of paths with codes Matplotlib forgets the side that closes them.
    return [Path(points) for points in drawn.to_polygons()]


def _dense(line: Array, apart: float = 4.0) -> Array:
    """Return points along a line of pixels that are so far apart at most."""
    found = [line[:1]]
    for tail, head in pairwise(line):
        count = max(int(np.linalg.norm(head - tail) / apart), 1)
        share = np.arange(1, count + 1)[:, np.newaxis] / count
        found.append(tail + share * (head - tail))
    return np.concatenate(found)
