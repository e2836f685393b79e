"""Where the bars and the ribbons of a picture of energy are, in units of the largest power."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from optipath.plots.flow.ribbons import ribbon, turned_back

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.plots.flow.energy_rows import EnergyLink, EnergyRow, EnergyRows

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
        """Return the outline of what an element takes: a spike on the right of what goes on.

        What leaves to the right begins on the right of it, and does not cross it.
        """
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
        beside = [
            each
            for each in self.drawn.links
            if (each.start if leaves else each.end) == name and not each.tap
        ]
        beside.sort(key=lambda each: each.lane)
        row = next(row for row in self.drawn.rows if row.name == name)
        x = self.left[row.lane]
        if leaves and row.told == "takes" and link.lane > row.lane:
            x += row.power
        for each in beside:
            if each is link:
                return x + link.power / 2
            x += each.power
        return x
