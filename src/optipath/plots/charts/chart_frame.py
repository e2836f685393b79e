"""The frame of a chart's panels: how much room each part has, and which numbers are seen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.plots.charts.chart_marks import Mark

WIDTH = 13.0
"""Of a picture, in inches; as heights below."""

LEFT, GAP, RIGHT = 1.75, 0.35, 0.2
ROW = 0.34
LINE = 0.28

_STRIP, _MAIN = 0.36, 2.9
_BESIDE = 0.31
"""The share of the width, on the left, where words stand and no marks."""


class ChartFrame(NamedTuple):
    """The room of a panel from below: names of limits, marks, the frontier's name, what fails."""

    times: tuple[float, float]
    errors: tuple[float, float]
    methods: tuple[str, ...]
    limits: int

    @classmethod
    def around(cls, chart: Mapping[str, Any], panels: list[list[Mark]]) -> ChartFrame:
        """Return the frame of all panels of a chart."""
        marks = [mark for panel in panels for mark in panel]
        rows = dict.fromkeys(mark.method for mark in marks if mark.fails)
        held = [mark for mark in marks if not mark.fails]
        sizes = [size for mark in held for size in (mark.worst, mark.median)]
        sizes += [entry["eps"] for entry in chart["contenders"]]
        limits = list(chart["limits_ns"].values())
        return cls(
            _times([mark.ns for mark in marks], limits),
            (min(sizes) / 6, max(sizes) * 6),
            tuple(rows),
            len(limits),
        )

    @property
    def height(self) -> float:
        """How high a panel is."""
        return self.floor + _MAIN + _STRIP + self.band

    @property
    def floor(self) -> float:
        """How high the names of the limits reach."""
        return LINE * self.limits + 0.1

    @property
    def band(self) -> float:
        """How high the rows of what fails are."""
        return ROW * len(self.methods)

    @property
    def seen(self) -> tuple[float, float]:
        """The limits of the axis of errors, with the room below and above the marks."""
        low, high = np.log10(self.errors)
        inch = (high - low) / _MAIN
        below, above = low - inch * self.floor, high + inch * (_STRIP + self.band)
        return float(10.0**below), float(10.0**above)

    @property
    def decades(self) -> list[float]:
        """The errors that are written at the axis: at most seven powers of 10."""
        low, high = np.log10(self.errors)
        powers = np.arange(np.ceil(low), np.floor(high) + 1)
        return [float(10.0**power) for power in powers[:: len(powers) // 7 + 1]]

    @property
    def ticks(self) -> list[float]:
        """The times that are written at the axis: at most five powers of 10, none at an end."""
        first, last = np.log10(self.times)
        aside = 0.25 * (last - first) / panel_width()
        powers = np.arange(np.ceil(first + aside), np.floor(last - aside) + 1)
        return [float(10.0**power) for power in powers[:: (len(powers) - 1) // 5 + 1]]

    def share(self, inches: float) -> float:
        """Return a height over that of a panel."""
        return inches / self.height

    def inches(self, error: float) -> float:
        """Return how high an error stands in a panel."""
        low, high = np.log10(self.seen)
        return float((np.log10(error) - low) / (high - low)) * self.height


def _times(marked: list[float], limits: list[float]) -> tuple[float, float]:
    first, last = np.log10(min(marked)), np.log10(max(marked) * 1.7)
    width = max(last - first, 1.0) / (1.0 - _BESIDE)
    begin = min([last - width, *(np.log10(ns / 1.3) for ns in limits)])
    end = max([last, *(np.log10(ns * 1.3) for ns in limits)])
    return float(10.0**begin), float(10.0**end)


def panel_width() -> float:
    """Return how wide each of the two panels is."""
    return (WIDTH - LEFT - GAP - RIGHT) / 2
