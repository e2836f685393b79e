"""The chart of speed against accuracy, as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from optipath.plots.charts.chart_frame import GAP, LEFT, LINE, RIGHT, WIDTH, ChartFrame, panel_width
from optipath.plots.charts.chart_legend import EDGE, draw_legend, failing_lines, legend_rows
from optipath.plots.charts.chart_marks import POINTS, Looks, marks_of
from optipath.plots.charts.chart_panel import draw_panel, name_rows
from optipath.plots.charts.peer_panel import PeerFrame, draw_peers, told_of_peers
from optipath.plots.line_colours import INK
from optipath.plots.text_width import broken, shortened

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.lab.accuracy.peer_times import PeerTimes
    from optipath.plots.charts.chart_marks import Mark
    from optipath.plots.own_axes import Panel

_KINDS = {
    "componentwise": "each component by itself, over its condition",
    "normwise": "against the intensity, over its condition",
}
_TITLE, _HEAD, _FOOT, _TITLED = 20.0, 0.75, 0.8, 0.7


def draw_speed_and_accuracy(chart: Mapping[str, Any], peers: PeerTimes | None = None) -> Panel:
    """Draw what `path_chart` or `interface_chart` has measured."""
    looks = Looks(chart)
    marks = {kind: marks_of(chart, kind) for kind in _KINDS}
    frame = ChartFrame.around(chart, list(marks.values()))
    legend = legend_rows(chart, looks, fails=bool(frame.methods))
    notes = [_notes(chart, kind, found) for kind, found in marks.items()]
    told = broken(_told(chart), WIDTH - 2 * EDGE, POINTS)
    beside = PeerFrame.of(peers) if peers else None
    below = LINE * 1.15 * len(legend) + 0.1 + LINE * max(map(len, notes)) + EDGE
    lowest = beside.height + _FOOT + _TITLED if beside else 0.0
    below += lowest
    above = _HEAD + LINE * len(told) + 0.3
    height = below + _FOOT + frame.height + above
    figure = Figure(figsize=(WIDTH, height), dpi=120)
    _head(figure, chart["title"], told)
    axes = []
    for place, (kind, title) in enumerate(_KINDS.items()):
        left = LEFT + place * (panel_width() + GAP)
        room = left / WIDTH, (below + _FOOT) / height, panel_width() / WIDTH, frame.height / height
        panel = figure.add_axes(room)
        draw_panel(panel, chart, marks[kind], frame, looks)
        panel.set_title(title, fontsize=POINTS, color=INK, pad=8)
        panel.set_xlabel("time a path", fontsize=POINTS, color=INK)
        panel.tick_params(labelleft=place == 0)
        axes.append(panel)
    middle = frame.share((frame.inches(frame.errors[0]) + frame.inches(frame.errors[1])) / 2)
    name_rows(axes[0], frame)
    axes[0].set_ylabel("relative error", fontsize=POINTS, color=INK)
    axes[0].yaxis.set_label_coords(-0.9 / panel_width(), middle)
    draw_legend(figure, legend, below - 0.05)
    top = below - LINE * 1.15 * len(legend) - 0.1
    for place, lines in enumerate(notes):
        _write(figure, lines, EDGE + place * WIDTH / 2, top, looks)
    if peers and beside:
        room = LEFT / WIDTH, _FOOT / height, 1 - (LEFT + RIGHT) / WIDTH, beside.height / height
        axes.append(figure.add_axes(room))
        draw_peers(axes[-1], peers, beside)
        for number, line in enumerate(told_of_peers(peers)):
            y = (lowest - LINE * number) / height
            figure.text(EDGE / WIDTH, y, line, fontsize=POINTS, va="top", color=INK)
    return np.array(axes, object)


def _head(figure: Figure, title: str, told: list[str]) -> None:
    height = figure.get_figheight()
    words = shortened(f"Speed against accuracy: {title}", WIDTH - 2 * EDGE, _TITLE)
    keywords: dict[str, Any] = {"ha": "center", "va": "top", "color": INK, "parse_math": False}
    figure.text(0.5, 1 - 0.2 / height, words, fontsize=_TITLE, **keywords)
    for number, line in enumerate(told):
        y = 1 - (_HEAD + LINE * number - 0.1) / height
        figure.text(0.5, y, line, fontsize=POINTS, **keywords)


def _told(chart: Mapping[str, Any]) -> list[str]:
    """Return how much was measured, as far as the chart says so."""
    said = []
    if effort := chart.get("effort"):
        said.append(f"{effort['samples']} samples a region, {effort['rounds']} turns")
        said += [effort["left_out"]] if effort["left_out"] else []
    if (regions := chart.get("regions")) and regions["measured"] < regions["of"]:
        said.append(f"interrupted: {regions['measured']} of {regions['of']} regions")
    machine, versions = chart.get("machine", {}), chart.get("versions", {})
    said.append(", ".join(str(machine[key]) for key in ("system", "processor") if key in machine))
    said.append(", ".join(f"{name} {number}" for name, number in versions.items()))
    parts = [part for part in said if part]
    return [*(f"{part};" for part in parts[:-1]), *parts[-1:]]


def _notes(chart: Mapping[str, Any], kind: str, marks: list[Mark]) -> list[tuple[str, str]]:
    regions = dict.fromkeys(name for entry in chart["contenders"] for name in entry["errors"][kind])
    count = "1 region" if len(regions) == 1 else f"{len(regions)} regions"
    lines = failing_lines(marks, list(regions), WIDTH / 2 - 2 * EDGE - 0.3)
    return [("", f"Where methods fail, {kind}, of {count}:"), *lines] if lines else []


def _write(
    figure: Figure, lines: list[tuple[str, str]], left: float, top: float, looks: Looks
) -> None:
    height = figure.get_figheight()
    words: dict[str, Any] = {"fontsize": POINTS, "va": "top", "parse_math": False}
    for number, (method, line) in enumerate(lines):
        y = (top - LINE * number) / height
        aside = 0.3 if number else 0.0
        if method:
            figure.text(left / WIDTH, y, "■", color=looks.colour(method), **words)
        figure.text((left + aside) / WIDTH, y, line, color=INK, **words)
