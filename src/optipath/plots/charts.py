"""Charts of the lab: speed against accuracy, critical curves, other software."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from optipath.errors import OptipathError, shown
from optipath.lab.bench import duration
from optipath.lab.chart_file import CRITICAL, checked_chart, read_chart
from optipath.lab.peer_times import peer_times
from optipath.plots.chart_panel import (
    EDGE,
    GAP,
    LEFT,
    LINE,
    POINTS,
    RIGHT,
    WIDTH,
    ChartFrame,
    Looks,
    draw_legend,
    draw_panel,
    failing_lines,
    flowing,
    legend_rows,
    marks_of,
    name_rows,
    panel_width,
)
from optipath.plots.colors import FAINT, INK, LINES
from optipath.plots.text import broken, shortened, width_of
from optipath.values.files import input_file

if TYPE_CHECKING:
    import os
    from pathlib import Path

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from optipath.lab.peer_times import PeerTimes
    from optipath.plots.axes import Panel
    from optipath.plots.chart_panel import Mark


def chart(
    measured: Mapping[str, Any] | str | os.PathLike[str],
    *,
    peers: str | os.PathLike[str] | None = None,
) -> Panel:
    """Draw speed against accuracy, or how errors grow next to the places where methods fail.

    A colour is a method, a shape a precision; filled marks are of Numba and open ones of NumPy,
    small ones are of Jones columns. What fails in some region stands in a band of its own.

    Parameters
    ----------
    measured : mapping, str or path
        What ``optipath chart --data`` wrote: the file, or what is in it.
    peers : str or path, optional
        What ``benchmarks/peers/race.py --json`` wrote: other software is drawn beside, its times
        multiplied by that of optipath here over that in the race.

    Returns
    -------
    ndarray of Axes
        Of a figure of their own.

    Raises
    ------
    OptipathError
        If it is no chart, or a race that cannot be compared with it.

    Examples
    --------
    >>> place = {"name": "normal", "called": "the normal", "distances": [1e-6, 1e-3]}
    >>> place["errors"] = {"stable": {"componentwise": [2.0, 1.0], "normwise": [1.0, 1.0]}}
    >>> head = {"format": 1, "drawn": "errors next to critical places", "title": "glass"}
    >>> head |= {"dtype": "float64", "eps": 2.2e-16, "fails_above": 1000.0, "samples": 6}
    >>> [ax.get_xlabel() for ax in chart({**head, "places": [place]})]
    ['distance from the normal (rad)']
    """
    if isinstance(measured, Mapping):
        result = checked_chart(measured, "what is given")
    else:
        file = input_file(measured, OptipathError)
        result = read_chart(_text(file), str(file))
    if result.get("drawn") == CRITICAL:
        if peers is not None:
            raise OptipathError("peers stand beside speed and accuracy alone; leave them out")
        return draw_critical(result)
    if peers is None:
        return draw_speed_and_accuracy(result)
    file = input_file(peers, OptipathError)
    return draw_speed_and_accuracy(result, peer_times(_text(file), str(file), result))


def _text(file: Path) -> str:
    try:
        return file.read_text("utf-8")
    except OSError as error:
        raise OptipathError(f"{shown(str(file))} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise OptipathError(f"{shown(str(file))} is no text in UTF-8") from None


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
    notes = [_notes(chart, kind, result) for kind, result in marks.items()]
    message = broken(_effort_lines(chart), WIDTH - 2 * EDGE, POINTS)
    other = PeerFrame.of(peers) if peers else None
    below = LINE * 1.15 * len(legend) + 0.1 + LINE * max(map(len, notes)) + EDGE
    lowest = other.height + _FOOT + _TITLED if other else 0.0
    below += lowest
    above = _HEAD + LINE * len(message) + 0.3
    height = below + _FOOT + frame.height + above
    figure = Figure(figsize=(WIDTH, height), dpi=120)
    _head(figure, chart["title"], message)
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
    if peers and other:
        room = LEFT / WIDTH, _FOOT / height, 1 - (LEFT + RIGHT) / WIDTH, other.height / height
        axes.append(figure.add_axes(room))
        draw_peers(axes[-1], peers, other)
        for number, line in enumerate(peers_caption(peers)):
            y = (lowest - LINE * number) / height
            figure.text(EDGE / WIDTH, y, line, fontsize=POINTS, va="top", color=INK)
    return np.array(axes, object)


def _head(figure: Figure, title: str, messages: list[str]) -> None:
    height = figure.get_figheight()
    words = shortened(f"Speed against accuracy: {title}", WIDTH - 2 * EDGE, _TITLE)
    keywords: dict[str, Any] = {"ha": "center", "va": "top", "color": INK, "parse_math": False}
    figure.text(0.5, 1 - 0.2 / height, words, fontsize=_TITLE, **keywords)
    for number, line in enumerate(messages):
        y = 1 - (_HEAD + LINE * number - 0.1) / height
        figure.text(0.5, y, line, fontsize=POINTS, **keywords)


def _effort_lines(chart: Mapping[str, Any]) -> list[str]:
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


_MAIN = 2.2
_ROOM = WIDTH - LEFT - RIGHT


class PeerFrame(NamedTuple):
    """Which times are seen, and in which row each name stands."""

    names: tuple[str, ...]
    rows: tuple[int, ...]
    times: tuple[float, float]

    @classmethod
    def of(cls, peers: PeerTimes) -> PeerFrame:
        """Return the frame of all names."""
        names = [shortened(racer.name, _ROOM / 2, POINTS) for racer in peers.racers]
        wide = np.array([1.04 * width_of(name, POINTS) + 0.15 for name in names])
        at = np.log10([racer.ns for racer in peers.racers])
        first = at.min() - 0.2
        # Wide enough that the last name ends within.
        decades = max(1.0, float(np.max((at - first) * _ROOM / (_ROOM - wide))))
        begin = (at - first) * _ROOM / decades
        rows = np.zeros(len(names), int)
        done: list[int] = []
        for place in np.argsort(begin)[::-1]:
            beneath = [rows[other] for other in done if begin[other] < begin[place] + wide[place]]
            rows[place] = max(beneath, default=-1) + 1
            done.append(int(place))
        times = float(10.0**first), float(10.0 ** (first + decades))
        return cls(tuple(names), tuple(rows.tolist()), times)

    @property
    def height(self) -> float:
        """How high the panel is, in inches."""
        return _MAIN + LINE * (max(self.rows) + 1.3)


def draw_peers(axes: Axes, peers: PeerTimes, frame: PeerFrame) -> None:
    """Draw error over time of all who took part in a race."""
    errors = np.log10([racer.error for racer in peers.racers])
    low, high = errors.min() - 0.7, errors.max() + 0.7
    top = low + (high - low) * frame.height / _MAIN
    axes.set(xscale="log", yscale="log", xlim=frame.times, ylim=(10.0**low, 10.0**top))
    powers = np.arange(np.ceil(low), np.floor(high) + 1)
    axes.set_yticks(10.0 ** powers[:: len(powers) // 6 + 1])
    axes.minorticks_off()
    axes.xaxis.set_major_locator(LogLocator(numticks=10))
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    axes.tick_params(colors=INK, labelsize=POINTS)
    axes.grid(visible=True, color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    words: dict[str, Any] = {"fontsize": POINTS, "va": "bottom", "parse_math": False}
    across = axes.get_xaxis_transform()
    for racer, name, row in zip(peers.racers, frame.names, frame.rows, strict=True):
        colour = LINES[0] if racer.is_own else FAINT
        y = (_MAIN + LINE * (row + 0.1)) / frame.height
        in_axes = low + (top - low) * y
        axes.plot([racer.ns] * 2, [racer.error, 10.0**in_axes], color=colour, lw=0.8, alpha=0.7)
        axes.plot(racer.ns, racer.error, "o", color=colour, markersize=11)
        text = axes.text(racer.ns, y, name, transform=across, color=INK, **words)
        text.set_fontweight("normal")
    axes.set_xlabel("time a path", fontsize=POINTS, color=INK)
    axes.set_ylabel("largest error / S0", fontsize=POINTS, color=INK)
    middle = _MAIN / 2 / frame.height
    axes.yaxis.set_label_coords(-0.9 / _ROOM, middle)


def peers_caption(peers: PeerTimes) -> list[str]:
    """Return what is said above the panel, a sentence each."""
    return [
        "Other software (grey) beside optipath (blue), in one race over random paths;",
        f"times x {peers.ratio:.3g}, which makes '{peers.shared}' as fast as above",
    ]


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
    message = broken(_caption_of_curves(chart), WIDTH - 2 * EDGE, POINTS)
    below = LINE * 1.15 * len(legend) + EDGE
    above = 0.75 + LINE * len(message) + 0.1
    height = below + rows * (_HIGH + _UNDER) + above
    figure = Figure(figsize=(WIDTH, height), dpi=120)
    words: dict[str, Any] = {"ha": "center", "va": "top", "color": INK, "parse_math": False}
    title = shortened(f"Where methods fail: {chart['title']}", WIDTH - 2 * EDGE, 20.0)
    figure.text(0.5, 1 - 0.2 / height, title, fontsize=20.0, **words)
    for number, line in enumerate(message):
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


def _caption_of_curves(chart: Mapping[str, Any]) -> list[str]:
    said = [
        f"the worst of {chart['samples']} samples at each distance, over its condition;",
        f"{shortened(chart['dtype'], 2.0, POINTS)}, NumPy, Stokes vectors;",
        "at 1 no digit is right",
    ]
    if (regions := chart.get("regions")) and regions["measured"] < regions["of"]:
        said[-1] += ";"
        said.append(f"interrupted: {regions['measured']} of {regions['of']} distances")
    return said
