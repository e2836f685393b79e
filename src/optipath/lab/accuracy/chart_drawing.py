"""The chart of speed against accuracy, as a picture."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import MissingExtraError
from optipath.lab.bench.timing import duration
from optipath.values.picture_files import write_picture

try:
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.transforms import Bbox
except ImportError:
    raise MissingExtraError("charts", "matplotlib", "chart") from None

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from matplotlib.axes import Axes

_PANELS = {
    "componentwise": "each component by itself, over its condition",
    "normwise": "against the intensity, over its condition",
}
_COLOURS = {"numpy": "#1f6fb4", "numba": "#d9730d", "jax": "#3a8f3a"}
_SHAPES = {"float64": "o", "float32": "s", "longdouble": "D"}
_SIDES = [(x, y, side) for y in (4, -11, 14) for x, side in ((6, "left"), (-6, "right"))]
_INK, _FAINT, _RED = "#333333", "#8a8a8a", "#c0392b"
_SMALL: dict[str, Any] = {"fontsize": 7.5, "color": _FAINT}


class _Mark(NamedTuple):
    """A contender in one panel: how it is called and drawn, its time, and its errors."""

    name: str
    colour: str
    shape: str
    ns: float
    worst: float
    median: float
    fails: int


def draw(chart: Mapping[str, Any], out: Path) -> None:
    """Draw a chart into a file; its ending says in which form.

    Parameters
    ----------
    chart : mapping
        What `path_chart` or `interface_chart` has measured, or its JSON read back.
    out : Path
        Such as ``chart.png`` or ``chart.svg``.

    Raises
    ------
    OSError
        If it cannot be written; what was there before stays.
    """
    with warnings.catch_warnings():
        # A title may have letters that the font lacks; they are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph")
        write_picture(_figure(chart), out)


def _figure(chart: Mapping[str, Any]) -> Figure:
    figure = Figure(figsize=(13.5, 8.0), dpi=120, layout="constrained")
    # A dollar would begin a formula.
    title = f"Speed against accuracy: {chart['title']}".replace("$", r"\$")
    figure.suptitle(title, fontsize=14, color=_INK)
    panels = figure.subplots(1, 2, sharex=True)
    held = [_panel(axes, chart, kind) for axes, kind in zip(panels, _PANELS, strict=True)]
    panels[0].set_ylabel("relative error: worst region (marker), median (dash)", color=_INK)
    handles = _legend(chart)
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), frameon=False)
    figure.draw_without_rendering()
    for axes, marks in zip(panels, held, strict=True):
        _label_markers(axes, marks)
    return figure


def _panel(axes: Axes, chart: Mapping[str, Any], kind: str) -> list[_Mark]:
    """Draw a panel, and return the marks of what fails nowhere, which are still to be named."""
    axes.set(xscale="log", yscale="log")
    contenders = chart["contenders"]
    marks = [_mark(contender, kind, chart["fails_above"]) for contender in contenders]
    held = [mark for mark in marks if not mark.fails]
    for mark in held:
        axes.plot([mark.ns] * 2, [mark.median, mark.worst], color=mark.colour, lw=0.8, alpha=0.6)
        axes.plot(mark.ns, mark.median, marker="_", color=mark.colour, markersize=7)
        axes.plot(mark.ns, mark.worst, marker=mark.shape, color=mark.colour, markersize=7)
    _frontier(axes, [(mark.ns, mark.worst) for mark in held])
    sizes = [mark.worst for mark in held] + [contender["eps"] for contender in contenders]
    low, base = min(sizes) / 30, max(sizes) * 30
    times = [mark.ns for mark in marks]
    axes.set_xlim(min([*times, *chart["limits_ns"].values()]) / 5, max(times) * 8)
    regions = max(len(contender["errors"][kind]) for contender in contenders)
    _failing_band(axes, [mark for mark in marks if mark.fails], regions, low, base)
    _limits(axes, chart, low, base)
    axes.grid(visible=True, which="major", color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.set_title(_PANELS[kind], fontsize=10.5, color=_INK)
    axes.set_xlabel("time a path", color=_INK)
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    axes.tick_params(colors=_INK, which="both")
    axes.spines[["top", "right"]].set_visible(False)
    return held


def _mark(contender: Mapping[str, Any], kind: str, most: float) -> _Mark:
    errors, eps = contender["errors"][kind].values(), contender["eps"]
    # An error of nothing has no place on a logarithmic axis: it stands at a tenth of eps.
    return _Mark(
        name=contender["method"] + " · jones" * (contender["composing"] == "jones"),
        colour=_COLOURS.get(contender["engine"], _INK),
        shape=_SHAPES.get(contender["dtype"], "^"),
        ns=contender["ns"]["least"],
        worst=max(0.1, *(error["worst"] for error in errors)) * eps,
        median=max(float(np.median([error["median"] for error in errors])), 0.1) * eps,
        fails=sum(not error["worst"] <= most for error in errors),
    )


def _label_markers(axes: Axes, marks: list[_Mark]) -> None:
    """Name each marker, on the first side of it where nothing stands yet."""
    # From above, so that of two that stand close the upper one is named above.
    marks = sorted(marks, key=lambda mark: -mark.worst)
    points = [(mark.ns, mark.worst) for mark in marks]
    taken = [Bbox.from_bounds(x - 5, y - 5, 10, 10) for x, y in axes.transData.transform(points)]
    words: dict[str, Any] = {"textcoords": "offset points", "fontsize": 8, "color": _INK}
    for mark, point in zip(marks, points, strict=True):
        for x, y, side in _SIDES:
            label = axes.annotate(mark.name, point, xytext=(x, y), ha=side, **words)
            box = label.get_window_extent()
            if not box.count_overlaps(taken) or (x, y, side) == _SIDES[-1]:
                taken.append(box)
                break
            label.remove()


def _frontier(axes: Axes, points: list[tuple[float, float]]) -> None:
    best: list[tuple[float, float]] = []
    for x, y in sorted(points):
        if not best or y < best[-1][1]:
            best.append((x, y))
    if best:
        axes.step(*zip(*best, strict=True), where="post", color=_FAINT, linewidth=1.2, zorder=0)


def _limits(axes: Axes, chart: Mapping[str, Any], low: float, high: float) -> None:
    """Draw what this machine needs at least, and the rounding of each precision."""
    for name, ns in chart["limits_ns"].items():
        axes.vlines(ns, low, high, color=_FAINT, linewidth=1, linestyle=":")
        words = f" this machine's limit: {name}"
        axes.text(ns, low, words, rotation=90, va="bottom", ha="right", **_SMALL)
    for dtype, eps in {c["dtype"]: c["eps"] for c in chart["contenders"]}.items():
        axes.axhline(eps, color=_FAINT, linewidth=0.9, linestyle="--")
        beside = axes.get_yaxis_transform()
        axes.text(1.005, eps, f"eps of\n{dtype}", transform=beside, va="center", **_SMALL)


def _failing_band(axes: Axes, failing: list[_Mark], regions: int, low: float, base: float) -> None:
    """Draw what fails in some region above everything: a row a method, hollow, counted."""
    rows: dict[str, list[_Mark]] = {}
    for mark in failing:
        rows.setdefault(mark.name, []).append(mark)
    step = 15.0
    top = base * step ** (len(rows) + 0.6)
    axes.set_ylim(low, top)
    axes.set_yticks([tick for tick in axes.get_yticks() if low <= tick < base])
    axes.minorticks_off()
    if not rows:
        return
    axes.axhspan(base, top, color=_RED, alpha=0.09, linewidth=0)
    left = axes.get_xlim()[0]
    for number, (name, marks) in enumerate(rows.items()):
        y = base * step ** (number + 0.7)
        counts = sorted({mark.fails for mark in marks})
        many = f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else f"{counts[0]}"
        words = f" {name}: fails in {many} of {regions}"
        axes.text(left, y, words, va="center", fontsize=8, color=_RED)
        for mark in marks:
            axes.plot(mark.ns, y, mark.shape, color=mark.colour, mfc="white", markersize=7)


def _legend(chart: Mapping[str, Any]) -> list[Line2D]:
    engines = dict.fromkeys(c["engine"] for c in chart["contenders"])
    dtypes = dict.fromkeys(c["dtype"] for c in chart["contenders"])
    fails = f"off by more than {chart['fails_above']:g} ulp in some region"
    marker: dict[str, Any] = {"color": _INK, "linewidth": 0}
    return [
        *(Line2D([], [], color=_COLOURS.get(e, _INK), linewidth=4, label=e) for e in engines),
        *(Line2D([], [], marker=_SHAPES.get(d, "^"), label=d, **marker) for d in dtypes),
        Line2D([], [], marker="o", markerfacecolor="white", label=fails, **marker),
        Line2D([], [], color=_FAINT, label="the best of what fails nowhere"),
    ]
