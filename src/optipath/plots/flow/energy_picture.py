"""A picture of where the power of the light of a path goes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from optipath.errors import OptipathError, shown
from optipath.paths.energy_along import energy_along
from optipath.paths.path_graph import PathGraph
from optipath.plots.flow.energy_places import BAR, EnergyPlaces
from optipath.plots.flow.energy_rows import energy_rows
from optipath.plots.line_colours import FAINT, INK, LINES
from optipath.plots.own_axes import own_axes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from optipath.paths.energy_along import EnergyAlong
    from optipath.plots.flow.energy_rows import EnergyRow

_WIDE, _ROW, _AROUND = 6.4, 0.42, 0.5
"""The width of a figure, the height of a row, and that above and below, in inches."""

_LIGHT, _TAKEN = LINES[4], LINES[1]
_TAKEN_TEXT = "#A04700"
"""The same, darker, as texts are read."""

_POINTS = 10.0
_LEAST_MIDDLE = 0.3
"""The share of the width that is left to ribbons at least."""


def energy(path: PathGraph, ax: Axes | None = None, **values: Any) -> Axes:
    """Draw where the power of the light of a path goes, from above in the order of travel.

    Ribbons are as wide as the intensity S0. What an element takes (absorbs, blocks, or lets go by
    a way that the path does not have) ends in a spike; light that leaves the path has a row of
    its own. In a loop, a ribbon is as wide as all rounds together. Taps, and all ways behind
    them, are dotted: light is read there, and nothing of it is taken.

    Parameters
    ----------
    path : PathGraph
        The path.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    **values : float or str
        As in `PathGraph.trace`, one value each.

    Returns
    -------
    Axes

    Raises
    ------
    OptipathError
        If values do not fit, or are many.

    Examples
    --------
    >>> import optipath as op
    >>> ax = energy(op.load_preset("malus"))
    >>> [text.get_text() for text in ax.texts][:4]
    ['lamp', 'gives 1', 'polarizer', 'takes 0.5 (50 %)']
    """
    if not isinstance(path, PathGraph):
        raise OptipathError(f"energy is that of a path, not of {shown(path)}; give a PathGraph")
    found = energy_along(path, **values)
    if any(link.power.ndim for link in found.links):
        shape = found.links[0].power.shape
        raise OptipathError(
            f"the light is a batch of shape {shape}, and a picture is of one; give one value each"
        )
    if not all(np.isfinite(link.power) for link in found.links):
        raise OptipathError("the light is not a number on some links; give values that there are")
    drawn = energy_rows(found)
    places = EnergyPlaces(drawn.over_largest())
    count = len(drawn.rows) + len(found.notes)
    ax = own_axes(ax, (_WIDE, _AROUND + _ROW * count))
    ax.set_axis_off()
    ax.set_ylim(0.55 - count, 0.55)
    _draw(ax, places)
    _write(ax, places, drawn.rows, found)
    return ax


def _draw(ax: Axes, places: EnergyPlaces) -> None:
    """Draw bars and ribbons."""
    for link in places.drawn.links:
        outline = places.outline(link)
        if link.tap or not link.power:
            half = outline[: len(outline) // 2]
            ax.plot(*half.T, color=FAINT, linestyle=":", linewidth=1.1, gid=link.start)
            continue
        style = {"facecolor": _LIGHT, "edgecolor": _LIGHT, "linewidth": 0.6, "alpha": 0.6}
        ax.add_patch(Polygon(outline, closed=True, gid=f"{link.start} -> {link.end}", **style))
    for row in places.drawn.rows:
        if (spike := places.taken(row)) is not None:
            ax.add_patch(Polygon(spike, closed=True, color=_TAKEN, linewidth=0.6, alpha=0.8))
        width, y = max(places.bar(row), 0.02), places.level[row.name]
        left = places.left[row.lane]
        ax.add_patch(Rectangle((left, y - BAR), width, 2 * BAR, color=INK, linewidth=0.6))


def _write(ax: Axes, places: EnergyPlaces, rows: Sequence[EnergyRow], found: EnergyAlong) -> None:
    """Write names on the left, and what becomes of light on the right, as large as they fit."""
    total = float(sum(found.given.values()))
    texts: list[tuple[Any, Any]] = []
    for row in rows:
        y = places.level[row.name]
        style: dict[str, Any] = {"va": "center", "color": INK}
        name = ax.text(0.0, y, row.name, ha="right", **style)
        told = ax.text(0.0, y, _sentence(row, total), ha="left", **style)
        if row.told == "takes":
            told.set_color(_TAKEN_TEXT)
        texts.append((name, told))
    notes = [
        ax.text(0.0, -float(len(rows) + at), note, ha="left", va="center", color=INK)
        for at, note in enumerate(found.notes)
    ]
    _fit(ax, places, texts, notes)


def _fit(
    ax: Axes, places: EnergyPlaces, texts: Sequence[tuple[Any, Any]], notes: Sequence[Any]
) -> None:
    """Choose the size of texts and the limits of x so that all stands beside the ribbons."""
    whole = ax.get_window_extent()
    low, high = ax.get_ylim()
    figure: Any = ax.figure
    row = whole.height / (high - low) * 72.0 / figure.dpi
    size = min(_POINTS, 0.72 * row)
    every = [text for pair in texts for text in pair]
    while True:
        for text in (*every, *notes):
            text.set_fontsize(size)
        left = max(name.get_window_extent().width for name, _ in texts) + size
        right = max(told.get_window_extent().width for _, told in texts) + size
        longest = max([note.get_window_extent().width for note in notes], default=0.0)
        middle = whole.width - left - right
        if (middle >= _LEAST_MIDDLE * whole.width and longest <= whole.width) or size < 1.0:
            break
        size *= 0.95
    unit = places.width / middle
    beside = 0.5 * size * unit
    ax.set_xlim(-left * unit, places.width + right * unit)
    for name, told in texts:
        name.set_x(-beside)
        told.set_x(places.width + beside)
        y = name.get_position()[1]
        ax.plot([0.0, places.width], [y, y], color=FAINT, linewidth=0.4, alpha=0.5, zorder=0.5)
    for note in notes:
        note.set_x(-left * unit)


def _sentence(row: EnergyRow, total: float) -> str:
    if not row.told:
        return ""
    written = f"{row.told} {row.power:.3g}"
    if row.told == "gives" or not total:
        return written
    return f"{written} ({100.0 * row.power / total:.3g} %)"
