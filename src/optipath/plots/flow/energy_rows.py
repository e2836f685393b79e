"""Where the elements and the links of a path stand in a picture of its energy: rows and lanes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from optipath.paths.energy_along import EnergyAlong, PowerOnLink


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


def energy_rows(found: EnergyAlong) -> EnergyRows:
    """Return the rows of a path, each element in one of its own, and the lanes of its links.

    Light goes on in the lane of its element, and what parts from it in the next that is free;
    light that comes back goes up to the right of all others.

    Examples
    --------
    >>> import optipath as op
    >>> from optipath.paths.energy_along import energy_along
    >>> rows = energy_rows(energy_along(op.load_preset("two-panes"))).rows
    >>> [(row.name, row.lane, row.told) for row in rows[:4]]
    [('lamp', 0, 'gives'), ('pane1', 0, ''), ('pane1.transmitted', 1, 'leaves'), ('pane2', 0, '')]
    """
    names = _in_order(found.links)
    place = {name: row for row, name in enumerate(names)}
    lanes, ways = _lanes(found.links, place)
    rows = [EnergyRow(name, lanes[name], *_told(name, found)) for name in names]
    links = [
        EnergyLink(link.start, _end(link), float(link.power), lane, _is_back(link, place), link.tap)
        for link, lane in zip(found.links, ways, strict=True)
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


def _told(name: str, found: EnergyAlong) -> tuple[str, float]:
    for word, powers in (("gives", found.given), ("leaves", found.left), ("gets", found.ended)):
        if name in powers:
            return word, float(powers[name])
    if name in found.taken:
        power = float(found.taken[name])
        return ("takes" if power > 0.0 else "adds" if power < 0.0 else ""), abs(power)
    return "reads", float(np.sum([link.power for link in found.links if _end(link) == name]))
