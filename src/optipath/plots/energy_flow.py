"""Energy flow: where the power of the light of a path goes, as ribbons."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from optipath.errors import OptipathError, shown
from optipath.paths.energy import energy_along
from optipath.paths.path_graph import PathGraph
from optipath.plots.axes import own_axes
from optipath.plots.colors import FAINT, INK, LINES

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.paths.energy import EnergyAlong, PowerOnLink

    Numbers = npt.NDArray[np.float64]


_WIDE, _ROW, _AROUND = 6.4, 0.42, 0.5
"""The width of a figure, the height of a row, and that above and below, in inches."""

_LIGHT, _TAKEN = LINES[4], LINES[1]
_TAKEN_TEXT = "#A04700"
"""The same, darker, as texts are read."""

_POINTS = 10.0
_LEAST_MIDDLE = 0.3
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
        The path.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    **values : float or str
        As in `PathGraph.trace`, one value each.

    Returns
    -------
    Axes

    Raises
    ------
    OptipathError
        If values do not fit, or are many.

    Examples
    --------
    >>> import optipath as op
    >>> ax = energy(op.load_preset("malus"))
    >>> [text.get_text() for text in ax.texts][:4]
    ['lamp', 'gives 1', 'polarizer', 'takes 0.5 (50 %)']
    """
    if not isinstance(path, PathGraph):
        raise OptipathError(f"energy is that of a path, not of {shown(path)}; give a PathGraph")
    result = energy_along(path, **values)
    if any(link.power.ndim for link in result.links):
        shape = result.links[0].power.shape
        raise OptipathError(
            f"the light is a batch of shape {shape}, and a picture is of one; give one value each"
        )
    if not all(np.isfinite(link.power) for link in result.links):
        raise OptipathError("the light is not a number on some links; give values that there are")
    drawn = energy_rows(result)
    places = EnergyPlaces(drawn.over_largest())
    count = len(drawn.rows) + len(result.notes)
    ax = own_axes(ax, (_WIDE, _AROUND + _ROW * count))
    ax.set_axis_off()
    ax.set_ylim(0.55 - count, 0.55)
    _draw(ax, places)
    _write(ax, places, drawn.rows, result)
    return ax


def _draw(ax: Axes, places: EnergyPlaces) -> None:
    """Draw bars and ribbons."""
    for link in places.drawn.links:
        outline = places.outline(link)
        if link.tap or not link.power:
            half = outline[: len(outline) // 2]
            ax.plot(*half.T, color=FAINT, linestyle=":", linewidth=1.1, gid=link.start)
            continue
        style = {"facecolor": _LIGHT, "edgecolor": _LIGHT, "linewidth": 0.6, "alpha": 0.6}
        ax.add_patch(Polygon(outline, closed=True, gid=f"{link.start} -> {link.end}", **style))
    for row in places.drawn.rows:
        if (spike := places.taken(row)) is not None:
            ax.add_patch(Polygon(spike, closed=True, color=_TAKEN, linewidth=0.6, alpha=0.8))
        width, y = max(places.bar(row), 0.02), places.level[row.name]
        left = places.left[row.lane]
        ax.add_patch(Rectangle((left, y - BAR), width, 2 * BAR, color=INK, linewidth=0.6))


def _write(ax: Axes, places: EnergyPlaces, rows: Sequence[EnergyRow], result: EnergyAlong) -> None:
    """Write names on the left, and what becomes of light on the right, as large as they fit."""
    total = float(sum(result.given.values()))
    texts: list[tuple[Any, Any]] = []
    for row in rows:
        y = places.level[row.name]
        style: dict[str, Any] = {"va": "center", "color": INK}
        name = ax.text(0.0, y, row.name, ha="right", **style)
        message = ax.text(0.0, y, _sentence(row, total), ha="left", **style)
        if row.told == "takes":
            message.set_color(_TAKEN_TEXT)
        texts.append((name, message))
    notes = [
        ax.text(0.0, -float(len(rows) + at), note, ha="left", va="center", color=INK)
        for at, note in enumerate(result.notes)
    ]
    _fit(ax, places, texts, notes)


def _fit(
    ax: Axes, places: EnergyPlaces, texts: Sequence[tuple[Any, Any]], notes: Sequence[Any]
) -> None:
    """Choose the size of texts and the limits of x so that all stands beside the ribbons."""
    whole = ax.get_window_extent()
    low, high = ax.get_ylim()
    figure: Any = ax.figure
    row = whole.height / (high - low) * 72.0 / figure.dpi
    size = min(_POINTS, 0.72 * row)
    every = [text for pair in texts for text in pair]
    while True:
        for text in (*every, *notes):
            text.set_fontsize(size)
        left = max(name.get_window_extent().width for name, _ in texts) + size
        right = max(message.get_window_extent().width for _, message in texts) + size
        longest = max([note.get_window_extent().width for note in notes], default=0.0)
        middle = whole.width - left - right
        if (middle >= _LEAST_MIDDLE * whole.width and longest <= whole.width) or size < 1.0:
            break
        size *= 0.95
    unit = places.width / middle
    other = 0.5 * size * unit
    ax.set_xlim(-left * unit, places.width + right * unit)
    for name, message in texts:
        name.set_x(-other)
        message.set_x(places.width + other)
        y = name.get_position()[1]
        ax.plot([0.0, places.width], [y, y], color=FAINT, linewidth=0.4, alpha=0.5, zorder=0.5)
    for note in notes:
        note.set_x(-left * unit)


def _sentence(row: EnergyRow, total: float) -> str:
    if not row.told:
        return ""
    written = f"{row.told} {row.power:.3g}"
    if row.told == "gives" or not total:
        return written
    return f"{written} ({100.0 * row.power / total:.3g} %)"


BAR = 0.05
"""Half the height of a bar, of the distance of rows."""

_SPIKE = 0.34
"""How far down that goes which an element takes."""

_GAP, _LEAST = 0.2, 0.12
"""Between lanes, and how wide a lane is at least, of the largest power."""


@dataclass(frozen=True)
class EnergyPlaces:
    """Where everything is."""

    drawn: EnergyRows
    level: dict[str, float] = field(init=False)
    left: dict[int, float] = field(init=False)
    width: float = field(init=False)

    def __post_init__(self) -> None:
        rows, links = self.drawn
        widths: dict[int, float] = {}
        for row in rows:
            widths[row.lane] = max(widths.get(row.lane, 0.0), self.bar(row))
        for link in links:
            power = 0.0 if link.tap else link.power
            widths[link.lane] = max(widths.get(link.lane, 0.0), power)
        left, edge = {}, 0.0
        for lane in sorted(widths):
            left[lane] = edge
            edge += max(widths[lane], _LEAST) + _GAP
        vars(self).update(
            level={row.name: -float(at) for at, row in enumerate(rows)},
            left=left,
            width=edge - _GAP,
        )

    def bar(self, row: EnergyRow) -> float:
        """Return how wide the bar of a row is: the light that comes in, or goes out."""
        flows = [link for link in self.drawn.links if not link.tap]
        arriving = sum(link.power for link in flows if link.end == row.name)
        leaving = sum(link.power for link in flows if link.start == row.name)
        return max(arriving, leaving)

    def taken(self, row: EnergyRow) -> npt.NDArray[np.float64] | None:
        """Return the outline of what an element takes: a spike on the right of what goes on."""
        if row.told != "takes":
            return None
        leaving = [link for link in self.drawn.links if link.start == row.name and not link.tap]
        before = sum(link.power for link in leaving if link.lane <= row.lane)
        left, y = self.left[row.lane] + before, self.level[row.name] - BAR
        right = left + row.power
        tip = (left + right) / 2, y - _SPIKE
        return np.array(
            [(left, y), (left, y - _SPIKE / 2), tip, (right, y - _SPIKE / 2), (right, y)]
        )

    def outline(self, link: EnergyLink) -> npt.NDArray[np.float64]:
        """Return the outline of a link, or its middle, there and back, where it has no width."""
        width = 0.0 if link.tap else link.power
        begin = self._at(link, link.start, -BAR), self.level[link.start] - BAR
        end = self._at(link, link.end, BAR), self.level[link.end] + BAR
        lane = self.left[link.lane] + width / 2
        if link.back:
            return turned_back(begin, lane, end, width, width)
        stations = [begin, end]
        if begin[1] - end[1] > 1.0:
            stations[1:1] = [(lane, begin[1] - 1.0 + 2 * BAR), (lane, end[1] + 1.0 - 2 * BAR)]
        if begin[1] - end[1] > 1.0 and stations[1][1] < stations[2][1]:
            stations[1:3] = [(lane, (stations[1][1] + stations[2][1]) / 2)]
        return ribbon(stations, width)

    def _at(self, link: EnergyLink, name: str, side: float) -> float:
        """Return the x at which a link leaves or enters a bar, beside its neighbours."""
        leaves = side < 0.0
        others = [
            each
            for each in self.drawn.links
            if (each.start if leaves else each.end) == name and not each.tap
        ]
        others.sort(key=lambda each: each.lane)
        row = next(row for row in self.drawn.rows if row.name == name)
        x = self.left[row.lane]
        if leaves and row.told == "takes" and link.lane > row.lane:
            x += row.power
        for each in others:
            if each is link:
                return x + link.power / 2
            x += each.power
        return x


class EnergyLink(NamedTuple):
    """A link as it is drawn."""

    start: str
    end: str
    power: float
    lane: int
    back: bool
    tap: bool


class EnergyRow(NamedTuple):
    """An element, or a port by which light leaves, in a row of its own."""

    name: str
    lane: int
    told: str
    power: float


class EnergyRows(NamedTuple):
    """All rows in the order of travel, and all links."""

    rows: list[EnergyRow]
    links: list[EnergyLink]

    def over_largest(self) -> EnergyRows:
        """Return the same with all powers over the largest on a link."""
        largest = max([link.power for link in self.links], default=0.0) or 1.0
        return EnergyRows(
            [row._replace(power=row.power / largest) for row in self.rows],
            [link._replace(power=link.power / largest) for link in self.links],
        )


def energy_rows(result: EnergyAlong) -> EnergyRows:
    """Return the rows of a path, each element in one of its own, and the lanes of its links.

    Light keeps the lane of its element; what splits off takes the next free lane, and what returns,
    a lane to the right of all others.

    >>> import optipath as op
    >>> from optipath.paths.energy import energy_along
    >>> rows = energy_rows(energy_along(op.load_preset("two-panes"))).rows
    >>> [(row.name, row.lane, row.told) for row in rows[:4]]
    [('lamp', 0, 'gives'), ('pane1', 0, ''), ('pane1.transmitted', 1, 'leaves'), ('pane2', 0, '')]
    """
    names = _in_order(result.links)
    place = {name: row for row, name in enumerate(names)}
    lanes, ways = _lanes(result.links, place)
    rows = [EnergyRow(name, lanes[name], *_row_texts(name, result)) for name in names]
    links = [
        EnergyLink(link.start, _end(link), float(link.power), lane, _is_back(link, place), link.tap)
        for link, lane in zip(result.links, ways, strict=True)
    ]
    return EnergyRows(rows, links)


def _end(link: PowerOnLink) -> str:
    return link.end or link.name


def _is_back(link: PowerOnLink, place: dict[str, int]) -> bool:
    return place[_end(link)] <= place[link.start]


def _in_order(links: Iterable[PowerOnLink]) -> list[str]:
    """Return elements in the order in which they send light, ends behind the last that they get."""
    links = [*links]
    starts = [*dict.fromkeys(link.start for link in links)]
    last = {_end(link): link for link in links}
    order: list[str] = []
    for name in starts:
        order.append(name)
        here = [end for end, link in last.items() if link.start == name and end not in starts]
        order += sorted(here, key=lambda end: _importance(last[end], links), reverse=True)
    return order


def _lanes(
    links: tuple[PowerOnLink, ...], place: dict[str, int]
) -> tuple[dict[str, int], list[int]]:
    """Return the lane of each row and of each link."""
    ways = dict.fromkeys(range(len(links)), -1)
    lanes: dict[str, int] = {}
    busy: dict[int, int] = {}
    for name in place:
        arriving = [lane for lane, at in busy.items() if _end(links[at]) == name]
        lanes[name] = min(arriving, default=_free(busy))
        busy = {lane: at for lane, at in busy.items() if lane not in arriving}
        leaving = [
            at for at, each in enumerate(links) if each.start == name and not _is_back(each, place)
        ]
        for at in sorted(leaving, key=lambda at: _importance(links[at], links)):
            taken = {*busy}
            lane = lanes[name] if lanes[name] not in taken else _free(taken)
            busy[lane], ways[at] = at, lane
    outside = 1 + max([*lanes.values(), *ways.values()], default=0)
    back = [at for at, each in enumerate(links) if _is_back(each, place)]
    ways.update(zip(back, range(outside, outside + len(back)), strict=True))
    return lanes, [*ways.values()]


def _importance(link: PowerOnLink, links: Sequence[PowerOnLink]) -> tuple[Any, ...]:
    """Return by what links are in order: what goes on, what ends, what leaves; the brightest."""
    goes_on = any(other.start == link.end for other in links)
    return link.tap, not goes_on, not link.end, -float(link.power)


def _free(busy: Iterable[int]) -> int:
    taken = {*busy}
    return next(lane for lane in range(len(taken) + 1) if lane not in taken)


def _row_texts(name: str, result: EnergyAlong) -> tuple[str, float]:
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


def bent(stations: list[tuple[float, float]]) -> Numbers:
    """Return a line (..., 2) that goes through stations and is upright in each.

    >>> bent([(0.0, 0.0), (1.0, -1.0)])[[0, 12, -1]].tolist()
    [[0.0, 0.0], [0.5, -0.5], [1.0, -1.0]]
    """
    ease = _STEPS**2 * (3.0 - 2.0 * _STEPS)
    parts = []
    for (x, y), (to_x, to_y) in pairwise(stations):
        parts.append(np.stack([x + (to_x - x) * ease, y + (to_y - y) * _STEPS], axis=-1))
    return np.concatenate(parts)


def ribbon(stations: list[tuple[float, float]], width: float) -> Numbers:
    """Return the outline (..., 2) of a ribbon through stations, as wide everywhere along x."""
    middle = bent(stations)
    half = np.array([width / 2, 0.0])
    return np.concatenate([middle - half, (middle + half)[::-1]])


def turned_back(
    begin: tuple[float, float], lane: float, end: tuple[float, float], width: float, share: float
) -> Numbers:
    """Return the outline (..., 2) of a ribbon down, up in a lane on the right, and down again."""
    edges = []
    for side, deep in ((-0.5, _DEEP), (0.5, _DEEP - _THICK * share)):
        out, up, into = begin[0] + side * width, lane - side * width, end[0] + side * width
        below = _arc(out, up, begin[1], -deep)
        above = _arc(up, into, end[1], deep)
        edges.append(np.concatenate([below, above]))
    return np.concatenate([edges[0], edges[1][::-1]])


def _arc(begin: float, end: float, level: float, reach: float) -> Numbers:
    angle = np.pi * _STEPS
    x = (begin + end) / 2 + (begin - end) / 2 * np.cos(angle)
    return np.stack([x, level + reach * np.sin(angle)], axis=-1)
