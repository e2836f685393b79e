"""The elements of a Mueller matrix, over M00, as a map with its numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Patch, Rectangle

from optipath.errors import OptipathError
from optipath.faults import shown
from optipath.light.mueller import Mueller
from optipath.plots.axes import own_axes
from optipath.plots.colors import HATCHED, INK, ColourScale
from optipath.plots.light_texts import digits
from optipath.plots.text import head, is_wide, key_below
from optipath.values.jax_values import check_known, known

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from optipath.values.precision import Numbers


_NAMES = tuple(f"S{place}" for place in range(4))
_DARK = 0.62
"""From which share of the scale on white digits are read better than dark ones."""


def mueller(matrix: Mueller, ax: Axes | None = None) -> Axes:
    """Draw a Mueller matrix over its M00, which the title tells: colours apart from white, digits.

    Columns are what comes in, rows what goes out. What is no more than the noise of the matrix is
    0; an element that is NaN is hatched, and so are all where M00 is 0 or noise.

    Parameters
    ----------
    matrix : Mueller
        A single one.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import optipath as op
    >>> mueller(op.Polarizer("30 deg").mueller()).get_title()
    'M / M00, with M00 = 0.5'
    """
    first, cells = _over_first(_known_matrix(matrix))
    ax = own_axes(ax, (5.2, 4.6))
    scale = ColourScale.signed(max(1.0, np.nanmax(np.abs(cells), initial=0.0)))
    masked = np.ma.masked_invalid(cells)
    image = ax.imshow(masked, cmap=scale.colours, norm=scale.norm, aspect="auto")
    for row, column in np.ndindex(4, 4):
        _draw_cell(ax, row, column, float(cells[row, column]), scale)
    for edge in (0.5, 1.5, 2.5):
        ax.axhline(edge, color="white", linewidth=1.0)
        ax.axvline(edge, color="white", linewidth=1.0)
    ax.set(xlabel="in", ylabel="out", xticks=range(4), yticks=range(4))
    ax.set_xticklabels(_NAMES)
    ax.set_yticklabels(_NAMES)
    ax.tick_params(length=0.0)
    head(ax, f"M / M00, with M00 = {digits(first)}" if np.isfinite(first) else "M / M00")
    scale.bar(image, ax, "")
    if np.isnan(cells).any():
        message = "not known (NaN)" if np.isnan(matrix.matrix).any() else "none: M00 is 0, or noise"
        key_below(ax, [Patch(label=message, **HATCHED)])
    return ax


def _known_matrix(matrix: Any) -> Mueller:
    if not isinstance(matrix, Mueller):
        raise OptipathError(
            f"{shown(matrix)} is no Mueller matrix; give one, as path.mueller() returns it"
        )
    check_known("a picture of a Mueller matrix", matrix.matrix)
    if matrix.shape:
        raise OptipathError(
            f"the Mueller matrix is a batch of shape {matrix.shape}; give one of it by its index"
        )
    return matrix


def _over_first(matrix: Mueller) -> tuple[float, Numbers]:
    """Return M00, and the elements over it; NaN where there is none."""
    numbers, noise = np.array(known(matrix.matrix), float), float(matrix.noise)
    first = float(numbers[0, 0])
    if not abs(first) > noise:
        return first, np.full((4, 4), np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        cells = np.where(np.abs(numbers) < noise, 0.0, numbers / first)
    return first, np.where(np.isfinite(cells), cells, np.nan)


def _draw_cell(ax: Axes, row: int, column: int, value: float, scale: ColourScale) -> None:
    if np.isnan(value):
        ax.add_patch(Rectangle((column - 0.5, row - 0.5), 1.0, 1.0, **HATCHED))
        return
    apart = 2.0 * abs(float(scale.norm(value)) - 0.5)
    colour = "white" if apart > _DARK else INK
    size = "medium" if is_wide(ax) else "xx-small"
    middle: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": size}
    ax.text(column, row, _cell_text(value), color=colour, **middle)


def _cell_text(value: float) -> str:
    """Return a number of a cell, by three decimals, or by its power of ten where it is small."""
    return digits(value, 1) if 0.0 < abs(value) < 5e-4 else digits(round(value, 3), 4)
