"""Energy flow: where the power of the light of a path goes, as ribbons."""

from __future__ import annotations

from collections import defaultdict
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from optipath.errors import OptipathError
from optipath.paths.energy import energy_along
from optipath.plots.axes import own_axes
from optipath.plots.colors import FAINT, INK, LINES
from optipath.plots.light_texts import lights_of_one
from optipath.plots.text import inches_of, width_of

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from matplotlib.axes import Axes

    from optipath.paths.energy import EnergyAlong, LightOnLink
    from optipath.paths.path_graph import PathGraph
    from optipath.values.precision import Numbers


_WIDE, _ROW, _AROUND = 6.4, 0.42, 0.5
"""The width of a figure, the height of a row, and that above and below, in inches."""

_LIGHT, _TAKEN = LINES[4], LINES[1]
_TAKEN_TEXT = "#A04700"
"""The same, darker, as texts are read."""

_POINTS = 10.0
_MIDDLE = 0.32
"""The share of the width that is left to ribbons at least."""


def energy(path: PathGraph, ax: Axes | None = None, **values: Any) -> Axes:
    """Draw where the power of the light of a path goes, from above in the order of travel.

    Ribbons are as wide as the intensity S0. What an element takes (absorbs, blocks, or lets go by
    a way that the path does not have) ends in a spike; light that leaves the path has a row of
    its own. In a loop, a ribbon is as wide as all rounds together. Taps, and all ways behind
    them, are dotted: light is read there, and nothing of it is taken.

    Parameters
    ----------
    path : PathGraph
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    **values : float or str
        As in `PathGraph.trace`, one value each.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import optipath as op
    >>> ax = energy(op.load_preset("malus"))
    >>> [text.get_text() for text in ax.texts][:4]
    ['lamp', 'gives 1', 'polarizer', 'takes 0.5 (50 %)']
    """
    result = energy_along(path, lights_of_one(path, "energy", values))
    if not all(np.isfinite(link.power) for link in result.links):
        raise OptipathError("the light is not a number on some links; give values that there are")
    rows, links = _rows_and_links(result)
    ax = own_axes(ax, (_WIDE, _AROUND + _ROW * (len(rows) + len(result.notes))))
    ax.set_axis_off()
    ax.set_ylim(0.55 - len(rows) - len(result.notes), 0.55)
    width = _draw(ax, rows, links)
    _write(ax, rows, result, width)
    return ax


def _draw(ax: Axes, rows: list[_Row], links: list[_Link]) -> float:
    """Draw bars, ribbons and what is taken over the largest power; return how wide all is."""
    largest = max([link.power for link in links], default=0.0) or 1.0
    rows = [row._replace(power=row.power / largest) for row in rows]
    links = [link._replace(power=0.0 if link.tap else link.power / largest) for link in links]
    places = _Places(rows, links)
    for link, outline in zip(links, places.outlines, strict=True):
        if not link.power:
            half = outline[: len(outline) // 2]
            ax.plot(*half.T, color=FAINT, linestyle=":", linewidth=1.1, gid=link.start)
            continue
        style = {"facecolor": _LIGHT, "edgecolor": _LIGHT, "linewidth": 0.6, "alpha": 0.6}
        ax.add_patch(Polygon(outline, closed=True, gid=f"{link.start} -> {link.end}", **style))
    for row in rows:
        y, left = places.level[row.name], places.left[row.lane]
        if row.told == "takes":
            # A spike on the right of what goes on.
            leaving = [link for link in links if link.start == row.name]
            begin = left + sum(link.power for link in leaving if link.lane <= row.lane)
            end, mid = begin + row.power, y - _BAR - _SPIKE / 2
            tip = (begin + end) / 2, y - _BAR - _SPIKE
            spike = [(begin, y - _BAR), (begin, mid), tip, (end, mid), (end, y - _BAR)]
            ax.add_patch(Polygon(spike, closed=True, color=_TAKEN, linewidth=0.6, alpha=0.8))
        size = max(places.bars[row.name], 0.02), 2 * _BAR
        ax.add_patch(Rectangle((left, y - _BAR), *size, color=INK, linewidth=0.6))
    return places.width


def _write(ax: Axes, rows: Sequence[_Row], result: EnergyAlong, width: float) -> None:
    """Write names on the left and what becomes of light on the right, as large as they fit."""
    names, messages = [row.name for row in rows], [_sentence(row, result) for row in rows]
    # In inches, of letters of one point; each column begins half a letter beside the ribbons.
    left, right, below = (
        max((width_of(text, 1.0) for text in texts), default=0.0)
        for texts in (names, messages, result.notes)
    )
    left, right = left + 1.0 / 72.0, right + 1.0 / 72.0
    (wide, high), (low, top) = inches_of(ax), ax.get_ylim()
    size = min(_POINTS, 0.72 * 72.0 * high / (top - low), (1.0 - _MIDDLE) * wide / (left + right))
    size = min(size, wide / below) if below else size
    unit = width / (wide - size * (left + right))
    edges = -size * left * unit, width + size * right * unit
    ax.set_xlim(*edges)
    apart = 0.5 * size / 72.0 * unit
    style: dict[str, Any] = {"va": "center", "color": INK, "fontsize": size}
    for at, (row, name, message) in enumerate(zip(rows, names, messages, strict=True)):
        ax.text(-apart, -float(at), name, ha="right", **style)
        told = ax.text(width + apart, -float(at), message, ha="left", **style)
        if row.told == "takes":
            told.set_color(_TAKEN_TEXT)
        line: dict[str, Any] = {"color": FAINT, "linewidth": 0.4, "alpha": 0.5, "zorder": 0.5}
        ax.plot([0.0, width], [-float(at)] * 2, **line)
    for at, note in enumerate(result.notes, len(rows)):
        ax.text(edges[0], -float(at), note, ha="left", **style)


def _sentence(row: _Row, result: EnergyAlong) -> str:
    total = float(sum(result.given.values()))
    share = f" ({100.0 * row.power / total:.3g} %)" if total and row.told != "gives" else ""
    return f"{row.told} {row.power:.3g}{share}" if row.told else ""


_BAR = 0.05
"""Half the height of a bar, of the distance of rows."""

_SPIKE = 0.34
"""How far down that goes which an element takes."""

_GAP, _LEAST = 0.2, 0.12
"""Between lanes, and how wide a lane is at least, of the largest power."""


class _Link(NamedTuple):
    """A link as it is drawn."""

    start: str
    end: str
    power: float
    lane: int
    back: bool
    tap: bool


class _Row(NamedTuple):
    """An element, or a port by which light leaves, in a row of its own."""

    name: str
    lane: int
    told: str
    power: float


class _Places:
    """Where everything is: levels of rows, left edges of lanes, bars, and outlines of links.

    Powers are over the largest; taps have none.
    """

    def __init__(self, rows: list[_Row], links: list[_Link]) -> None:
        self.level = {row.name: -float(at) for at, row in enumerate(rows)}
        self.bars = {
            row.name: max(
                sum(link.power for link in links if link.end == row.name),
                sum(link.power for link in links if link.start == row.name),
            )
            for row in rows
        }
        widths: dict[int, float] = defaultdict(float)
        needed = [(row.lane, self.bars[row.name]) for row in rows]
        for lane, width in (*needed, *((link.lane, link.power) for link in links)):
            widths[lane] = max(widths[lane], width)
        self.left, edge = {}, 0.0
        for lane in sorted(widths):
            self.left[lane] = edge
            edge += max(widths[lane], _LEAST) + _GAP
        self.width = edge - _GAP
        by_name = {row.name: row for row in rows}
        self.outlines = [self._outline(link, links, by_name) for link in links]

    def _outline(self, link: _Link, links: list[_Link], rows: dict[str, _Row]) -> Numbers:
        """Return the outline of a link, or its middle, there and back, where it has no width."""
        width, row, end_row = link.power, rows[link.start], rows[link.end]
        out = self.left[row.lane] + _before(link, [e for e in links if e.start == link.start])
        if row.told == "takes" and link.lane > row.lane:
            out += row.power
        into = self.left[end_row.lane] + _before(link, [e for e in links if e.end == link.end])
        begin, end = (out, self.level[link.start] - _BAR), (into, self.level[link.end] + _BAR)
        lane = self.left[link.lane] + width / 2
        if link.back:
            return _turned_back(begin, lane, end, width)
        stations = [begin, end]
        if begin[1] - end[1] > 1.0:
            first, last = begin[1] - 1.0 + 2 * _BAR, end[1] + 1.0 - 2 * _BAR
            both = [(lane, first), (lane, last)]
            stations[1:1] = both if first >= last else [(lane, (first + last) / 2)]
        return _ribbon(stations, width)


def _before(link: _Link, others: list[_Link]) -> float:
    """Return how far from the left the middle of a link is among others at one bar."""
    left = [one.power for one in others if link.tap or one.lane < link.lane]
    return sum(left) + link.power / 2


def _rows_and_links(result: EnergyAlong) -> tuple[list[_Row], list[_Link]]:
    """Return the rows of a path in the order of travel, and the lanes of its links.

    Light keeps the lane of its element; what splits off takes the next free lane, and what returns,
    a lane to the right of all others.
    """
    names = _in_order(result.links)
    back = [names.index(_end(link)) <= names.index(link.start) for link in result.links]
    lanes, ways = _lanes(result.links, names, back)
    rows = [_Row(name, lanes[name], *_row_texts(name, result)) for name in names]
    links = [
        _Link(link.start, _end(link), float(link.power), ways[at], back[at], link.tap)
        for at, link in enumerate(result.links)
    ]
    return rows, links


def _end(link: LightOnLink) -> str:
    return link.end or link.name


def _in_order(links: Sequence[LightOnLink]) -> list[str]:
    """Return elements in the order in which they send light, ends behind the last that they get."""
    starts = [*dict.fromkeys(link.start for link in links)]
    last = {_end(link): link for link in links}
    order: list[str] = []
    for name in starts:
        order.append(name)
        here = [end for end, link in last.items() if link.start == name and end not in starts]
        order += sorted(here, key=lambda end: _importance(last[end], links), reverse=True)
    return order


def _lanes(
    links: Sequence[LightOnLink], names: list[str], back: list[bool]
) -> tuple[dict[str, int], dict[int, int]]:
    """Return the lane of each row and of each link."""
    ways: dict[int, int] = {}
    lanes: dict[str, int] = {}
    busy: dict[int, int] = {}
    for name in names:
        arriving = [lane for lane, at in busy.items() if _end(links[at]) == name]
        lanes[name] = min(arriving, default=_free(busy))
        busy = {lane: at for lane, at in busy.items() if lane not in arriving}
        leaving = [at for at, link in enumerate(links) if link.start == name and not back[at]]
        for at in sorted(leaving, key=lambda at: _importance(links[at], links)):
            lane = _free(busy) if lanes[name] in busy else lanes[name]
            busy[lane], ways[at] = at, lane
    outside = 1 + max([*lanes.values(), *ways.values()], default=0)
    returning = [at for at, goes_back in enumerate(back) if goes_back]
    ways.update({at: outside + number for number, at in enumerate(returning)})
    return lanes, ways


def _importance(link: LightOnLink, links: Sequence[LightOnLink]) -> tuple[Any, ...]:
    """Return by what links are in order: what goes on, what ends, what leaves; the brightest."""
    goes_on = any(other.start == link.end for other in links)
    return link.tap, not goes_on, not link.end, -float(link.power)


def _free(busy: Collection[int]) -> int:
    return next(lane for lane in range(len(busy) + 1) if lane not in busy)


def _row_texts(name: str, result: EnergyAlong) -> tuple[str, float]:
    """Return what becomes of light in a row, and of how much."""
    for word, powers in (("gives", result.given), ("leaves", result.left), ("gets", result.ended)):
        if name in powers:
            return word, float(powers[name])
    if name in result.taken:
        power = float(result.taken[name])
        return ("takes" if power > 0.0 else "adds" if power < 0.0 else ""), abs(power)
    return "reads", float(np.sum([link.power for link in result.links if _end(link) == name]))


_STEPS = np.linspace(0.0, 1.0, 25)
_DEEP = 0.44
"""How far a turn reaches, of the distance of rows."""

_THICK = 0.25
"""How thick a turn is at most, of the same."""


def _ribbon(stations: list[tuple[float, float]], width: float) -> Numbers:
    """Return the outline (..., 2) of a ribbon through stations, as wide everywhere along x."""
    ease = _STEPS**2 * (3.0 - 2.0 * _STEPS)
    parts = []
    for (x, y), (to_x, to_y) in pairwise(stations):
        parts.append(np.stack([x + (to_x - x) * ease, y + (to_y - y) * _STEPS], axis=-1))
    middle, half = np.concatenate(parts), np.array([width / 2, 0.0])
    return np.concatenate([middle - half, (middle + half)[::-1]])


def _turned_back(
    begin: tuple[float, float], lane: float, end: tuple[float, float], width: float
) -> Numbers:
    """Return the outline (..., 2) of a ribbon down, up in a lane on the right, and down again."""
    edges = []
    for side, deep in ((-0.5, _DEEP), (0.5, _DEEP - _THICK * width)):
        out, up, into = begin[0] + side * width, lane - side * width, end[0] + side * width
        below = _arc(out, up, begin[1], -deep)
        above = _arc(up, into, end[1], deep)
        edges.append(np.concatenate([below, above]))
    return np.concatenate([edges[0], edges[1][::-1]])


def _arc(begin: float, end: float, level: float, reach: float) -> Numbers:
    angle = np.pi * _STEPS
    x = (begin + end) / 2 + (begin - end) / 2 * np.cos(angle)
    return np.stack([x, level + reach * np.sin(angle)], axis=-1)
