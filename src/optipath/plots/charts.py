"""Charts of the lab: speed against accuracy, critical curves, other software."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from optipath.errors import OptipathError, shown
from optipath.lab.bench import duration
from optipath.lab.chart_file import CRITICAL, checked_chart, read_chart
from optipath.lab.peer_times import peer_times
from optipath.plots.chart_panel import (
    FAILING,
    GAP,
    LEFT,
    LINE,
    PANEL,
    POINTS,
    RIGHT,
    WIDTH,
    WORDS,
    ChartFrame,
    Looks,
    Mark,
    colours_of,
    draw_panel,
    name_rows,
    plain_axes,
    powers_of_ten,
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
        return _draw_critical(result)
    if peers is None:
        return _draw_speed_and_accuracy(result)
    file = input_file(peers, OptipathError)
    return _draw_speed_and_accuracy(result, peer_times(_text(file), str(file), result))


def _text(file: Path) -> str:
    try:
        return file.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", "it is no text in UTF-8")
        raise OptipathError(f"{shown(str(file))} cannot be read: {reason}") from None


_KINDS = {
    "componentwise": "each component by itself, over its condition",
    "normwise": "against the intensity, over its condition",
}
_EDGE = 0.25
"""Between words and the edge of a picture, in inches."""

_INNER = WIDTH - 2 * _EDGE
_TITLE = 20.0
_FOOT = 0.8
"""How high the ticks and the label below a panel are."""


def _page(below: float, panels: float, title: str, messages: list[str]) -> Figure:
    """Return a figure with a title, lines below it, and room for panels and what is below them."""
    height = below + panels + 0.75 + LINE * len(messages) + 0.3
    figure = Figure(figsize=(WIDTH, height), dpi=120)
    style: dict[str, Any] = {"ha": "center", "va": "top", **WORDS}
    words = shortened(title, _INNER, _TITLE)
    figure.text(0.5, 1 - 0.2 / height, words, **style | {"fontsize": _TITLE})
    for number, line in enumerate(messages):
        figure.text(0.5, 1 - (0.65 + LINE * number) / height, line, **style)
    return figure


def _add_panel(figure: Figure, left: float, below: float, width: float, height: float) -> Axes:
    """Return axes at a place in inches."""
    tall = figure.get_figheight()
    return figure.add_axes((left / WIDTH, below / tall, width / WIDTH, height / tall))


def _interrupted(chart: Mapping[str, Any], what: str) -> list[str]:
    """Return the sentence that not everything has been measured, where that is so."""
    counts = chart.get("regions") or {"measured": 1, "of": 1}
    if counts["measured"] == counts["of"]:
        return []
    return [f"interrupted: {counts['measured']} of {counts['of']} {what}"]


def _listed(parts: list[str]) -> list[str]:
    """Return parts with semicolons between them."""
    return [*(f"{part};" for part in parts[:-1]), *parts[-1:]]


def _draw_speed_and_accuracy(chart: Mapping[str, Any], peers: PeerTimes | None = None) -> Panel:
    """Draw what `path_chart` or `interface_chart` has measured."""
    looks = Looks(chart)
    marks = {
        kind: [Mark.of(entry, kind, chart["fails_above"]) for entry in chart["contenders"]]
        for kind in _KINDS
    }
    frame = ChartFrame.around(chart, [mark for panel in marks.values() for mark in panel])
    legend = _rows(_groups(chart, looks, fails=bool(frame.methods)))
    notes = [_failing_lines(chart, kind, result) for kind, result in marks.items()]
    other = _MAIN + LINE * (len(peers.racers) + 1.3) if peers else 0.0
    lowest = other + _FOOT + 0.7 if peers else 0.0
    top = lowest + LINE * max(map(len, notes)) + _EDGE
    below = top + 0.1 + LINE * 1.15 * len(legend)
    message = broken(_listed(_effort(chart)), _INNER, POINTS)
    title = f"Speed against accuracy: {chart['title']}"
    figure = _page(below, _FOOT + frame.height, title, message)
    axes = []
    for place, (kind, title) in enumerate(_KINDS.items()):
        left = LEFT + place * (PANEL + GAP)
        panel = _add_panel(figure, left, below + _FOOT, PANEL, frame.height)
        draw_panel(panel, chart, marks[kind], frame, looks)
        panel.set_title(title, fontsize=POINTS, color=INK, pad=8)
        panel.set_xlabel("time a path", fontsize=POINTS, color=INK)
        panel.tick_params(labelleft=place == 0)
        axes.append(panel)
    name_rows(axes[0], frame)
    axes[0].set_ylabel("relative error", fontsize=POINTS, color=INK)
    axes[0].yaxis.set_label_coords(-0.9 / PANEL, frame.middle)
    _draw_legend(figure, legend, below - 0.05)
    for place, lines in enumerate(notes):
        for number, (colour, line) in enumerate(lines):
            left, y = _EDGE / WIDTH + place / 2, (top - LINE * number) / figure.get_figheight()
            figure.text(left, y, "■" if colour else "", va="top", **WORDS | {"color": colour})
            figure.text(left + (0.3 / WIDTH if number else 0.0), y, line, va="top", **WORDS)
    if peers:
        axes.append(_add_panel(figure, LEFT, _FOOT, _ROOM, other))
        _draw_peers(axes[-1], peers, other)
        caption = (
            "Other software (grey) beside optipath (blue), in one race over random paths;\n"
            f"times x {peers.ratio:.3g}, which makes '{peers.shared}' as fast as above"
        )
        figure.text(_EDGE / WIDTH, lowest / figure.get_figheight(), caption, va="top", **WORDS)
    return np.array(axes, object)


def _effort(chart: Mapping[str, Any]) -> list[str]:
    """Return how much was measured, as far as the chart says so."""
    said = []
    if effort := chart.get("effort"):
        said += [f"{effort['samples']} samples a region, {effort['rounds']} turns"]
        said += [effort["left_out"]]
    said += _interrupted(chart, "regions")
    machine, versions = chart.get("machine", {}), chart.get("versions", {})
    said += [", ".join(str(machine[key]) for key in ("system", "processor") if key in machine)]
    said += [", ".join(f"{name} {number}" for name, number in versions.items())]
    return [part for part in said if part]


def _failing_lines(
    chart: Mapping[str, Any], kind: str, marks: list[Mark]
) -> list[tuple[str | None, str]]:
    """Return the lines that tell where methods fail, the first one of each with its color."""
    regions = dict.fromkeys(name for entry in chart["contenders"] for name in entry["errors"][kind])
    colours = Looks(chart).colours
    results: list[tuple[str | None, str]] = []
    for method in dict.fromkeys(mark.method for mark in marks if mark.fails):
        own = [mark for mark in marks if mark.method == method]
        where = {name: [mark for mark in own if name in mark.fails] for name in regions}
        failing = [name for name, marked in where.items() if marked]
        words = [f"{shortened(method, 1.6, POINTS)}:"]
        if all(len(marked) == len(own) for marked in where.values()):
            words += ["everywhere"]
        elif len(regions) > len(failing) > len(regions) / 2:
            words += ["all but:", *_listed([name for name in regions if name not in failing])]
        else:
            words += _listed([name + _precisions(where[name], own) for name in failing])
        first, *more = broken(words, WIDTH / 2 - 2 * _EDGE - 0.3, POINTS)
        results += [(colours[method], first), *((None, line) for line in more)]
    count = "1 region" if len(regions) == 1 else f"{len(regions)} regions"
    return [(None, f"Where methods fail, {kind}, of {count}:"), *results] if results else []


def _precisions(failing: list[Mark], own: list[Mark]) -> str:
    """Return the precisions that fail in a region, if others of the method hold there."""
    dtypes = {mark.dtype for mark in failing}
    if len(failing) == len(own):
        return ""
    if len(failing) == sum(mark.dtype in dtypes for mark in own):
        return f" ({', '.join(sorted(dtypes))})"
    return " (in part)"


_FILLED = {"numba": "filled", "numpy": "open"}


def _key(label: str, **style: Any) -> Line2D:
    """Return a handle of the legend: a mark if there is a marker, else a line."""
    style = {"color": INK, "markersize": 11, **style}
    return Line2D([], [], label=shortened(label, 6.0, POINTS), **style)


def _groups(chart: Mapping[str, Any], looks: Looks, *, fails: bool) -> list[list[Artist]]:
    """Return what is explained, each group in rows of its own."""
    dot: dict[str, Any] = {"marker": "o", "linewidth": 0}
    groups: list[list[Artist]] = [
        [
            *(_key(name, color=colour, lw=7) for name, colour in looks.colours.items()),
            *(_key(name, linewidth=0, marker=shape) for name, shape in looks.shapes.items()),
        ],
        [
            _key(f"{_FILLED.get(name, 'half')}: {name}", **dot, mew=1.8, **face)
            for name, face in looks.faces.items()
        ],
        [
            _key("frontier: best that fails nowhere", color=FAINT, lw=1.8),
            _key("eps", color=FAINT, ls="--"),
            _key("machine's limit", color=FAINT, lw=1.6, ls=":"),
        ],
    ]
    for name in looks.ways if len(looks.ways) > 1 else ():
        words = {"stokes": "large: Stokes", "jones": "small: Jones"}.get(name, f"large: {name}")
        groups[1].append(_key(words, **dot | {"markersize": looks.size(name)}))
    groups[1] += [
        _key("worst region", **dot),
        _key("middle region", **dot | {"marker": "_"}, mew=2),
    ]
    if fails:
        label = f"fails (over {chart['fails_above']:g} ulp*) in so many regions"
        groups[-1].insert(0, Patch(facecolor=FAILING, label=label))
        ulp = "units in the last place, divided by 1 + the condition number"
        groups.append([_key(ulp, **dot | {"marker": "$*$", "markersize": 9})])
    return groups


def _rows(groups: list[list[Artist]]) -> list[list[Artist]]:
    """Return what is explained in rows that fit the width of a picture."""
    rows: list[list[Artist]] = []
    for group in groups:
        reached = WIDTH
        for handle in group:
            needed = 0.6 + 1.03 * width_of(str(handle.get_label()), POINTS)
            if reached + needed > _INNER:
                rows.append([])
                reached = 0.0
            rows[-1].append(handle)
            reached += needed
    return rows


def _draw_legend(figure: Figure, rows: list[list[Artist]], top: float) -> None:
    """Draw rows of what is explained."""
    for number, row in enumerate(rows):
        figure.legend(
            handles=row,
            ncols=len(row),
            loc="upper left",
            bbox_to_anchor=(_EDGE / WIDTH, (top - LINE * 1.15 * number) / figure.get_figheight()),
            borderaxespad=0.0,
            borderpad=0.0,
            frameon=False,
            fontsize=POINTS,
            labelcolor=INK,
            handlelength=1.3,
            handletextpad=0.5,
            columnspacing=1.1,
        )


_MAIN = 2.2
_ROOM = WIDTH - LEFT - RIGHT


def _draw_peers(axes: Axes, peers: PeerTimes, height: float) -> None:
    """Draw error over time of all who took part in a race, their names in rows above."""
    racers = sorted(peers.racers, key=lambda racer: racer.ns, reverse=True)
    names = [shortened(racer.name, _ROOM / 2, POINTS) for racer in racers]
    at = np.log10([racer.ns for racer in racers])
    wide = np.array([1.04 * width_of(name, POINTS) + 0.15 for name in names])
    first = at.min() - 0.2
    # Wide enough that the last name ends within.
    decades = max(1.0, float(np.max((at - first) * _ROOM / (_ROOM - wide))))
    errors = np.log10([racer.error for racer in racers])
    low, high = errors.min() - 0.7, errors.max() + 0.7
    top = low + (high - low) * height / _MAIN
    times = 10.0**first, 10.0 ** (first + decades)
    plain_axes(axes, xlim=times, ylim=(10.0**low, 10.0**top))
    axes.set_xticks(powers_of_ten(*times, 10))
    axes.set_yticks(powers_of_ten(10.0**low, 10.0**high, 6))
    axes.minorticks_off()
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    for row, (racer, name) in enumerate(zip(racers, names, strict=True)):
        colour = LINES[0] if racer.is_own else FAINT
        y = (_MAIN + LINE * (row + 0.1)) / height
        axes.plot([racer.ns] * 2, [racer.error, 10.0 ** (low + (top - low) * y)], color=colour)
        axes.lines[-1].set(linewidth=0.8, alpha=0.7)
        axes.plot(racer.ns, racer.error, "o", color=colour, markersize=11)
        axes.text(racer.ns, y, name, transform=axes.get_xaxis_transform(), va="bottom", **WORDS)
    axes.set_xlabel("time a path", fontsize=POINTS, color=INK)
    axes.set_ylabel("largest error / S0", fontsize=POINTS, color=INK)
    axes.yaxis.set_label_coords(-0.9 / _ROOM, _MAIN / 2 / height)


_LEFT, _BETWEEN, _HIGH, _UNDER = 1.35, 0.35, 3.3, 0.85
_DASHES: dict[str, Any] = {"componentwise": "-", "normwise": (0, (3, 1.5))}
_LOST = 1.0
"""The relative error of a number of which no digit is right, at which larger ones are drawn."""


def _draw_critical(chart: Mapping[str, Any]) -> Panel:
    """Draw what `critical_chart` has measured, a panel a place."""
    places = chart["places"]
    colours = colours_of(dict.fromkeys(name for place in places for name in place["errors"]))
    columns = min(2, len(places))
    rows = -(-len(places) // columns)
    methods: list[Artist] = [_key(name, color=colour, lw=7) for name, colour in colours.items()]
    kinds: list[Artist] = [
        _key("each component by itself", lw=2.2, ls=_DASHES["componentwise"]),
        _key("against the intensity", lw=2.2, ls=_DASHES["normwise"]),
        _key("fails above", lw=2.2, color=FAINT, ls=":"),
        _key("rounding, eps", lw=2.2, color=FAINT, ls="--"),
    ]
    legend = _rows([methods, kinds])
    said = [
        f"the worst of {chart['samples']} samples at each distance, over its condition",
        f"{shortened(chart['dtype'], 2.0, POINTS)}, NumPy, Stokes vectors",
        "at 1 no digit is right",
    ]
    message = broken(_listed([*said, *_interrupted(chart, "distances")]), _INNER, POINTS)
    below = LINE * 1.15 * len(legend) + _EDGE
    title = f"Where methods fail: {chart['title']}"
    figure = _page(below, rows * (_HIGH + _UNDER) - 0.2, title, message)
    wide = (WIDTH - _LEFT - _EDGE - _BETWEEN * (columns - 1)) / columns
    axes = []
    for number, place in enumerate(places):
        row, column = divmod(number, columns)
        under = below + (rows - row - 1) * (_HIGH + _UNDER) + _UNDER
        panel = _add_panel(figure, _LEFT + column * (wide + _BETWEEN), under, wide, _HIGH)
        _draw_place(panel, chart, place, colours)
        if column == 0:
            panel.set_ylabel("relative error", fontsize=POINTS, color=INK)
        panel.tick_params(labelleft=column == 0)
        axes.append(panel)
    _draw_legend(figure, legend, below - 0.05)
    return np.array(axes, object)


def _draw_place(
    axes: Axes, chart: Mapping[str, Any], place: Mapping[str, Any], colours: Mapping[str, str]
) -> None:
    """Draw errors over the distance from one place."""
    eps, distances = chart["eps"], place["distances"]
    limits = min(distances) / 1.5, max(distances) * 1.5
    plain_axes(axes, xlim=limits, ylim=(eps / 30, 30.0))
    axes.set_yticks(10.0 ** np.arange(0.0, np.log10(eps / 30), -4.0))
    axes.minorticks_off()
    axes.axhline(eps, color=FAINT, linewidth=1.2, linestyle="--")
    axes.axhline(chart["fails_above"] * eps, color=FAINT, linewidth=1.2, linestyle=":")
    for method, kinds in place["errors"].items():
        for kind, dashes in _DASHES.items():
            # An error of nothing has no place on a logarithmic axis.
            errors = np.clip(np.array(kinds[kind]) * eps, eps / 10, _LOST)
            axes.plot(distances, errors, color=colours[method], linestyle=dashes, linewidth=2.2)
    words = shortened(f"distance from {place['called']} (rad)", 5.3, POINTS)
    axes.set_xlabel(words, **WORDS)
