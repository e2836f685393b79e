"""The marks of a chart: a colour a method, a shape a precision, filled or open, large or small."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.plots.line_colours import INK, LINES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

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
