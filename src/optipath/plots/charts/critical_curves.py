"""How the error of each method grows next to the places where it fails, as curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from optipath.plots.charts.chart_frame import LINE, WIDTH
from optipath.plots.charts.chart_legend import EDGE, draw_legend, flowing
from optipath.plots.charts.chart_marks import POINTS
from optipath.plots.line_colours import FAINT, INK, LINES
from optipath.plots.text_width import broken, shortened

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from optipath.plots.own_axes import Panel

_LEFT, _BETWEEN, _HIGH, _UNDER = 1.35, 0.35, 3.3, 0.85
_DASHES: dict[str, Any] = {"componentwise": "-", "normwise": (0, (3, 1.5))}
_LOST = 1.0
"""The relative error of a number of which no digit is right, at which larger ones are drawn."""


def draw_critical(chart: Mapping[str, Any]) -> Panel:
    """Draw what `critical_chart` has measured, a panel a place."""
    places = chart["places"]
    methods = list(dict.fromkeys(name for place in places for name in place["errors"]))
    columns = min(2, len(places))
    rows = -(-len(places) // columns)
    legend = flowing(_legend(methods))
    told = broken(_told(chart), WIDTH - 2 * EDGE, POINTS)
    below = LINE * 1.15 * len(legend) + EDGE
    above = 0.75 + LINE * len(told) + 0.1
    height = below + rows * (_HIGH + _UNDER) + above
    figure = Figure(figsize=(WIDTH, height), dpi=120)
    words: dict[str, Any] = {"ha": "center", "va": "top", "color": INK, "parse_math": False}
    title = shortened(f"Where methods fail: {chart['title']}", WIDTH - 2 * EDGE, 20.0)
    figure.text(0.5, 1 - 0.2 / height, title, fontsize=20.0, **words)
    for number, line in enumerate(told):
        figure.text(0.5, 1 - (0.65 + LINE * number) / height, line, fontsize=POINTS, **words)
    wide = (WIDTH - _LEFT - EDGE - _BETWEEN * (columns - 1)) / columns
    axes = []
    for number, place in enumerate(places):
        row, column = divmod(number, columns)
        left = _LEFT + column * (wide + _BETWEEN)
        under = below + (rows - row - 1) * (_HIGH + _UNDER) + _UNDER
        room = left / WIDTH, under / height, wide / WIDTH, _HIGH / height
        panel = figure.add_axes(room)
        _draw_place(panel, chart, place, methods)
        if column == 0:
            panel.set_ylabel("relative error", fontsize=POINTS, color=INK)
        panel.tick_params(labelleft=column == 0)
        axes.append(panel)
    draw_legend(figure, legend, below - 0.05)
    return np.array(axes, object)


def _draw_place(
    axes: Axes, chart: Mapping[str, Any], place: Mapping[str, Any], methods: list[str]
) -> None:
    eps = chart["eps"]
    low, high = eps / 30, 30.0
    axes.set(xscale="log", yscale="log", ylim=(low, high))
    powers = np.arange(np.ceil(np.log10(low)), 1.0)
    axes.set_yticks(10.0 ** powers[::-1][::4])
    axes.minorticks_off()
    axes.tick_params(colors=INK, labelsize=POINTS)
    axes.grid(visible=True, color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.axhline(eps, color=FAINT, linewidth=1.2, linestyle="--")
    axes.axhline(chart["fails_above"] * eps, color=FAINT, linewidth=1.2, linestyle=":")
    for method, kinds in place["errors"].items():
        for kind, dashes in _DASHES.items():
            # An error of nothing has no place on a logarithmic axis.
            errors = np.clip(np.array(kinds[kind]) * eps, eps / 10, _LOST)
            axes.plot(
                place["distances"],
                errors,
                color=_colour(method, methods),
                linestyle=dashes,
                linewidth=2.2,
            )
    axes.set_xlim(min(place["distances"]) / 1.5, max(place["distances"]) * 1.5)
    words = shortened(f"distance from {place['called']} (rad)", 5.3, POINTS)
    axes.set_xlabel(words, fontsize=POINTS, color=INK, parse_math=False)


def _colour(method: str, methods: list[str]) -> str:
    place = methods.index(method)
    return LINES[place] if place < len(LINES) else INK


def _legend(methods: list[str]) -> list[list[Artist]]:
    def line(label: str, **looks: Any) -> Line2D:
        keywords: dict[str, Any] = {"color": INK, "lw": 2.2, **looks}
        return Line2D([], [], label=label, **keywords)

    return [
        [
            line(shortened(method, 3.0, POINTS), color=_colour(method, methods), lw=7)
            for method in methods
        ],
        [
            line("each component by itself", ls=_DASHES["componentwise"]),
            line("against the intensity", ls=_DASHES["normwise"]),
            line("fails above", color=FAINT, ls=":"),
            line("rounding, eps", color=FAINT, ls="--"),
        ],
    ]


def _told(chart: Mapping[str, Any]) -> list[str]:
    said = [
        f"the worst of {chart['samples']} samples at each distance, over its condition;",
        f"{shortened(chart['dtype'], 2.0, POINTS)}, NumPy, Stokes vectors;",
        "at 1 no digit is right",
    ]
    if (regions := chart.get("regions")) and regions["measured"] < regions["of"]:
        said[-1] += ";"
        said.append(f"interrupted: {regions['measured']} of {regions['of']} distances")
    return said
