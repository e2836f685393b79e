"""The chart of speed against accuracy, as a picture."""

from __future__ import annotations

import warnings
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import MissingExtraError, OptipathError
from optipath.values.written_files import write_file

try:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
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
_FORMS = (".png", ".svg", ".pdf")
_SIDES = (
    (6, 4, "left"),
    (-6, 4, "right"),
    (6, -11, "left"),
    (-6, -11, "right"),
    (6, 14, "left"),
    (-6, 14, "right"),
)
_INK, _FAINT, _RED = "#333333", "#8a8a8a", "#c0392b"


def check_form(out: Path) -> None:
    """Refuse a file in whose form nothing can be drawn.

    Raises
    ------
    OptipathError
        Naming the forms that there are.
    """
    if out.suffix.lower() not in _FORMS:
        known = ", ".join(_FORMS)
        raise OptipathError(f"'{out}' has an ending that cannot be drawn; use one of: {known}")


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
    drawn = BytesIO()
    with warnings.catch_warnings():
        # A title may have letters that the font lacks; they are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph")
        _figure(chart).savefig(drawn, format=out.suffix.lower().removeprefix("."))
    write_file(out, drawn.getvalue())


def _figure(chart: Mapping[str, Any]) -> Figure:
    figure = Figure(figsize=(13.5, 8.0), dpi=120, layout="constrained")
    FigureCanvasAgg(figure)
    # A dollar would begin a formula.
    title = f"Speed against accuracy: {chart['title']}".replace("$", r"\$")
    figure.suptitle(title, fontsize=14, color=_INK)
    panels = figure.subplots(1, 2, sharex=True)
    for axes, (kind, words) in zip(panels, _PANELS.items(), strict=True):
        _panel(axes, chart, kind)
        axes.set_title(words, fontsize=10.5, color=_INK)
        axes.set_xlabel("ns a path", color=_INK)
    panels[0].set_ylabel("relative error: worst region (marker), median (dash)", color=_INK)
    handles = _legend(chart)
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), frameon=False)
    figure.draw_without_rendering()
    for axes, kind in zip(panels, _PANELS, strict=True):
        _label_markers(axes, chart, kind)
    return figure


def _panel(axes: Axes, chart: Mapping[str, Any], kind: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    found = [(c, *_worst(c, kind), _failures(c, kind, chart)) for c in chart["contenders"]]
    held = [entry for entry in found if not entry[3]]
    for contender, worst, median, _ in held:
        _marker(axes, contender, worst, median)
    _frontier(axes, [(c["ns"]["least"], worst) for c, worst, *_ in held])
    low = min([worst for _, worst, *_ in held] + [c["eps"] for c in chart["contenders"]]) / 30
    high = max([worst for _, worst, *_ in held] + [c["eps"] for c in chart["contenders"]])
    times = [c["ns"]["least"] for c in chart["contenders"]]
    axes.set_xlim(min([*times, *chart["limits_ns"].values()]) / 5, max(times) * 8)
    _failing_band(axes, [(c, fails) for c, *_, fails in found if fails], low, high * 30)
    _limits(axes, chart, low, high * 30)
    axes.grid(visible=True, which="major", color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.tick_params(colors=_INK, which="both")
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _worst(contender: Mapping[str, Any], kind: str) -> tuple[float, float]:
    errors, eps = contender["errors"][kind].values(), contender["eps"]
    # An error of nothing has no place on a logarithmic axis: it stands at a tenth of eps.
    worst = max(0.1, *(error["worst"] for error in errors))
    return worst * eps, max(float(np.median([e["median"] for e in errors])), 0.1) * eps


def _failures(contender: Mapping[str, Any], kind: str, chart: Mapping[str, Any]) -> int:
    errors = contender["errors"][kind].values()
    return sum(not error["worst"] <= chart["fails_above"] for error in errors)


def _marker(axes: Axes, contender: Mapping[str, Any], worst: float, median: float) -> None:
    x, colour = contender["ns"]["least"], _colour(contender["engine"])
    axes.plot([x, x], [median, worst], color=colour, linewidth=0.8, alpha=0.6)
    axes.plot(x, median, marker="_", color=colour, markersize=7)
    axes.plot(x, worst, marker=_shape(contender["dtype"]), color=colour, markersize=7)


def _label_markers(axes: Axes, chart: Mapping[str, Any], kind: str) -> None:
    """Name each marker, on the first side of it where nothing stands yet."""
    held = [c for c in chart["contenders"] if not _failures(c, kind, chart)]
    # From above, so that of two that stand close the upper one is named above.
    held.sort(key=lambda contender: -_worst(contender, kind)[0])
    points = [(c["ns"]["least"], _worst(c, kind)[0]) for c in held]
    taken = [Bbox.from_bounds(x - 5, y - 5, 10, 10) for x, y in axes.transData.transform(points)]
    for contender, point in zip(held, points, strict=True):
        for x, y, side in _SIDES:
            label = axes.annotate(
                _name(contender),
                point,
                xytext=(x, y),
                textcoords="offset points",
                ha=side,
                fontsize=8,
                color=_INK,
            )
            box = label.get_window_extent()
            if not box.count_overlaps(taken) or (x, y, side) == _SIDES[-1]:
                taken.append(box)
                break
            label.remove()


def _colour(engine: str) -> str:
    return _COLOURS.get(engine, _INK)


def _shape(dtype: str) -> str:
    return _SHAPES.get(dtype, "^")


def _name(contender: Mapping[str, Any]) -> str:
    composed = " · jones" if contender["composing"] == "jones" else ""
    return f"{contender['method']}{composed}"


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
        axes.text(
            ns,
            low,
            f" this machine's limit: {name}",
            rotation=90,
            va="bottom",
            ha="right",
            fontsize=7.5,
            color=_FAINT,
        )
    for dtype, eps in {c["dtype"]: c["eps"] for c in chart["contenders"]}.items():
        axes.axhline(eps, color=_FAINT, linewidth=0.9, linestyle="--")
        axes.text(
            1.005,
            eps,
            f"eps of\n{dtype}",
            transform=axes.get_yaxis_transform(),
            va="center",
            ha="left",
            fontsize=7.5,
            color=_FAINT,
        )


def _failing_band(
    axes: Axes, failing: list[tuple[Mapping[str, Any], int]], low: float, base: float
) -> None:
    """Draw what fails in some region above everything: a row a method, hollow, counted."""
    regions = max((len(c["errors"]["normwise"]) for c, _ in failing), default=0)
    rows = list(dict.fromkeys(_name(contender) for contender, _ in failing))
    step = 15.0
    top = base * step ** (len(rows) + 0.6)
    axes.set_ylim(low, top)
    ticks = [t for t in axes.get_yticks() if low <= t < base]
    axes.set_yticks(ticks)
    axes.minorticks_off()
    if not rows:
        return
    axes.axhspan(base, top, color=_RED, alpha=0.09, linewidth=0)
    left = axes.get_xlim()[0]
    for number, row in enumerate(rows):
        y = base * step ** (number + 0.7)
        counts = sorted({count for contender, count in failing if _name(contender) == row})
        many = f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else f"{counts[0]}"
        axes.text(
            left, y, f" {row}: fails in {many} of {regions}", va="center", fontsize=8, color=_RED
        )
        for contender, _ in failing:
            if _name(contender) == row:
                x, colour = contender["ns"]["least"], _colour(contender["engine"])
                shape = _shape(contender["dtype"])
                axes.plot(x, y, marker=shape, color=colour, markersize=7, markerfacecolor="white")


def _legend(chart: Mapping[str, Any]) -> list[Line2D]:
    engines = dict.fromkeys(c["engine"] for c in chart["contenders"])
    dtypes = dict.fromkeys(c["dtype"] for c in chart["contenders"])
    none: tuple[list[float], list[float]] = ([], [])
    return [
        *(Line2D(*none, color=_colour(e), linewidth=4, label=e) for e in engines),
        *(Line2D(*none, color=_INK, marker=_shape(d), linewidth=0, label=d) for d in dtypes),
        Line2D(
            *none,
            color=_INK,
            marker="o",
            markerfacecolor="white",
            linewidth=0,
            label=f"off by more than {chart['fails_above']:g} ulp in some region",
        ),
        Line2D(*none, color=_FAINT, label="the best of what fails nowhere"),
    ]
