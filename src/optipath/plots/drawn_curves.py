"""Curves drawn into axes, left and right, open at jumps of angles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, listed
from optipath.plots.axes import label_axes, legend_above
from optipath.plots.colors import DASHES, FAINT, INK, LINES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from optipath.plots.light_at_detector import AlongAxis
    from optipath.plots.light_quantities import DrawnQuantity
    from optipath.values.precision import Numbers

    Drawn = tuple[DrawnQuantity, Numbers]


_MARGIN = 0.04
"""The share of an axis that is left free above and below."""


_FEW = 12
"""As many points are each marked."""

_MARKS = "o", "s", "D", "^", "v"


def units_of(quantities: Sequence[DrawnQuantity]) -> list[list[DrawnQuantity]]:
    """Return quantities by their units: the left axis, and the right one."""
    groups: dict[str, list[DrawnQuantity]] = {}
    for each in quantities:
        groups.setdefault(each.unit, []).append(each)
    if len(groups) > 2:
        kinds = [" and ".join(each.name for each in group) for group in groups.values()]
        raise OptipathError(
            f"{listed(kinds)} have {len(groups)} units, and a picture has two axes, left and "
            f"right; draw those of one or two units, and the others in another picture"
        )
    return [*groups.values()]


def draw_curves(
    ax: Axes, along: AlongAxis, curves: Sequence[Drawn], *, reads: str = "stokes"
) -> None:
    """Draw curves, axes and a legend; points are marked where few, or alone between gaps."""
    groups = units_of([quantity for quantity, _ in curves])
    order = np.argsort(along.numbers, kind="stable")
    numbers = along.numbers[order]
    places = {quantity.name: place for place, (quantity, _) in enumerate(curves)}
    sides = [ax, *(ax.twinx() for _ in groups[1:])]
    lines: list[Any] = []
    ax.set_xlim(numbers[0], numbers[-1])
    for side, group in zip(sides, groups, strict=True):
        members = [(quantity, values[order]) for quantity, values in curves if quantity in group]
        for quantity, values in members:
            lines += _draw(side, numbers, quantity, values, places[quantity.name])
        _limit(side, members)
        texts = [group[0].label] if len(group) == 1 else []
        label_axes(side, along.labels, [*texts, ", ".join(quantity.short for quantity in group)])
    ax.grid(visible=True, alpha=0.3)
    mark_default(ax, along)
    tell_missing(ax, curves, reads)
    if len(curves) > 1:
        legend_above(sides, lines)


def _draw(
    ax: Axes, along: Numbers, quantity: DrawnQuantity, values: Numbers, place: int
) -> list[Any]:
    argument = along
    if quantity.period:
        along, values = open_at_jumps(along, values, quantity.period)
    marked = np.isfinite(values)
    if len(argument) > _FEW:
        # Only those to which no line leads.
        gaps = np.pad(~marked, 1, constant_values=True)
        marked &= gaps[:-2] & gaps[2:]
    dash, colour = (place + place // len(LINES)) % len(DASHES), LINES[place % len(LINES)]
    if (marked := marked & np.isin(along, argument)).any():
        mark: dict[str, Any] = {"marker": _MARKS[place % len(_MARKS)], "markersize": 4.0}
        ax.plot(along[marked], values[marked], color=colour, linestyle="none", **mark)
    style: dict[str, Any] = {"color": colour, "linestyle": DASHES[dash]}
    return ax.plot(along, values, label=quantity.short, gid=quantity.name, **style)


def _limit(ax: Axes, members: Sequence[Drawn]) -> None:
    """Let an axis reach from end to end where its quantities have ends, and else from 0."""
    ends = [quantity.limits for quantity, _ in members]
    if not all(ends):
        finite = [values[np.isfinite(values)] for _, values in members]
        ends = [(float(each.min()), float(each.max())) for each in finite if each.size]
        ends.append((0.0, 0.0))
    low, high = min(each[0] for each in ends if each), max(each[1] for each in ends if each)
    high = high if low < high else low + 1.0
    room = _MARGIN * (high - low)
    ax.set_ylim(low - room, high + room)
    if members[0][0].unit == "°":
        step = 30.0 if high - low <= 180.0 else 90.0
        ax.set_yticks(np.arange(low, high + 1.0, step))


def mark_default(ax: Axes, along: AlongAxis) -> None:
    """Mark the value by default by a thin vertical line, with its text above."""
    if along.default is None:
        return
    ax.axvline(along.default, color=FAINT, linewidth=0.8, zorder=0.5, gid="default")
    top = ax.secondary_xaxis("top")
    top.set_xticks([along.default], labels=[along.default_text])
    top.tick_params(length=3.0, color=FAINT, labelcolor=INK, labelsize="small")


def tell_missing(ax: Axes, curves: Sequence[Drawn], reads: str) -> None:
    """Say which quantities have no value anywhere, or are not read, where curves are missing."""
    missing = [quantity for quantity, values in curves if not np.isfinite(values).any()]
    if not missing:
        return
    read = [each.name for each in missing if each.is_read(reads)]
    unread = [each.name for each in missing if not each.is_read(reads)]
    lines = [f"{listed(read)}: the light has none"] if read else []
    lines += [f"{listed(unread)}: not read"] if unread else []
    middle: dict[str, Any] = {"ha": "center", "va": "center", "transform": ax.transAxes}
    ax.text(0.5, 0.5, "\n".join(lines), color=INK, fontsize=9, **middle)


_FLIP = 0.05
"""How near to half a period a step is a flip, which is drawn neither up nor down."""


def open_at_jumps(along: Numbers, angles: Numbers, period: float) -> tuple[Numbers, Numbers]:
    """Return a curve of (count,) points with gaps where an angle jumps from end to end.

    >>> along, angles = np.array([0.0, 1.0]), np.array([80.0, -80.0])
    >>> [each.tolist() for each in open_at_jumps(along, angles, 180.0)]
    [[0.0, 0.5, 0.5, 0.5, 1.0], [80.0, 90.0, nan, -90.0, -80.0]]
    """
    step = np.diff(angles)
    with np.errstate(invalid="ignore"):
        flips = np.abs(np.abs(step) / period - 0.5) < _FLIP
        jumps = (np.abs(step) > period / 2) & ~flips
    end = np.sign(angles[:-1]) * period / 2
    rest = step + 2 * end
    places: list[int] = []
    more: list[tuple[float, float]] = []
    for at in np.flatnonzero(flips | jumps).tolist():
        if flips[at]:
            gap = [(along[at], np.nan)]
        else:
            share = (end[at] - angles[at]) / rest[at] if rest[at] else 0.5
            meets = along[at] + share * (along[at + 1] - along[at])
            gap = [(meets, end[at]), (meets, np.nan), (meets, -end[at])]
        places += [at + 1] * len(gap)
        more += gap
    x, y = np.array(more).reshape(-1, 2).T
    return np.insert(along, places, x), np.insert(angles, places, y)
