"""Between which values a slider goes, and in which steps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from optipath.errors import OptipathError
from optipath.paths.usual_range import usual_range
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from optipath.explorer.explored_path import ExploredPath

_STEPS = 180
"""How many steps a slider has at least."""


def slider_range(explored: ExploredPath, name: str) -> list[float] | None:
    """Return the ends and the step of a slider, in the unit of the parameter."""
    try:
        ends = usual_range(explored.path, name)
    except OptipathError:
        return None
    unit = explored.parameters[name].unit
    low, high = sorted(in_unit(end, unit) for end in ends)
    return [low, high, _step_between(low, high)]


def _step_between(low: float, high: float) -> float:
    """Return a power of ten of which there are 180 steps at least between two numbers.

    Examples
    --------
    >>> _step_between(0.0, 90.0), _step_between(0.0, 360.0), _step_between(1.0, 3.0)
    (0.1, 1.0, 0.01)
    """
    return float(f"1e{math.floor(math.log10((high - low) / _STEPS))}")
