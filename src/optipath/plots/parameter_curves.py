"""Curves and maps of the light of a path over its parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np

from optipath.errors import OptipathError
from optipath.faults import listed
from optipath.plots.axes import own_axes
from optipath.plots.colors import DASHES, FAINT, INK, LINES
from optipath.plots.light_at_detector import (
    START,
    DrawnQuantity,
    axis_of,
    drawn_quantities,
    drawn_quantity,
    end_of,
    fine_steps,
    quantities_at,
    reads_of,
    varied,
)
from optipath.plots.text import fitting, head, is_wide, key_within, label_axes

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from matplotlib.axes import Axes

    from optipath.paths.path_graph import PathGraph
    from optipath.plots.light_at_detector import AlongAxis
    from optipath.values.precision import Numbers

    Drawn = tuple[DrawnQuantity, Numbers]


_SIZE = 6.4, 4.2

_DARK = 1e-9
"""Which share of the intensity is next to nothing."""


def curve(
    path: PathGraph,
    x: str,
    y: str | Sequence[str] = ("S0",),
    ax: Axes | None = None,
    *,
    values: Any = None,
    detector: str | None = None,
    **parameters: Any,
) -> Axes:
    """Draw quantities of the light at a detector against one parameter.

    Quantities of one unit share an axis, those of a second one have the axis on the right. Curves
    are open where light does not have a quantity, as the angle of unpolarised light, and where an
    angle goes out at one end and comes in at the other. A thin line marks the value by default.

    Parameters
    ----------
    path : PathGraph
    x : str
        The parameter that goes along x, in its unit.
    y : str or sequence of str, optional
        What goes up, in capitals or not: ``"S0"`` to ``"S3"``, ``"DoP"``, ``"DoLP"``, ``"AoP"``,
        ``"ellipticity"``, ``"psi"``, ``"delta"``.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    values : array_like or str, optional
        Those of `x`, as a sweep takes them: ``"0 deg:90 deg:91"``, texts with units, or numbers in
        radians and metres. By default 721 over its usual range, up to 23041 where it changes
        fast, and a title where that does not do; the curve is open where the path does not take
        them.
    detector : str, optional
        A detector or a dump; needed only where there are several detectors.
    **parameters : float or str
        The other values, as in `PathGraph.trace`, one each.

    Returns
    -------
    Axes
        That on the left.

    Examples
    --------
    >>> import optipath as op
    >>> ax = curve(op.load_preset("malus"), "angle", values="0 deg:90 deg:91")
    >>> ax.get_xlabel(), ax.get_ylabel()
    ('angle: turn of the analyser against the polariser (°)', 'S0: intensity')
    """
    quantities = drawn_quantities(y)
    units_of(quantities)
    (parameter,) = varied(path, [x], parameters)
    along, argument = axis_of(path, parameter, values, START)
    end, chosen = end_of(path, detector), values is None

    def numbers_at(values: Numbers) -> Numbers:
        every = [*quantities, *drawn_quantities("S0")]
        return quantities_at(path, end, every, {x: values}, parameters, chosen=chosen).T

    numbers, message = numbers_at(argument), ""
    if np.isnan(numbers).all():
        chosen = False  # The path refuses all, and says why.
        numbers = numbers_at(argument)
    if values is None:
        on_picture = _on_picture(quantities, numbers)
        fine = fine_steps(argument, numbers, numbers_at, on_picture)
        message, numbers = fine.told(x), fine.numbers
        along = along._replace(numbers=np.interp(fine.values, argument, along.numbers))
    ax = own_axes(ax, _SIZE)
    if message:
        head(ax, message)
    drawn = [*zip(quantities, numbers.T, strict=False)]
    draw_curves(ax, along, drawn, reads=reads_of(path, end))
    return ax


def _on_picture(
    quantities: Sequence[DrawnQuantity], first: Numbers
) -> Callable[[Numbers], Numbers]:
    """Return what makes of quantities where they are on a picture, by the first, and S0 behind."""
    power = first[:, -1]
    dark = _DARK * float(np.max(power, where=np.isfinite(power), initial=0.0))
    heights = []
    for quantity, values in zip(quantities, first.T, strict=False):
        low, high = _ends(quantity, values)
        heights.append(max(high - low, dark if quantity.name.startswith("S") else 0.0) or 1.0)

    def on_picture(numbers: Numbers) -> Numbers:
        columns = []
        for quantity, values, height in zip(quantities, numbers.T, heights, strict=False):
            if quantity.period is None:
                columns.append(values / height)
            else:  # An angle that comes round is on a circle.
                turn = 2.0 * np.pi / quantity.period * values
                columns += [np.cos(turn), np.sin(turn)]
        return np.stack(columns, axis=1)

    return on_picture


def _ends(quantity: DrawnQuantity, values: Numbers) -> tuple[float, float]:
    """Return the ends of the axis of a quantity: its own, or those of its values and of 0."""
    finite = np.append(values[np.isfinite(values)], 0.0)
    return quantity.light.limits or (float(finite.min()), float(finite.max()))


_MAP_SIZE = 6.4, 4.8
_COUNT = 121


def quantity_map(
    path: PathGraph,
    x: str,
    y: str,
    quantity: str = "S0",
    ax: Axes | None = None,
    *,
    x_values: Any = None,
    y_values: Any = None,
    detector: str | None = None,
    **parameters: Any,
) -> Axes:
    """Draw a quantity of the light at a detector in colours, over two parameters.

    Colours of S0 and of degrees of polarisation are in order from 0, those of S1 to S3 and of the
    ellipticity go apart from white at 0, and those of angles come round. Places at which light
    does not have the quantity are grey; a cross marks the values by default.

    Parameters
    ----------
    path : PathGraph
    x, y : str
        The parameters along the axes, each in its unit.
    quantity : str, optional
        What the colours show; the names are those of `curve`.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    x_values, y_values : array_like or str, optional
        As `curve` takes values; by default 121 each over the usual range, and the map is grey
        where the path does not take them.
    detector, **parameters
        As `curve` takes them.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("malus")
    >>> ax = quantity_map(path, "angle", "intensity", y_values=[0.0, 1.0, 2.0])
    >>> ax.get_title()
    '+ by default: angle 30°, intensity 1'
    """
    drawn = drawn_quantity(quantity)
    one, other = varied(path, [x, y], parameters)
    along, first = axis_of(path, one, x_values, _COUNT)
    up, second = axis_of(path, other, y_values, _COUNT)
    arguments = {x: first, y: second}
    chosen = x_values is None and y_values is None
    end = end_of(path, detector)
    (numbers,) = quantities_at(path, end, [drawn], arguments, parameters, chosen=chosen)
    if chosen and np.isnan(numbers).all():  # If the path refuses all, it says why.
        (numbers,) = quantities_at(path, end, [drawn], arguments, parameters, chosen=False)
    ax = own_axes(ax, _MAP_SIZE)
    draw_map(ax, along, up, drawn, numbers, reads=reads_of(path, end))
    return ax


_NONE = "#9c9c9c"
"""Of places where light does not have the quantity; no colour of a scale."""


def draw_map(
    ax: Axes,
    along: AlongAxis,
    up: AlongAxis,
    quantity: DrawnQuantity,
    numbers: Numbers,
    *,
    reads: str = "stokes",
) -> None:
    """Draw a map (along, up), its color bar, and a cross at the default values."""
    columns, rows = np.argsort(along.numbers), np.argsort(up.numbers)
    cells = np.ma.masked_invalid(numbers[np.ix_(columns, rows)].T)
    scale = quantity.colours(numbers)
    colours = mpl.colormaps[scale.colours].with_extremes(bad=_NONE)
    x, y = along.numbers[columns], up.numbers[rows]
    how: dict[str, Any] = {"cmap": colours, "norm": scale.norm, "shading": "nearest"}
    image: Any = ax.pcolormesh(x, y, cells, rasterized=True, **how)
    # The outer cells reach beyond the values, where there may be none.
    ax.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    label_axes(ax, along.label, up.label)
    text = f"{quantity.label}{' (grey: none)' if np.isnan(numbers).any() else ''}"
    scale.bar(image, ax, fitting(ax, text, "medium", upright=True))
    tell_missing(ax, [(quantity, numbers)], reads)
    _mark_default(ax, along, up)


def _mark_default(ax: Axes, along: AlongAxis, up: AlongAxis) -> None:
    """Mark where both parameters have the values by default, and say which above."""
    if along.default is None or up.default is None:
        return
    for colour, width in (("white", 3.0), (INK, 1.2)):
        mark: dict[str, Any] = {"marker": "+", "markersize": 9, "markeredgewidth": width}
        mark |= {"color": colour, "linestyle": "none", "clip_on": False}
        ax.plot(along.default, up.default, **mark)
    head(ax, f"+ by default: {along.name} {along.default_text}, {up.name} {up.default_text}")


_MARGIN = 0.04
"""The share of an axis that is left free above and below."""


_FEW = 12
"""As many points are each marked."""

_MARKS = "o", "s", "D", "^", "v"


def units_of(quantities: Sequence[DrawnQuantity]) -> list[list[DrawnQuantity]]:
    """Return quantities by their units: the left axis, and the right one."""
    groups: dict[str, list[DrawnQuantity]] = {}
    for each in quantities:
        groups.setdefault(each.unit, []).append(each)
    if len(groups) > 2:
        kinds = [" and ".join(each.name for each in group) for group in groups.values()]
        raise OptipathError(
            f"{listed(kinds)} have {len(groups)} units; draw those of one or two units in a picture"
        )
    return [*groups.values()]


def draw_curves(
    ax: Axes, along: AlongAxis, curves: Sequence[Drawn], *, reads: str = "stokes"
) -> None:
    """Draw curves, axes and a legend; points are marked where few, or alone between gaps."""
    groups = units_of([quantity for quantity, _ in curves])
    order = np.argsort(along.numbers, kind="stable")
    numbers = along.numbers[order]
    places = {quantity.name: place for place, (quantity, _) in enumerate(curves)}
    sides = [ax, *(ax.twinx() for _ in groups[1:])]
    lines: list[Any] = []
    ax.set_xlim(numbers[0], numbers[-1])
    for side, group in zip(sides, groups, strict=True):
        members = [(quantity, values[order]) for quantity, values in curves if quantity in group]
        for quantity, values in members:
            lines += _draw(side, numbers, quantity, values, places[quantity.name])
        _limit(side, members)
        up = group[0].label if len(group) == 1 else ", ".join(each.short for each in group)
        label_axes(side, along.label, up)
    ax.grid(visible=True, alpha=0.3)
    mark_default(ax, along)
    tell_missing(ax, curves, reads)
    if len(curves) > 1:
        key_within(sides, lines)


def _draw(
    ax: Axes, along: Numbers, quantity: DrawnQuantity, values: Numbers, place: int
) -> list[Any]:
    argument = along
    if quantity.period:
        along, values = open_at_jumps(along, values, quantity.period)
    marked = np.isfinite(values)
    if len(argument) > _FEW:
        # Only those to which no line leads.
        gaps = np.pad(~marked, 1, constant_values=True)
        marked &= gaps[:-2] & gaps[2:]
    dash, colour = (place + place // len(LINES)) % len(DASHES), LINES[place % len(LINES)]
    if (marked := marked & np.isin(along, argument)).any():
        mark: dict[str, Any] = {"marker": _MARKS[place % len(_MARKS)], "markersize": 4.0}
        ax.plot(along[marked], values[marked], color=colour, linestyle="none", **mark)
    style: dict[str, Any] = {"color": colour, "linestyle": DASHES[dash]}
    return ax.plot(along, values, label=quantity.short, gid=quantity.name, **style)


def _limit(ax: Axes, members: Sequence[Drawn]) -> None:
    """Let an axis reach from end to end where its quantities have ends, and else from 0."""
    ends = [_ends(*each) for each in members]
    low, high = min(each[0] for each in ends), max(each[1] for each in ends)
    high = high if low < high else low + 1.0
    room = _MARGIN * (high - low)
    ax.set_ylim(low - room, high + room)
    if members[0][0].unit == "°":
        step = 30.0 if high - low <= 180.0 and is_wide(ax) else 90.0
        ax.set_yticks(np.arange(low, high + 1.0, step))


def mark_default(ax: Axes, along: AlongAxis) -> None:
    """Mark the value by default by a thin vertical line, with its text above."""
    if along.default is None:
        return
    ax.axvline(along.default, color=FAINT, linewidth=0.8, zorder=0.5, gid="default")
    top = ax.secondary_xaxis("top")
    top.set_xticks([along.default], labels=[along.default_text])
    top.tick_params(length=3.0, color=FAINT, labelcolor=INK, labelsize="small")


def tell_missing(ax: Axes, curves: Sequence[Drawn], reads: str) -> None:
    """Say which quantities have no value anywhere, or are not read, where curves are missing."""
    missing = [quantity for quantity, values in curves if not np.isfinite(values).any()]
    if not missing:
        return
    read = [each.name for each in missing if each.is_read(reads)]
    unread = [each.name for each in missing if not each.is_read(reads)]
    lines = [f"{listed(read)}: the light has none"] if read else []
    lines += [f"{listed(unread)}: not read"] if unread else []
    middle: dict[str, Any] = {"ha": "center", "va": "center", "transform": ax.transAxes}
    ax.text(0.5, 0.5, "\n".join(lines), color=INK, fontsize=9, **middle)


_FLIP = 0.05
"""How near to half a period a step is a flip, which is drawn neither up nor down."""


def open_at_jumps(along: Numbers, angles: Numbers, period: float) -> tuple[Numbers, Numbers]:
    """Return a curve of (count,) points with gaps where an angle jumps from end to end.

    >>> along, angles = np.array([0.0, 1.0]), np.array([80.0, -80.0])
    >>> [each.tolist() for each in open_at_jumps(along, angles, 180.0)]
    [[0.0, 0.5, 0.5, 0.5, 1.0], [80.0, 90.0, nan, -90.0, -80.0]]
    """
    step = np.diff(angles)
    with np.errstate(invalid="ignore"):
        flips = np.abs(np.abs(step) / period - 0.5) < _FLIP
        jumps = (np.abs(step) > period / 2) & ~flips
    end = np.sign(angles[:-1]) * period / 2
    rest = step + 2 * end
    places: list[int] = []
    more: list[tuple[float, float]] = []
    for at in np.flatnonzero(flips | jumps).tolist():
        if flips[at]:
            gap = [(along[at], np.nan)]
        else:
            share = (end[at] - angles[at]) / rest[at] if rest[at] else 0.5
            meets = along[at] + share * (along[at + 1] - along[at])
            gap = [(meets, end[at]), (meets, np.nan), (meets, -end[at])]
        places += [at + 1] * len(gap)
        more += gap
    x, y = np.array(more).reshape(-1, 2).T
    return np.insert(along, places, x), np.insert(angles, places, y)
