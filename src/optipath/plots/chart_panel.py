"""Panels of a chart of speed against accuracy: marks, how they look, and the room around them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.patches import Rectangle

from optipath.lab.bench import duration
from optipath.plots.colors import FAINT, INK, LINES
from optipath.plots.text import shortened, width_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes


POINTS = 14.0
"""Of texts; pictures of this size are shown at half of it in pages."""

WIDTH = 13.0
"""Of a picture, in inches; as heights below."""

LEFT, GAP, RIGHT = 1.75, 0.35, 0.2
PANEL = (WIDTH - LEFT - GAP - RIGHT) / 2
"""How wide each of the two panels is."""

LINE, _ROW, _STRIP, _MAIN = 0.28, 0.34, 0.36, 2.9
_SHIFT = 0.31
"""The share of the width, on the left, where words stand and no marks."""

FAILING = "#F7E3D4"
"""Behind what fails: light, as the marks before it are not."""

WORDS: dict[str, Any] = {"fontsize": POINTS, "color": INK, "parse_math": False}
_ON_WHITE: dict[str, Any] = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}


def plain_axes(axes: Axes, **settings: Any) -> None:
    """Draw logarithmic axes with a grid, ticks at powers of ten and no upper and right line."""
    axes.set(xscale="log", yscale="log", **settings)
    axes.minorticks_off()
    axes.tick_params(colors=INK, labelsize=POINTS)
    axes.grid(visible=True, color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)


def powers_of_ten(low: float, high: float, most: int) -> Sequence[float]:
    """Return at most so many powers of ten between two numbers.

    >>> powers_of_ten(0.5, 2e3, 2)
    [1.0, 1000.0]
    """
    powers = np.arange(np.ceil(np.log10(low)), np.floor(np.log10(high)) + 1)
    return [float(10.0**power) for power in powers[:: len(powers) // most + 1]]


class Mark(NamedTuple):
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
    def of(cls, entry: Mapping[str, Any], kind: str, most: float) -> Mark:
        """Return the mark of a contender for one kind of errors."""
        errors, eps = entry["errors"][kind], entry["eps"]
        median = np.median([error["median"] for error in errors.values()])
        return cls(
            entry["method"],
            entry["dtype"],
            entry["engine"],
            entry["composing"],
            entry["ns"]["least"],
            # An error of nothing has no place on a logarithmic axis: it stands at a tenth of eps.
            max(0.1, *(error["worst"] for error in errors.values())) * eps,
            max(0.1, float(median)) * eps,
            tuple(name for name, error in errors.items() if not error["worst"] <= most),
        )


_SHAPES = {"float64": "o", "float32": "s", "longdouble": "D"}
_FACES: dict[str, dict[str, Any]] = {"numba": {}, "numpy": {"markerfacecolor": "white"}}
_HALF = {"fillstyle": "left", "markerfacecoloralt": "white"}


class Looks:
    """How the marks of a chart look."""

    def __init__(self, chart: Mapping[str, Any]) -> None:
        methods, dtypes, engines, self.ways = (
            dict.fromkeys(entry[word] for entry in chart["contenders"])
            for word in ("method", "dtype", "engine", "composing")
        )
        self.colours = colours_of(methods)
        self.shapes = {dtype: _SHAPES.get(dtype, "^") for dtype in dtypes}
        self.faces = {engine: _FACES.get(engine, _HALF) for engine in engines}

    def size(self, composing: str) -> float:
        """Return the size of a mark in points: that of Stokes vectors is large."""
        return 7.0 if composing == "jones" else 12.0

    def draw(self, axes: Axes, mark: Mark, y: float, **keywords: Any) -> None:
        """Draw a mark."""
        keywords |= {"markersize": self.size(mark.composing), "markeredgewidth": 1.8}
        keywords |= {"color": self.colours[mark.method], "marker": self.shapes[mark.dtype]}
        axes.plot(mark.ns, y, linestyle="none", **keywords, **self.faces[mark.engine])


def colours_of(methods: Mapping[str, Any]) -> dict[str, str]:
    """Return the color of each method."""
    return {method: LINES[place % len(LINES)] for place, method in enumerate(methods)}


class ChartFrame(NamedTuple):
    """The room of a panel from below: names of limits, marks, the frontier's name, what fails."""

    times: tuple[float, float]
    errors: tuple[float, float]
    methods: tuple[str, ...]
    limits: int

    @classmethod
    def around(cls, chart: Mapping[str, Any], marks: Sequence[Mark]) -> ChartFrame:
        """Return the frame of all panels of a chart."""
        held = [mark for mark in marks if not mark.fails]
        sizes = [size for mark in held for size in (mark.worst, mark.median)]
        sizes += [entry["eps"] for entry in chart["contenders"]]
        limits = [*chart["limits_ns"].values()]
        times = [mark.ns for mark in marks]
        first, last = np.log10(min(times)), np.log10(max(times) * 1.7)
        width = max(last - first, 1.0) / (1.0 - _SHIFT)
        begin = min([last - width, *(np.log10(ns / 1.3) for ns in limits)])
        end = max([last, *(np.log10(ns * 1.3) for ns in limits)])
        return cls(
            (float(10.0**begin), float(10.0**end)),
            (min(sizes) / 6, max(sizes) * 6),
            tuple(dict.fromkeys(mark.method for mark in marks if mark.fails)),
            len(limits),
        )

    @property
    def height(self) -> float:
        """How high a panel is."""
        return self.floor + _MAIN + _STRIP + _ROW * len(self.methods)

    @property
    def floor(self) -> float:
        """How high the names of the limits reach."""
        return LINE * self.limits + 0.1

    @property
    def base(self) -> float:
        """Where what fails begins, as a share of the height."""
        return 1.0 - _ROW * len(self.methods) / self.height

    def row(self, number: int) -> float:
        """Return where the middle of a row of what fails is, as a share of the height."""
        return self.base + _ROW * (number + 0.5) / self.height

    @property
    def seen(self) -> tuple[float, float]:
        """The limits of the axis of errors, with the room below and above the marks."""
        low, high = np.log10(self.errors)
        inch = (high - low) / _MAIN
        above = self.height - self.floor - _MAIN
        return float(10.0 ** (low - inch * self.floor)), float(10.0 ** (high + inch * above))

    @property
    def middle(self) -> float:
        """Where the middle of the marks is, as a share of the height."""
        return (self.floor + _MAIN / 2) / self.height

    def inches(self, error: float) -> float:
        """Return how high an error stands in a panel."""
        low, high = np.log10(self.errors)
        return self.floor + float((np.log10(error) - low) / (high - low)) * _MAIN


def draw_panel(
    axes: Axes, chart: Mapping[str, Any], marks: list[Mark], frame: ChartFrame, looks: Looks
) -> None:
    """Draw one kind of errors."""
    plain_axes(axes, xlim=frame.times, ylim=frame.seen)
    first, last = frame.times
    edge = (last / first) ** (0.25 / PANEL)
    axes.set_xticks(powers_of_ten(first * edge, last / edge, 5))
    axes.set_yticks(powers_of_ten(*frame.errors, 7))
    axes.minorticks_off()
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    held = [mark for mark in marks if not mark.fails]
    for mark in held:
        colour = looks.colours[mark.method]
        axes.plot([mark.ns] * 2, [mark.median, mark.worst], color=colour, lw=0.9, alpha=0.6)
        axes.plot(mark.ns, mark.median, marker="_", color=colour, markersize=8)
        looks.draw(axes, mark, mark.worst)
    _draw_limits(axes, chart["limits_ns"], frame)
    _draw_roundings(axes, chart, frame)
    _draw_frontier(axes, [(mark.ns, mark.worst) for mark in held], frame.base)
    _draw_failing(axes, marks, frame, looks)


def name_rows(axes: Axes, frame: ChartFrame) -> None:
    """Write the methods that fail to the left of their rows."""
    style: dict[str, Any] = {"transform": axes.transAxes, "va": "center", "ha": "right", **WORDS}
    for number, method in enumerate(frame.methods):
        axes.text(-0.02, frame.row(number), shortened(method, 1.4, POINTS), **style)


def _draw_failing(axes: Axes, marks: list[Mark], frame: ChartFrame, looks: Looks) -> None:
    """Draw what fails in some region, a row a method, with how many regions that are."""
    band = Rectangle((0, frame.base), 1, 1 - frame.base, transform=axes.transAxes, zorder=0.6)
    band.set(facecolor=FAILING, edgecolor="none")
    axes.add_patch(band)
    for number, method in enumerate(frame.methods):
        y = frame.row(number)
        own = [mark for mark in marks if mark.method == method]
        counts = sorted({len(mark.fails) for mark in own})
        words = " to ".join(str(count) for count in dict.fromkeys((counts[0], counts[-1])))
        words = "nowhere" if counts == [0] else words
        axes.text(0.015, y, words, transform=axes.transAxes, va="center", **WORDS)
        for mark in own:
            if mark.fails:
                aside = (-0.08 if mark.composing == "jones" else 0.06) / frame.height
                looks.draw(axes, mark, y + aside, transform=axes.get_xaxis_transform())


def _draw_frontier(axes: Axes, points: list[tuple[float, float]], base: float) -> None:
    """Draw the best of all that fails nowhere, and name it where it begins."""
    best: list[tuple[float, float]] = []
    for x, y in sorted(points):
        if not best or y < best[-1][1]:
            best.append((x, y))
    if not best:
        return
    along = [*best, (axes.get_xlim()[1], best[-1][1])]
    axes.step(*zip(*along, strict=True), where="post", color=FAINT, linewidth=1.8, zorder=0.9)
    up = [best[0][1], axes.get_ylim()[1]]
    axes.plot([best[0][0]] * 2, up, color=FAINT, linewidth=1.8, zorder=0.5)
    _name_line(axes, "frontier", (best[0][0], base), (-5, -5), ha="right", va="top")


def _draw_roundings(axes: Axes, chart: Mapping[str, Any], frame: ChartFrame) -> None:
    """Draw eps of each precision, with its name above the line, or above those below it."""
    results = {entry["dtype"]: entry["eps"] for entry in chart["contenders"]}
    reached = frame.floor
    for dtype, eps in sorted(results.items(), key=lambda each: each[1]):
        axes.axhline(eps, color=FAINT, linewidth=1.0, linestyle="--", zorder=0.8)
        at = max(frame.inches(eps) + 0.03, reached)
        reached = at + LINE
        style: dict[str, Any] = {"transform": axes.transAxes, "va": "bottom", "bbox": _ON_WHITE}
        axes.text(0.015, at / frame.height, shortened(dtype, 1.35, POINTS), **style, **WORDS)


def _draw_limits(axes: Axes, limits: Mapping[str, float], frame: ChartFrame) -> None:
    """Draw what this machine needs at least; each line begins above the names of those before."""
    across = axes.get_xaxis_transform()
    first, last = np.log10(frame.times)
    for row, (name, ns) in enumerate(sorted(limits.items(), key=lambda each: each[1])):
        y = (LINE * row + 0.03) / frame.height
        axes.plot([ns, ns], [y, frame.base], color=FAINT, lw=1.6, linestyle=":", transform=across)
        before = float(np.log10(ns) - first) / (last - first) * PANEL - 0.1
        behind = PANEL - before - 0.2
        words = f"{name}: {duration(1e-9 * ns)}"
        right = width_of(words, POINTS) * 1.05 <= behind or behind >= before
        words = shortened(words, behind if right else before, POINTS)
        side = (4, 0) if right else (-4, 0)
        _name_line(axes, words, (ns, y), side, ha="left" if right else "right", va="bottom")


def _name_line(
    axes: Axes, words: str, at: tuple[float, float], apart: tuple[float, float], **place: Any
) -> None:
    """Write words some points beside a time and a share of the height."""
    place |= {"xycoords": axes.get_xaxis_transform(), "textcoords": "offset points"}
    axes.annotate(words, at, xytext=apart, bbox=_ON_WHITE, **place, **WORDS)
