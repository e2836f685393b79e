"""Texts placed beside what they name, over no other text and over few lines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.path import Path
from matplotlib.transforms import Bbox

from optipath.plots.colors import FAINT

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

    from optipath.values.precision import Numbers


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
    """A text, and what it names. Shape: at (2,)."""

    text: str
    at: Numbers
    style: dict[str, Any]
    leader: float = 1.4
    """From which distance on a line leads to the text, in heights of a line."""


def place_labels(
    ax: Axes,
    labels: Sequence[Label],
    lines: Iterable[Numbers],
    within: Bbox,
    solids: Iterable[Patch] = (),
    taken: Iterable[Bbox] = (),
) -> None:
    """Write each text near what it names, beside solids and what is taken."""
    # Of paths with codes Matplotlib forgets the side that closes them.
    filled = [
        Path(points)
        for solid in solids
        for points in solid.get_path().transformed(solid.get_transform()).to_polygons()
    ]
    anchors = ax.transData.transform(np.array([label.at for label in labels]).reshape(-1, 2))
    along = [points for line in lines for points in _dense(ax.transData.transform(line))]
    drawn = np.concatenate([*along, np.repeat(anchors, 3, axis=0)])
    boxes = [*taken]
    for label, anchor in zip(labels, anchors, strict=True):
        style: dict[str, Any] = {"textcoords": "offset points", "annotation_clip": False}
        middle: dict[str, Any] = {"ha": "center", "va": "center", "zorder": 10}
        text = ax.annotate(
            label.text, tuple(label.at), (0.0, 0.0), **style, **middle, **label.style
        )
        box = text.get_window_extent()
        half = np.array([box.width, box.height]) / 2.0
        offset = _best(anchor, half, drawn, boxes, filled, within)
        low, high = anchor + offset - half, anchor + offset + half
        boxes.append(Bbox([low - _APART, high + _APART]))
        points = 72.0 / ax.figure.figure.dpi
        text.set_position(tuple(offset * points))
        if max(np.abs(offset) - half) > label.leader * 2.0 * half[1]:
            # To the nearest edge of the text.
            near = offset - np.clip(offset, -half, half) * 0.92
            line = {"arrowstyle": "-", "lw": 0.6, "color": FAINT, "shrinkA": 0, "shrinkB": 2}
            at = tuple(label.at), tuple(near * points)
            ax.annotate("", *at, zorder=3.5, arrowprops=line, **style)


def _best(
    anchor: Numbers,
    half: Numbers,
    drawn: Numbers,
    taken: list[Bbox],
    solids: list[Path],
    within: Bbox,
) -> Numbers:
    """Return the offset at which a text of so many pixels covers least, near and above best."""
    ways = np.stack([np.cos(_DIRECTIONS), np.sin(_DIRECTIONS)], axis=-1)
    steps = np.array(_STEPS)[:, np.newaxis]
    # The edge of the text, and not its middle, is so far away.
    edges = np.sign(ways.round(9)) * half * np.minimum(abs(ways) * 1.3, 1.0)
    offsets = (2.0 * half[1] * steps[..., np.newaxis] * ways + edges).reshape(-1, 2)
    left, below = ways.T.round(9) < 0.0
    cost = (1.3 * steps + 0.4 * left + 0.2 * below + 0.1 * abs(ways[:, 0])).ravel()
    low, high = anchor + offsets - half, anchor + offsets + half
    out = np.maximum(within.min - low, 0.0) + np.maximum(high - within.max, 0.0)
    cost += 1e6 * out.sum(axis=1)
    cost += 1e4 * _overlap(low - 1.0, high + 1.0, taken).sum(axis=1)
    low, high = low - _FREE, high + _FREE
    # Where frames of two do not overlap they do not touch, which is soon found.
    for which, solid in np.argwhere(_overlap(low, high, [each.get_extents() for each in solids])):
        cost[which] += 1e3 * solids[solid].intersects_bbox(Bbox([low[which], high[which]]))
    covered = ((drawn > low[:, np.newaxis]) & (drawn < high[:, np.newaxis])).all(axis=2)
    cost += _COVERED * np.minimum(covered.sum(axis=1), 30)
    return np.asarray(offsets[np.argmin(cost)])


def _overlap(low: Numbers, high: Numbers, boxes: list[Bbox]) -> npt.NDArray[np.bool_]:
    """Tell which rectangles overlap which boxes, shape (rectangles, boxes)."""
    corners = np.array([each.extents for each in boxes]).reshape(-1, 2, 2)
    apart = (low[:, np.newaxis] >= corners[:, 1]) | (high[:, np.newaxis] <= corners[:, 0])
    return np.asarray(~apart.any(axis=2))


def _dense(line: Numbers, apart: float = 4.0) -> Iterator[Numbers]:
    """Yield points along the parts of a line of pixels between NaN, so far apart at most."""
    for part in np.ma.clump_unmasked(np.ma.masked_invalid(line[:, 0])):
        points = line[part]
        lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
        reached = np.concatenate([[0.0], np.cumsum(lengths)])
        at = np.linspace(0.0, reached[-1], int(reached[-1] / apart) + 2)
        yield np.stack([np.interp(at, reached, each) for each in points.T], axis=-1)
