"""One panel of a chart: error over time, what fails above, the limits of the machine below."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.patches import Rectangle

from optipath.lab.bench.timing import duration
from optipath.plots.charts.chart_frame import LINE, ROW, panel_width
from optipath.plots.charts.chart_marks import POINTS
from optipath.plots.line_colours import FAINT, INK
from optipath.plots.text_width import shortened, width_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

    from optipath.plots.charts.chart_frame import ChartFrame
    from optipath.plots.charts.chart_marks import Looks, Mark

FAILING = "#F7E3D4"
"""Behind what fails: light, as the marks before it are not."""

_WORDS: dict[str, Any] = {"fontsize": POINTS, "color": INK, "parse_math": False}
_ON_WHITE: dict[str, Any] = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}


def draw_panel(
    axes: Axes, chart: Mapping[str, Any], marks: list[Mark], frame: ChartFrame, looks: Looks
) -> None:
    """Draw one kind of errors."""
    axes.set(xscale="log", yscale="log", xlim=frame.times, ylim=frame.seen)
    axes.set_yticks(frame.decades)
    axes.set_xticks(frame.ticks)
    axes.minorticks_off()
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    axes.tick_params(colors=INK, labelsize=POINTS)
    axes.grid(visible=True, color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    held = [mark for mark in marks if not mark.fails]
    for mark in held:
        colour = looks.colour(mark.method)
        axes.plot([mark.ns] * 2, [mark.median, mark.worst], color=colour, lw=0.9, alpha=0.6)
        axes.plot(mark.ns, mark.median, marker="_", color=colour, markersize=8)
        looks.draw(axes, mark, mark.worst)
    base = frame.share(frame.height - frame.band)
    _limits(axes, chart["limits_ns"], frame, base)
    _roundings(axes, chart, frame)
    _frontier(axes, [(mark.ns, mark.worst) for mark in held], base)
    _failing(axes, marks, frame, looks, base)


def name_rows(axes: Axes, frame: ChartFrame) -> None:
    """Write the methods that fail to the left of their rows."""
    base = frame.height - frame.band
    for number, method in enumerate(frame.methods):
        y = frame.share(base + ROW * (number + 0.5))
        name = shortened(method, 1.4, POINTS)
        axes.text(-0.02, y, name, transform=axes.transAxes, va="center", ha="right", **_WORDS)


def _failing(axes: Axes, marks: list[Mark], frame: ChartFrame, looks: Looks, base: float) -> None:
    """Draw what fails in some region, a row a method, with how many regions that are."""
    if not frame.methods:
        return
    band = Rectangle((0, base), 1, 1 - base, transform=axes.transAxes, zorder=0.6)
    band.set(facecolor=FAILING, edgecolor="none")
    axes.add_patch(band)
    across, left = axes.get_xaxis_transform(), axes.transAxes
    for number, method in enumerate(frame.methods):
        y = base + frame.share(ROW * (number + 0.5))
        row = [mark for mark in marks if mark.method == method and mark.fails]
        axes.text(0.015, y, _counted(marks, method), transform=left, va="center", **_WORDS)
        for mark in row:
            aside = -0.08 if mark.composing == "jones" else 0.06
            looks.draw(axes, mark, y + frame.share(aside), transform=across)


def _counted(marks: list[Mark], method: str) -> str:
    counts = sorted({len(mark.fails) for mark in marks if mark.method == method})
    if counts == [0]:
        return "nowhere"
    return f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else f"{counts[0]}"


def _frontier(axes: Axes, points: list[tuple[float, float]], base: float) -> None:
    """Draw the best of all that fails nowhere, and name it where it begins."""
    best: list[tuple[float, float]] = []
    for x, y in sorted(points):
        if not best or y < best[-1][1]:
            best.append((x, y))
    if not best:
        return
    _, top = axes.get_ylim()
    along = [*best, (axes.get_xlim()[1], best[-1][1])]
    axes.step(*zip(*along, strict=True), where="post", color=FAINT, linewidth=1.8, zorder=0.9)
    axes.plot([best[0][0]] * 2, [best[0][1], top], color=FAINT, linewidth=1.8, zorder=0.5)
    axes.annotate(
        "frontier",
        (best[0][0], base),
        xycoords=axes.get_xaxis_transform(),
        xytext=(-5, -5),
        textcoords="offset points",
        ha="right",
        va="top",
        bbox=_ON_WHITE,
        **_WORDS,
    )


def _roundings(axes: Axes, chart: Mapping[str, Any], frame: ChartFrame) -> None:
    """Draw eps of each precision, with its name above the line, or above those below it."""
    found = {entry["dtype"]: entry["eps"] for entry in chart["contenders"]}
    reached = frame.floor
    for dtype, eps in sorted(found.items(), key=lambda each: each[1]):
        axes.axhline(eps, color=FAINT, linewidth=1.0, linestyle="--", zorder=0.8)
        at = max(frame.inches(eps) + 0.03, reached)
        reached = at + LINE
        axes.text(
            0.015,
            frame.share(at),
            shortened(dtype, 1.35, POINTS),
            transform=axes.transAxes,
            va="bottom",
            bbox=_ON_WHITE,
            **_WORDS,
        )


def _limits(axes: Axes, limits: Mapping[str, float], frame: ChartFrame, base: float) -> None:
    """Draw what this machine needs at least; each line begins above the names of those before."""
    across = axes.get_xaxis_transform()
    for row, (name, ns) in enumerate(sorted(limits.items(), key=lambda each: each[1])):
        y = frame.share(LINE * row + 0.03)
        axes.plot([ns, ns], [y, base], color=FAINT, lw=1.6, linestyle=":", transform=across)
        begin = float(axes.transAxes.inverted().transform(axes.transData.transform((ns, 1)))[0])
        before, behind = begin * panel_width() - 0.1, (1 - begin) * panel_width() - 0.1
        words = f"{name}: {duration(1e-9 * ns)}"
        right = width_of(words, POINTS) * 1.05 <= behind or behind >= before
        axes.annotate(
            shortened(words, behind if right else before, POINTS),
            (ns, y),
            xycoords=across,
            xytext=(4 if right else -4, 0),
            textcoords="offset points",
            ha="left" if right else "right",
            va="bottom",
            bbox=_ON_WHITE,
            **_WORDS,
        )
