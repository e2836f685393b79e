"""Stokes vectors as bars, compared with published ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from optipath.errors import OptipathError
from optipath.faults import shown, unknown
from optipath.light.light import Light
from optipath.plots.axes import own_axes
from optipath.plots.colors import INK, LINES
from optipath.plots.light_texts import digits, lights_to_draw
from optipath.plots.text import draw_key, fitting, inches_of, is_wide, width_of
from optipath.values.arrays import array_of
from optipath.values.jax_values import known

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from matplotlib.axes import Axes

    from optipath.values.precision import Numbers

    _ByName = Mapping[str, Numbers]


_HATCHES = "", "///", "...", "\\\\\\", "xx", "++"
_PUBLISHED: dict[str, Any] = {
    "marker": "D",
    "markersize": 5.0,
    "markerfacecolor": "white",
    "color": INK,
    "linestyle": "none",
    "zorder": 5,
}

_ONE = "computed, (published), Δ = computed less published"
_SEVERAL = "Δ: the largest of computed less published"

_DIGITS = 6
"""As many as published tables have."""

_FILLED = 0.92
"""How much of the distance of two bars the numbers below them take at most."""

_ROUNDING = 4.0 * float(np.finfo(float).eps)

_GROUP = 0.78
"""How wide the bars of one component are together."""


def stokes(
    light: Light | Mapping[str, Light],
    ax: Axes | None = None,
    *,
    published: Any = None,
    labels: str | Sequence[str] | None = None,
) -> Axes:
    r"""Draw Stokes vectors as bars, with published values as marks and the difference in digits.

    Below the bars of one light stand its components, what was published in brackets, and the
    difference, computed minus published; below those of several stands the largest difference.
    What is no more than rounding (`Light.noise`) is 0. Very faint or bright light is in powers of
    ten, which the axis names.

    Parameters
    ----------
    light : Light, or mapping of str to Light
        One, a batch of shape (n,), or single ones by their names; six at most.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    published : array_like of shape (..., 4), or mapping of str to it, optional
        Stokes vectors beside which those of the light stand, in their unit; of a mapping of
        lights, by their names. NaN is what was not published.
    labels : str or sequence of str, optional
        The name of the one, or of each of the batch.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("npgr026", case="8")
    >>> ax = stokes(path.trace(), published=path.cases["8"].published["E"])
    >>> ax.get_ylabel()
    'Stokes parameter\n(unit of the source)'
    """
    several = {name: without_noise(each) for name, each in lights_to_draw(light, labels).items()}
    other = published_for(published, light, several)
    power = power_of_ten([*several.values()], other.values())
    numbers = {name: scaled_to(each.stokes, power) for name, each in several.items()}
    printed = {name: scaled_to(each, power) for name, each in other.items()}
    ax = own_axes(ax, (5.6, 4.4))
    keys = _draw_bars(ax, numbers, printed)
    ax.axhline(0.0, color=INK, linewidth=0.8)
    unit = f"10^{digits(power, 7)} units\nof the source" if power else "unit of the source"
    ax.set_ylabel(f"Stokes parameter\n({unit})")
    ax.grid(visible=True, axis="y", alpha=0.3)
    ax.set_axisbelow(True)
    ax.margins(y=0.08)
    if not any(np.nan_to_num(each).any() for each in (*numbers.values(), *printed.values())):
        # Bars of no height say nothing of how high the axis is.
        ax.set_ylim(0.0, 1.0)
    _tell_numbers(ax, numbers, printed)
    if keys:
        # Above, since ticks of many lines are below.
        at: dict[str, Any] = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0)}
        size, columns = ("small", 2) if is_wide(ax) else ("x-small", 1)
        draw_key(ax, keys, min(columns, len(keys)), fontsize=size, **at)
    return ax


def _draw_bars(ax: Axes, numbers: _ByName, printed: _ByName) -> list[Any]:
    """Draw the bars of all lights and the marks beside them; return the key, if one is needed."""
    width = _GROUP / len(numbers)
    keys: list[Any] = []
    for place, (name, result) in enumerate(numbers.items()):
        middle = np.arange(4) + width * (place + 0.5) - 0.5 * _GROUP
        style: dict[str, Any] = {"facecolor": LINES[place], "hatch": _HATCHES[place]}
        style["edgecolor"] = "white"
        ax.bar(middle, np.where(np.isfinite(result), result, 0.0), 0.94 * width, **style)
        if name in printed:
            ax.plot(middle, printed[name], **_PUBLISHED)
        if name or printed:
            message = name or "computed"
            message += ": infinite" if np.isinf(result).any() else ""
            message += ": not read" if np.isnan(result).all() else ""
            keys.append(Patch(label=fitting(ax, message, less=5), **style))
    return [*keys, Line2D([], [], label="published", **_PUBLISHED)] if printed else keys


def _tell_numbers(ax: Axes, numbers: _ByName, printed: _ByName) -> None:
    """Write below the bars what they are, of one light alone, and the differences."""
    columns = [[f"S{place}"] for place in range(4)]
    if len(numbers) == 1:
        (result,) = numbers.values()
        for column, each in zip(columns, result, strict=True):
            column.append(_number(each))
        for argument in printed.values():
            for column, each in zip(columns, argument, strict=True):
                column.append(f"({_number(each)})" if np.isfinite(each) else "(none)")
    if printed:
        apart = np.array([_apart(numbers[name], argument) for name, argument in printed.items()])
        for column, each in zip(columns, apart.T, strict=True):
            there = each[np.isfinite(each)]
            if there.size:
                column.append(f"Δ {digits(there[np.abs(there).argmax()], 2)}")
        legend = _ONE if len(numbers) == 1 else _SEVERAL
        ax.set_xlabel(fitting(ax, legend), fontsize="small")
    ax.set_xticks(range(4), ["\n".join(column) for column in columns])
    ax.tick_params(axis="x", length=0.0)
    # As small as it takes for each number to stand by itself.
    widest = max(width_of(line, 1.0) for column in columns for line in column)
    size = 10.0 if len(columns[0]) == 1 else 8.33 if is_wide(ax) else 5.79
    ax.tick_params(axis="x", labelsize=min(size, _FILLED * inches_of(ax)[0] / 4.0 / widest))


def _apart(result: Any, argument: Any) -> Any:
    """Return differences, 0 where they are rounding of the largest number."""
    apart = result - argument
    largest = np.max(np.abs(result), initial=0.0, where=np.isfinite(result))
    return np.where(np.abs(apart) <= _ROUNDING * largest, 0.0, apart)


def _number(value: float) -> str:
    if np.isfinite(value):
        return digits(value, _DIGITS)
    return "not read" if np.isnan(value) else "infinite"


def published_for(published: Any, light: Any, several: Mapping[str, Any]) -> dict[str, Numbers]:
    """Return published Stokes vectors (4,) by the names of the lights that they belong to."""
    if published is None:
        return {}
    if not isinstance(published, Mapping):
        if isinstance(light, Mapping):
            raise OptipathError(f"published is {shown(published)}; give them by names of lights")
        rows = _numbers("published", published, (*light.shape, 4)).reshape(-1, 4)
        return dict(zip(several, rows, strict=True))
    faults = [fault for name in published for fault in unknown("published", name, several)]
    OptipathError.raise_for(faults)
    return {
        name: _numbers(f"published {shown(name)}", each, (4,)) for name, each in published.items()
    }


def _numbers(what: str, argument: Any, shape: tuple[int, ...]) -> Numbers:
    numbers = array_of(what, argument, OptipathError)
    if numbers.shape != shape or numbers.dtype.kind not in "iuf" or np.isinf(numbers).any():
        raise OptipathError(
            f"{what} is {shown(argument)}; give finite numbers of shape {shape}, NaN where missing"
        )
    return numbers.astype(float)


_PLAIN = range(-3, 5)
"""The powers of ten that numbers on an axis are written without."""


def without_noise(light: Light) -> Light:
    """Return light with 0 for what is no more than rounding."""
    numbers, floor = known(light.stokes), light.noise[..., np.newaxis]
    noise = (np.abs(numbers) < floor) & np.isfinite(floor)
    return Light.of(np.where(noise, 0.0, numbers), light.frame, measured=True)


def power_of_ten(lights: Sequence[Light], others: Iterable[Numbers]) -> int:
    """Return over which power of ten some Stokes vectors are drawn; 0 where they need none."""
    largest = [float(light.log10_intensity) for light in lights]
    with np.errstate(divide="ignore"):
        largest += [float(np.log10(np.nanmax(np.abs(each), initial=0.0))) for each in others]
    finite = [power for power in largest if np.isfinite(power)]
    power = int(np.floor(max(finite, default=0.0)))
    return 0 if power in _PLAIN else power


def scaled_to(stokes: Any, power: int) -> Numbers:
    """Return Stokes vectors over a power of ten."""
    numbers = np.asarray(stokes, float)
    return numbers * np.exp2(-power * np.log2(10.0)) if power else numbers
