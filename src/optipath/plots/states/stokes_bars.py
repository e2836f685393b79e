"""Stokes vectors as bars, beside what was published for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from optipath.plots.line_colours import INK, LINES
from optipath.plots.own_axes import own_axes
from optipath.plots.states.lights_to_draw import lights_to_draw
from optipath.plots.states.published_stokes import published_for
from optipath.plots.states.scaled_stokes import power_of_ten, scaled_to, without_noise
from optipath.plots.states.state_words import digits
from optipath.plots.titles_and_keys import fitting, inches_wide, key_above
from optipath.values.arrays.jax_values import known

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.light.light import Light

    _ByName = Mapping[str, npt.NDArray[np.float64]]

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

_NARROW = 3.0
"""In inches."""

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

    Raises
    ------
    OptipathError
        If there are too many, or names or published values do not fit.
    ParameterError
        If JAX traces the light.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("npgr026", case="8")
    >>> ax = stokes(path.trace(), published=path.cases["8"].published["E"])
    >>> ax.get_ylabel()
    'Stokes parameter\n(unit of the source)'
    """
    several = {name: without_noise(each) for name, each in lights_to_draw(light, labels).items()}
    beside = published_for(published, light, several)
    power = power_of_ten([*several.values()], beside.values())
    numbers = {
        name: scaled_to(known(each.mantissa), each.exponent, power)
        for name, each in several.items()
    }
    printed = {name: scaled_to(each, 0, power) for name, each in beside.items()}
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
    key_above(ax, keys)
    _fit_numbers(ax)
    return ax


def _draw_bars(ax: Axes, numbers: _ByName, printed: _ByName) -> list[Any]:
    """Draw the bars of all lights and the marks beside them; return the key, if one is needed."""
    width = _GROUP / len(numbers)
    keys: list[Any] = []
    for place, (name, found) in enumerate(numbers.items()):
        middle = np.arange(4) + width * (place + 0.5) - 0.5 * _GROUP
        style: dict[str, Any] = {
            "facecolor": LINES[place],
            "edgecolor": "white",
            "hatch": _HATCHES[place],
        }
        ax.bar(middle, np.where(np.isfinite(found), found, 0.0), 0.94 * width, **style)
        if name in printed:
            ax.plot(middle, printed[name], **_PUBLISHED)
        if name or printed:
            told = name or "computed"
            told += ": infinite" if np.isinf(found).any() else ""
            told += ": not read" if np.isnan(found).all() else ""
            keys.append(Patch(label=fitting(ax, told, less=5), **style))
    return [*keys, Line2D([], [], label="published", **_PUBLISHED)] if printed else keys


def _tell_numbers(ax: Axes, numbers: _ByName, printed: _ByName) -> None:
    """Write below the bars what they are, of one light alone, and the differences."""
    texts = [f"S{place}" for place in range(4)]
    if len(numbers) == 1:
        (found,) = numbers.values()
        texts = [_lines(text, _number(each)) for text, each in zip(texts, found, strict=True)]
        for given in printed.values():
            told = [f"({_number(each)})" if np.isfinite(each) else "(none)" for each in given]
            texts = [_lines(text, each) for text, each in zip(texts, told, strict=True)]
    if printed:
        apart = np.array([_apart(numbers[name], given) for name, given in printed.items()])
        texts = [_lines(text, _largest(each)) for text, each in zip(texts, apart.T, strict=True)]
        legend = _ONE if len(numbers) == 1 else _SEVERAL
        ax.set_xlabel(fitting(ax, legend), fontsize="small")
    ax.set_xticks(range(4), texts)
    ax.tick_params(axis="x", length=0.0)
    if any("\n" in text for text in texts):
        ax.tick_params(axis="x", labelsize="small" if inches_wide(ax) > _NARROW else "xx-small")


def _fit_numbers(ax: Axes) -> None:
    """Write the numbers below the bars as small as it takes for each to stand by itself."""
    figure: Any = ax.figure.figure
    figure.draw_without_rendering()  # By which axes have the places of their layout.
    (left, _), (right, _) = ax.transData.transform([(0.0, 0.0), (1.0, 0.0)])
    texts = ax.get_xticklabels()
    share = _FILLED * (right - left) / max(text.get_window_extent().width for text in texts)
    if share < 1.0:
        ax.tick_params(axis="x", labelsize=share * texts[0].get_fontsize())


def _apart(found: Any, given: Any) -> Any:
    """Return differences, 0 where they are rounding of the largest number."""
    apart = found - given
    largest = np.max(np.abs(found), initial=0.0, where=np.isfinite(found))
    return np.where(np.abs(apart) <= _ROUNDING * largest, 0.0, apart)


def _largest(apart: npt.NDArray[np.float64]) -> str:
    """Return the largest of some differences; none where nothing can be compared."""
    there = apart[np.isfinite(apart)]
    return f"Δ {digits(there[np.abs(there).argmax()], 2)}" if there.size else ""


def _lines(*texts: str) -> str:
    return "\n".join(text for text in texts if text)


def _number(value: float) -> str:
    if np.isfinite(value):
        return digits(value, _DIGITS)
    return "not read" if np.isnan(value) else "infinite"
