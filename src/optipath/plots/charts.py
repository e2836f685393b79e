"""Charts of the lab: speed against accuracy, critical curves, other software, throughput."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import groupby
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import Bbox

from optipath.errors import OptipathError
from optipath.lab.bench import duration, rate
from optipath.lab.chart_file import CRITICAL, checked_chart, peer_times, read_chart
from optipath.plots.colors import DASHES, FAINT, INK, LINES
from optipath.plots.labels import Label, place_labels
from optipath.plots.text import broken, draw_key
from optipath.values.files import input_file, text_of

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Sequence

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from optipath.lab.chart_file import PeerTimes
    from optipath.lab.composition import Rates
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
        result = read_chart(text_of(file), str(file))
    if result.get("drawn") == CRITICAL:
        if peers is not None:
            raise OptipathError("peers stand beside speed and accuracy alone; leave them out")
        return _draw_critical(result)
    if peers is None:
        return _draw_speed_and_accuracy(result)
    file = input_file(peers, OptipathError)
    return _draw_speed_and_accuracy(result, peer_times(text_of(file), str(file), result))


_KINDS = {
    "componentwise": "each component by itself,\nover its condition",
    "normwise": "against the intensity,\nover its condition",
}
_POINTS = 14.0
"""Of texts; pictures of this size are shown at half of it in pages."""

_WIDTH, _HALF, _LINE = 13.0, 4.2, 0.27
"""The width of a picture, of texts below a panel, and the height of a line, in inches."""

_MAIN, _ROW = 2.9, 0.34
"""The height of the marks of a panel, and of a row of what fails."""

_TEXT: dict[str, Any] = {"fontsize": _POINTS, "color": INK, "parse_math": False}
_FAILING = "#F7E3D4"
"""Behind what fails: light, as the marks before it are not."""


def _page(height: float, title: str, message: list[str]) -> Figure:
    """Return a figure with a title and lines below it, and so much height for all else."""
    said = _lines("\n".join([title, "; ".join(message)]), _WIDTH - 1.0)
    high = height + _LINE * (1 + said.count("\n"))
    figure = Figure((_WIDTH, high), dpi=120, layout="constrained")
    figure.suptitle(said, **_TEXT)
    return figure


def _lines(text: str, inches: float) -> str:
    return broken(text, inches, _POINTS)


def _log_axes(axes: Axes, along: str, up: str) -> None:
    """Make axes logarithmic, with a grid and no upper and right line."""
    axes.set(xscale="log", yscale="log")
    axes.minorticks_off()
    axes.tick_params(colors=INK, labelsize=_POINTS)
    axes.grid(visible=True, color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_xlabel(along, loc="left" if "\n" in along else "center", **_TEXT)
    axes.set_ylabel(up, **_TEXT)


def _key(label: str, **style: Any) -> Line2D:
    """Return a handle of the legend: a mark if there is a marker, else a line."""
    style = {"color": INK, "markersize": 11, **style}
    return Line2D([], [], label=_lines(label, 5.5), **style)


def _draw_legend(figure: Figure, handles: Sequence[Artist]) -> None:
    draw_key(figure, handles, 5, loc="outside lower center", fontsize=_POINTS, labelcolor=INK)


def _interrupted(chart: Mapping[str, Any], what: str) -> list[str]:
    """Return the sentence that not everything has been measured, where that is so."""
    counts = chart.get("regions") or {"measured": 1, "of": 1}
    if counts["measured"] == counts["of"]:
        return []
    return [f"interrupted: {counts['measured']} of {counts['of']} {what}"]


class _Mark(NamedTuple):
    """A contender in one panel."""

    method: str
    dtype: str
    engine: str
    composing: str
    ns: float
    worst: float
    median: float
    fails: tuple[str, ...]

    @classmethod
    def of(cls, entry: Mapping[str, Any], kind: str, most: float) -> _Mark:
        """Return the mark of a contender for one kind of errors."""
        errors, eps = entry["errors"][kind], entry["eps"]
        # An error of nothing has no place on a logarithmic axis: it stands at a tenth of eps.
        worst = max(0.1, *(error["worst"] for error in errors.values()))
        median = max(0.1, float(np.median([error["median"] for error in errors.values()])))
        fails = tuple(name for name, error in errors.items() if not error["worst"] <= most)
        method, dtype, engine = entry["method"], entry["dtype"], entry["engine"]
        ns, composing = entry["ns"]["least"], entry["composing"]
        return cls(method, dtype, engine, composing, ns, worst * eps, median * eps, fails)


_SHAPES = {"float64": "o", "float32": "s", "longdouble": "D"}
_FACES: dict[str, dict[str, Any]] = {"numba": {}, "numpy": {"markerfacecolor": "white"}}
_HALF_FILLED = {"fillstyle": "left", "markerfacecoloralt": "white"}
_FILLED = {"numba": "filled", "numpy": "open"}
_SIZES = {"jones": 7.0}
"""Of marks in points; that of Stokes vectors is large."""

_LARGE = 12.0


def _colours_of(methods: Iterable[str]) -> dict[str, str]:
    return {m: LINES[place % len(LINES)] for place, m in enumerate(dict.fromkeys(methods))}


class _Frame:
    """What the panels of a chart share: limits, rows of what fails above the marks, and looks."""

    def __init__(self, chart: Mapping[str, Any], marks: Sequence[_Mark]) -> None:
        entries = chart["contenders"]
        self.colours = _colours_of(entry["method"] for entry in entries)
        self.dtypes = {entry["dtype"]: entry["eps"] for entry in entries}
        self.limits = chart["limits_ns"]
        self.failing = [*dict.fromkeys(mark.method for mark in marks if mark.fails)]
        held = [size for m in marks if not m.fails for size in (m.worst, m.median)]
        sizes = np.log10([*held, *self.dtypes.values()])
        self.low, self.high = float(sizes.min()) - 0.8, float(sizes.max()) + 0.8
        self.row = (self.high - self.low) * _ROW / _MAIN
        times = np.log10([*(mark.ns for mark in marks), *self.limits.values()])
        room = max(0.3, 0.05 * float(np.ptp(times)))
        self.times = 10.0 ** (times.min() - room), 10.0 ** (times.max() + room)

    def level(self, method: str) -> float:
        """Return the error at which the row of a method that fails is drawn."""
        return float(10.0 ** (self.high + self.row * (self.failing.index(method) + 0.5)))

    def draw_mark(self, axes: Axes, mark: _Mark, y: float) -> None:
        """Draw a mark at its time."""
        style: dict[str, Any] = _FACES.get(mark.engine, _HALF_FILLED)
        style = style | {"color": self.colours[mark.method], "marker": _SHAPES.get(mark.dtype, "^")}
        size = _SIZES.get(mark.composing, _LARGE)
        axes.plot(mark.ns, y, linestyle="none", markersize=size, markeredgewidth=1.8, **style)


def _draw_speed_and_accuracy(chart: Mapping[str, Any], peers: PeerTimes | None = None) -> Panel:
    """Draw what `path_chart` or `interface_chart` has measured."""
    marks = {
        kind: [_Mark.of(entry, kind, chart["fails_above"]) for entry in chart["contenders"]]
        for kind in _KINDS
    }
    frame = _Frame(chart, [mark for panel in marks.values() for mark in panel])
    notes = {kind: _failing_lines(chart, kind, result) for kind, result in marks.items()}
    legend = _legend(chart, frame)
    lines = max(note.count("\n") for note in notes.values())
    upper = _MAIN + _ROW * len(frame.failing) + _LINE * (5 + lines)
    lower = 4.2 if peers else 0.0
    height = upper + lower + _LINE * (3 + len(legend) / 3)
    figure = _page(height, f"Speed against accuracy: {chart['title']}", _effort(chart))
    rows = [upper, lower] if peers else [upper]
    grid = figure.add_gridspec(len(rows), 2, height_ratios=rows)
    axes = [figure.add_subplot(grid[0, place]) for place in (0, 1)]
    for panel, kind in zip(axes, _KINDS, strict=True):
        _log_axes(panel, f"time a path{notes[kind]}", "" if panel is axes[1] else "relative error")
        panel.set_title(_KINDS[kind], fontsize=_POINTS, color=INK, pad=8)
        _draw_panel(panel, marks[kind], frame, labelled=panel is axes[0])
    precisions: dict[float, list[str]] = {}
    for name, eps in frame.dtypes.items():
        precisions.setdefault(eps, []).append(name)
    names = axes[1].secondary_yaxis("right")
    names.set_yticks([*precisions], [", ".join(several) for several in precisions.values()])
    names.minorticks_off()
    names.tick_params(length=0.0, colors=INK, labelsize=_POINTS)
    names.spines["right"].set_visible(False)
    if peers:
        axes.append(figure.add_subplot(grid[1, :]))
    _draw_legend(figure, legend)
    if peers:
        _draw_peers(axes[-1], peers)
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


def _failing_lines(chart: Mapping[str, Any], kind: str, marks: list[_Mark]) -> str:
    """Return lines that tell where methods fail."""
    regions = dict.fromkeys(name for entry in chart["contenders"] for name in entry["errors"][kind])
    results: list[str] = []
    for method in dict.fromkeys(mark.method for mark in marks if mark.fails):
        own = [mark for mark in marks if mark.method == method]
        where = {name: [mark for mark in own if name in mark.fails] for name in regions}
        failing = [name for name, marked in where.items() if marked]
        if all(len(marked) == len(own) for marked in where.values()):
            said = ["everywhere"]
        elif len(regions) > len(failing) > len(regions) / 2:
            said = [name for name in regions if name not in failing]
            said[0] = f"all but: {said[0]}"
        else:
            said = [name + _precisions(where[name], own) for name in failing]
        results.append(f"• {method:.12}: {'; '.join(said)}")
    count = "1 region" if len(regions) == 1 else f"{len(regions)} regions"
    title = f"\n\nWhere methods fail, {kind}, of {count}:"
    return _lines("\n".join([title, *results]), _HALF) if results else ""


def _precisions(failing: list[_Mark], own: list[_Mark]) -> str:
    """Return the precisions that fail in a region, if others of the method hold there."""
    dtypes = {mark.dtype for mark in failing}
    if len(failing) == len(own):
        return ""
    if len(failing) == sum(mark.dtype in dtypes for mark in own):
        return f" ({', '.join(sorted(dtypes))})"
    return " (in part)"


def _legend(chart: Mapping[str, Any], frame: _Frame) -> list[Artist]:
    """Return what is explained."""
    dot: dict[str, Any] = {"marker": "o", "linewidth": 0}
    entries = chart["contenders"]
    ways = dict.fromkeys(entry["composing"] for entry in entries)
    keys: list[Artist] = [_key(name, color=c, lw=7) for name, c in frame.colours.items()]
    keys += [_key(name, linewidth=0, marker=_SHAPES.get(name, "^")) for name in frame.dtypes]
    for name in dict.fromkeys(entry["engine"] for entry in entries):
        style = dot | _FACES.get(name, _HALF_FILLED)
        keys.append(_key(f"{_FILLED.get(name, 'half')}: {name}", mew=1.8, **style))
    for name in ways if len(ways) > 1 else ():
        text = {"stokes": "large: Stokes", "jones": "small: Jones"}.get(name, f"large: {name}")
        keys.append(_key(text, **dot | {"markersize": _SIZES.get(name, _LARGE)}))
    keys += [_key("worst region", **dot), _key("middle region", **dot | {"marker": "_"}, mew=2)]
    keys.append(_key("frontier: best that fails nowhere", color=FAINT, lw=1.8))
    keys.append(_key("eps", color=FAINT, ls="--"))
    for (name, ns), dashes in zip(frame.limits.items(), DASHES[2:], strict=False):
        keys.append(_key(f"{name}: {duration(1e-9 * ns)}", color=FAINT, lw=1.6, ls=dashes))
    if frame.failing:
        label = f"fails (over {chart['fails_above']:g} ulp*) in so many regions"
        keys.append(Patch(facecolor=_FAILING, label=label))
        ulp = "units in the last place, divided by 1 + the condition number"
        keys.append(_key(ulp, **dot | {"marker": "$*$", "markersize": 9}))
    return keys


def _draw_panel(axes: Axes, marks: list[_Mark], frame: _Frame, *, labelled: bool) -> None:
    """Draw one kind of errors, with a row above for each method that fails in some region."""
    top = frame.high + frame.row * len(frame.failing)
    axes.set(xlim=frame.times, ylim=(10.0**frame.low, 10.0**top))
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    axes.axhspan(10.0**frame.high, 10.0**top, color=_FAILING, linewidth=0.0, zorder=0.6)
    for eps in frame.dtypes.values():
        axes.axhline(eps, color=FAINT, linewidth=1.0, linestyle="--", zorder=0.8)
    for ns, dashes in zip(frame.limits.values(), DASHES[2:], strict=False):
        axes.axvline(ns, color=FAINT, linewidth=1.6, linestyle=dashes, zorder=0.5)
    _draw_frontier(axes, [(mark.ns, mark.worst) for mark in marks if not mark.fails], frame)
    for mark in marks:
        if mark.fails:
            aside = frame.row * (-0.22 if mark.composing == "jones" else 0.12)
            frame.draw_mark(axes, mark, frame.level(mark.method) * 10.0**aside)
            continue
        colour = frame.colours[mark.method]
        axes.plot([mark.ns] * 2, [mark.median, mark.worst], color=colour, lw=0.9, alpha=0.6)
        axes.plot(mark.ns, mark.median, marker="_", color=colour, markersize=8)
        frame.draw_mark(axes, mark, mark.worst)
    powers = np.arange(np.ceil(frame.low), frame.high)[:: int(frame.high - frame.low) // 7 + 1]
    ticks = {10.0**power: f"$10^{{{power:.0f}}}$" if labelled else "" for power in powers}
    for method in frame.failing:
        counts = sorted({len(mark.fails) for mark in marks if mark.method == method})
        count = " to ".join(str(each) for each in dict.fromkeys((counts[0], counts[-1])))
        count = "nowhere" if counts == [0] else count
        ticks[frame.level(method)] = f"{method:.12}: {count}" if labelled else count
    axes.set_yticks([*ticks], [*ticks.values()])


def _draw_frontier(axes: Axes, points: list[tuple[float, float]], frame: _Frame) -> None:
    """Draw the best of all that fails nowhere."""
    best: list[tuple[float, float]] = []
    for x, y in sorted(points):
        if not best or y < best[-1][1]:
            best.append((x, y))
    if best:
        along = [(best[0][0], 10.0**frame.high), *best, (frame.times[1], best[-1][1])]
        axes.step(*np.transpose(along), where="post", color=FAINT, linewidth=1.8, zorder=0.9)


def _draw_peers(axes: Axes, peers: PeerTimes) -> None:
    """Draw error over time of all who took part in a race."""
    _log_axes(axes, "time a path", "largest error / S0")
    axes.margins(0.12, 0.3)
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    for racer in peers.racers:
        colour = LINES[0] if racer.is_own else FAINT
        axes.plot(racer.ns, racer.error, "o", color=colour, markersize=11)
    caption = (
        "Other software (grey) beside optipath (blue), in one race over random paths;\n"
        f"times x {peers.ratio:.3g}, which makes '{peers.shared}' as fast as above"
    )
    axes.set_title(caption, loc="left", fontsize=_POINTS, color=INK)
    figure: Any = axes.figure
    figure.draw_without_rendering()  # By which axes have the places of their layout.
    at = np.array([(racer.ns, racer.error) for racer in peers.racers])
    taken = [Bbox([pixel - 13.0, pixel + 13.0]) for pixel in axes.transData.transform(at)]
    labels = [
        Label(_lines(racer.name, 4.0), place, _TEXT)
        for racer, place in zip(peers.racers, at, strict=True)
    ]
    place_labels(axes, labels, [], axes.get_window_extent(), taken=taken)


_DASHES: dict[str, Any] = {"componentwise": "-", "normwise": (0, (3, 1.5))}
_LOST = 1.0
"""The relative error of a number of which no digit is right, at which larger ones are drawn."""


def _draw_critical(chart: Mapping[str, Any]) -> Panel:
    """Draw what `critical_chart` has measured, a panel a place."""
    places, eps, above = chart["places"], chart["eps"], chart["fails_above"]
    colours = _colours_of(name for place in places for name in place["errors"])
    columns = min(2, len(places))
    rows = -(-len(places) // columns)
    message = [
        f"the worst of {chart['samples']} samples at each distance, over its condition",
        f"{chart['dtype']}, NumPy, Stokes vectors",
        "at 1 no digit is right",
        *_interrupted(chart, "distances"),
    ]
    figure = _page(4.1 * rows + 1.2, f"Where methods fail: {chart['title']}", message)
    panel = figure.subplots(rows, columns, sharey=True, squeeze=False)
    for spare in panel.flat[len(places) :]:
        spare.remove()
    axes = panel.flat[: len(places)]
    for place, ax in zip(places, axes, strict=True):
        distances = place["distances"]
        words = _lines(f"distance from {place['called']} (rad)", 5.0)
        _log_axes(ax, words, "relative error" if ax in panel[:, 0] else "")
        ax.set(xlim=(min(distances) / 1.5, max(distances) * 1.5), ylim=(eps / 30, 30.0))
        ax.set_yticks(10.0 ** np.arange(0.0, np.log10(eps / 30), -4.0))
        ax.minorticks_off()
        ax.axhline(eps, color=FAINT, linewidth=1.2, linestyle="--")
        ax.axhline(above * eps, color=FAINT, linewidth=1.2, linestyle=":")
        for method, kinds in place["errors"].items():
            for kind, dashes in _DASHES.items():
                # An error of nothing has no place on a logarithmic axis.
                errors = np.clip(np.array(kinds[kind]) * eps, eps / 10, _LOST)
                style: dict[str, Any] = {"color": colours[method], "linestyle": dashes}
                ax.plot(distances, errors, linewidth=2.2, **style)
    keys: list[Artist] = [_key(name, color=colour, lw=7) for name, colour in colours.items()]
    keys += [
        _key("each component by itself", lw=2.2, ls=_DASHES["componentwise"]),
        _key("against the intensity", lw=2.2, ls=_DASHES["normwise"]),
        _key("fails above", lw=2.2, color=FAINT, ls=":"),
        _key("rounding, eps", lw=2.2, color=FAINT, ls="--"),
    ]
    _draw_legend(figure, keys)
    return np.array(axes, object)


_WHO = (("optipath", "best", LINES[0]), ("networkx and NumPy by hand", "by_hand", FAINT))


def throughput(rates: Sequence[Rates]) -> Panel:
    """Return a panel for each path, with two bars for each work."""
    panels = {path: [*several][::-1] for path, several in groupby(rates, lambda each: each.path)}
    heights = [len(several) for several in panels.values()]
    figure = Figure((10.0, 1.2 + 0.45 * sum(heights) + 0.4 * len(heights)), layout="constrained")
    axes = figure.subplots(len(panels), sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    for ax, (path, several) in zip(axes, panels.items(), strict=True):
        for place, (label, field, color) in enumerate(_WHO):
            numbers = [getattr(each, field) or np.nan for each in several]
            at = np.arange(len(several)) + 0.2 - 0.4 * place
            bars = ax.barh(at, numbers, 0.4, color=color, label=label)
            texts = ["" if np.isnan(number) else rate(number) for number in numbers]
            ax.bar_label(bars, texts, padding=3, color=INK)
        ax.set_yticks(range(len(several)), [each.work for each in several])
        ax.set_title(path, loc="left", color=INK)
        ax.set_xscale("log")
        ax.spines[["top", "right"]].set_visible(False)
        ax.tick_params(colors=INK)
    axes[-1].set_xlabel("a second, at best", color=INK)
    axes[-1].margins(x=0.1)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return np.array(axes, object)
