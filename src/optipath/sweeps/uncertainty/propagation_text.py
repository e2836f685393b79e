"""Light with its uncertainty, as a table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.sweeps.uncertainty.light_figures import figures_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

_DEGREES = 180.0 / math.pi


def text_of_propagation(
    method: str,
    light: Light,
    uncertain: Sequence[UncertainValue],
    uncertainties: Any,
    shares: Any,
) -> str:
    """Return a table of the quantities of light.

    Shapes: light (...); uncertainties (..., 10); shares (..., 10, k).
    """
    values, names = figures_of(light), [each.name for each in uncertain]
    head = ["", "value", "uncertainty", *names]
    rows = [head]
    for place, quantity in enumerate(QUANTITIES):
        unit, factor = (" deg", _DEGREES) if quantity.unit == "rad" else ("", 1.0)
        spread = uncertainties[..., place] * factor
        value = _value(values[..., place] * factor, spread)
        of_each = [_share(shares[..., place, each]) for each in range(len(names))]
        units = [unit if np.any(np.isfinite(n)) else "" for n in (values[..., place], spread)]
        of_unit = [value + units[0], _span(spread, _digits) + units[1]]
        rows.append([quantity.variable, *of_unit, *of_each])
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])]) for row in rows
    ]
    shape = f", shape {light.shape}" if light.shape else ""
    given = "; ".join(map(str, uncertain))
    return "\n".join([f"{method}{shape}: {given}", *lines])


def _value(values: Any, spread: Any) -> str:
    """Write a value to the digit that its uncertainty has (JCGM 100:2008, sec. 7.2.6)."""
    if values.size != 1:
        return _span(values, "{:.4g}".format)
    value, one = float(values.item()), float(spread.item())
    if not (math.isfinite(value) and math.isfinite(one)) or one <= 0.0:
        return f"{value:.6g}"
    places = 1 - math.floor(math.log10(float(f"{one:.1e}")))
    if not 0 <= places <= 15:
        return f"{value:.6g}"
    return f"{value:.{places}f}"


def _digits(number: float) -> str:
    """Write an uncertainty with two digits."""
    if number == 0.0 or not math.isfinite(number):
        return f"{number:g}"
    places = 1 - math.floor(math.log10(float(f"{number:.1e}")))
    return f"{number:.{places}f}" if 0 <= places <= 6 else f"{number:.1e}"


def _share(shares: Any) -> str:
    return _span(100.0 * shares, "{:.0f}".format) + " %" * bool(np.any(np.isfinite(shares)))


def _span(numbers: Any, text: Any) -> str:
    """Write one number, or from where to where numbers are."""
    there = numbers[np.isfinite(numbers)] if numbers.size != 1 else np.ravel(numbers)
    if not there.size:
        return "nan"
    ends = [text(float(end)) for end in (there.min(), there.max())]
    return ends[0] if ends[0] == ends[1] else " .. ".join(ends)
