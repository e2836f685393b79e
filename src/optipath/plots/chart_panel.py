"""Panels of a chart: frame, marks and legend."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from optipath.lab.bench import duration
from optipath.plots.colors import FAINT, INK, LINES
from optipath.plots.text import broken, shortened, width_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


WIDTH = 13.0
"""Of a picture, in inches; as heights below."""

LEFT, GAP, RIGHT = 1.75, 0.35, 0.2
ROW = 0.34
LINE = 0.28

_STRIP, _MAIN = 0.36, 2.9
_SHIFT = 0.31
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
    width = max(last - first, 1.0) / (1.0 - _SHIFT)
    begin = min([last - width, *(np.log10(ns / 1.3) for ns in limits)])
    end = max([last, *(np.log10(ns * 1.3) for ns in limits)])
    return float(10.0**begin), float(10.0**end)


def panel_width() -> float:
    """Return how wide each of the two panels is."""
    return (WIDTH - LEFT - GAP - RIGHT) / 2


EDGE = 0.25
"""Between words and the edge of a picture, in inches."""

_HANDLE = 0.6
_ULP = "units in the last place, divided by 1 + the condition number"
_WAYS = {"stokes": "large: Stokes", "jones": "small: Jones"}
_FACE_WORDS = {"numba": "filled: ", "numpy": "open: "}


def legend_rows(chart: Mapping[str, Any], looks: Looks, *, fails: bool) -> list[list[Artist]]:
    """Return what is explained, in rows that fit the width of a picture."""
    groups = _groups(looks)
    if fails:
        label = f"fails (over {chart['fails_above']:g} ulp*) in so many regions"
        groups[-1].insert(0, Patch(facecolor=FAILING, label=label))
        star = Line2D([], [], linewidth=0, marker="$*$", markersize=9, color=INK, label=_ULP)
        groups.append([star])
    return flowing(groups)


def flowing(groups: list[list[Artist]]) -> list[list[Artist]]:
    """Return groups of what is explained in rows that fit the width of a picture."""
    rows: list[list[Artist]] = []
    for group in groups:
        reached = WIDTH
        for handle in group:
            needed = _HANDLE + 1.03 * width_of(str(handle.get_label()), POINTS)
            if reached + needed > WIDTH - 2 * EDGE:
                rows.append([])
                reached = 0.0
            rows[-1].append(handle)
            reached += needed
    return rows


def _groups(looks: Looks) -> list[list[Artist]]:
    marker: dict[str, Any] = {"color": INK, "linewidth": 0, "markersize": 11}
    methods: list[Artist] = [
        Line2D([], [], color=looks.colour(name), lw=7, label=_short(name)) for name in looks.methods
    ]
    shapes = [
        Line2D([], [], marker=looks.shape(name), label=_short(name), **marker)
        for name in looks.dtypes
    ]
    faces = [
        Line2D([], [], marker="o", label=_FACE_WORDS.get(name, "half: ") + _short(name))
        for name in looks.engines
    ]
    for line, name in zip(faces, looks.engines, strict=True):
        line.set(**marker, mew=1.8)
        line.set(**looks.face(name))
    sizes = [
        Line2D([], [], marker="o", label=_WAYS.get(name, f"large: {_short(name)}"))
        for name in looks.ways
    ]
    for line, name in zip(sizes, looks.ways, strict=True):
        line.set(**(marker | {"markersize": looks.size(name)}))
    ways = sizes if len(sizes) > 1 else []
    return [
        [*methods, *shapes],
        [
            *faces,
            *ways,
            Line2D([], [], marker="o", label="worst region", **marker),
            Line2D([], [], marker="_", label="middle region", **(marker | {"mew": 2})),
        ],
        [
            Line2D([], [], color=FAINT, lw=1.8, label="frontier: best that fails nowhere"),
            Line2D([], [], color=FAINT, ls="--", label="eps"),
            Line2D([], [], color=FAINT, lw=1.6, ls=":", label="machine's limit"),
        ],
    ]


def _short(name: str) -> str:
    return shortened(name, 3.0, POINTS)


def draw_legend(figure: Figure, rows: list[list[Artist]], top: float) -> None:
    """Draw rows of what is explained."""
    height = figure.get_figheight()
    for number, row in enumerate(rows):
        figure.legend(
            handles=row,
            ncols=len(row),
            loc="upper left",
            bbox_to_anchor=(EDGE / WIDTH, (top - LINE * 1.15 * number) / height),
            borderaxespad=0.0,
            borderpad=0.0,
            frameon=False,
            fontsize=POINTS,
            labelcolor=INK,
            handlelength=1.3,
            handletextpad=0.5,
            columnspacing=1.1,
        )


def failing_lines(marks: list[Mark], regions: list[str], inches: float) -> list[tuple[str, str]]:
    """Return in which regions methods fail."""
    results = []
    for method in dict.fromkeys(mark.method for mark in marks if mark.fails):
        own = [mark for mark in marks if mark.method == method]
        where = {name: [mark for mark in own if name in mark.fails] for name in regions}
        failing = [name for name, marked in where.items() if marked]
        begin = f"{shortened(method, 1.6, POINTS)}:"
        if all(len(marked) == len(own) for marked in where.values()):
            words = [begin, "everywhere"]
        elif len(regions) > len(failing) > len(regions) / 2:
            holds = [name for name, marked in where.items() if not marked]
            words = [begin, "all but:", *_listed(holds)]
        else:
            words = [begin, *_listed([_failing_text(name, where[name], own) for name in failing])]
        results += [
            (method if number == 0 else "", line)
            for number, line in enumerate(broken(words, inches, POINTS))
        ]
    return results


def _failing_text(region: str, failing: list[Mark], own: list[Mark]) -> str:
    """Return a region, with the precisions that fail there if others hold."""
    dtypes = {mark.dtype for mark in failing}
    if len(failing) == len(own):
        return region
    if len(failing) == sum(mark.dtype in dtypes for mark in own):
        return f"{region} ({', '.join(sorted(dtypes))})"
    return f"{region} (in part)"


def _listed(names: list[str]) -> list[str]:
    return [*(f"{name};" for name in names[:-1]), names[-1]]


POINTS = 14.0
"""Of texts; pictures of this size are shown at half of it in pages."""

_SHAPES = {"float64": "o", "float32": "s", "longdouble": "D"}
_OTHER_SHAPES = ("^", "v", "p", "h")
_FACES = {"numba": "full", "numpy": "none"}
_LARGE, _SMALL = 12.0, 7.0


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


def marks_of(chart: Mapping[str, Any], kind: str) -> list[Mark]:
    """Return the marks of one kind of errors."""
    return [_mark(entry, kind, chart["fails_above"]) for entry in chart["contenders"]]


def _mark(entry: Mapping[str, Any], kind: str, most: float) -> Mark:
    errors, eps = entry["errors"][kind], entry["eps"]
    middle = float(np.median([error["median"] for error in errors.values()]))
    return Mark(
        method=entry["method"],
        dtype=entry["dtype"],
        engine=entry["engine"],
        composing=entry["composing"],
        ns=entry["ns"]["least"],
        # An error of nothing has no place on a logarithmic axis: it stands at a tenth of eps.
        worst=max(0.1, *(error["worst"] for error in errors.values())) * eps,
        median=max(middle, 0.1) * eps,
        fails=tuple(name for name, error in errors.items() if not error["worst"] <= most),
    )


class Looks:
    """How the marks of a chart look."""

    def __init__(self, chart: Mapping[str, Any]) -> None:
        def named(word: str) -> list[str]:
            return list(dict.fromkeys(entry[word] for entry in chart["contenders"]))

        self.methods, self.dtypes = named("method"), named("dtype")
        self.engines, self.ways = named("engine"), named("composing")
        others = [dtype for dtype in self.dtypes if dtype not in _SHAPES]
        self._others = {
            dtype: _OTHER_SHAPES[place % len(_OTHER_SHAPES)] for place, dtype in enumerate(others)
        }

    def colour(self, method: str) -> str:
        """Return the colour of a method; black for more than there are colours."""
        place = self.methods.index(method)
        return LINES[place] if place < len(LINES) else INK

    def shape(self, dtype: str) -> str:
        """Return the shape of a precision."""
        return _SHAPES.get(dtype) or self._others[dtype]

    def face(self, engine: str) -> dict[str, Any]:
        """Return how the inside of a mark is drawn: filled, open or half."""
        fill = _FACES.get(engine, "left")
        half = {} if fill == "full" else {"markerfacecoloralt": "white"}
        return {"fillstyle": "full" if fill == "none" else fill, **half} | (
            {"markerfacecolor": "white"} if fill == "none" else {}
        )

    def size(self, composing: str) -> float:
        """Return the size of a mark in points: that of Stokes vectors is large."""
        return _SMALL if composing == "jones" else _LARGE

    def draw(self, axes: Axes, mark: Mark, y: float, **keywords: Any) -> None:
        """Draw a mark."""
        axes.plot(
            mark.ns,
            y,
            color=self.colour(mark.method),
            marker=self.shape(mark.dtype),
            markersize=self.size(mark.composing),
            markeredgewidth=1.8,
            linestyle="none",
            **self.face(mark.engine),
            **keywords,
        )


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
    results = {entry["dtype"]: entry["eps"] for entry in chart["contenders"]}
    reached = frame.floor
    for dtype, eps in sorted(results.items(), key=lambda each: each[1]):
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
