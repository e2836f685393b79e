"""The axes of a sweep, out of what is given for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.sweep_axis import SweepAxis
from optipath.sweeps.sweep_grid import SweepGrid

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs


def grid_of(
    inputs: Inputs,
    given: Mapping[str, Any],
    zip: Any = (),  # noqa: A002 - as `path.sweep` has it
    coords: Any = None,
) -> SweepGrid:
    """Return the grid of a sweep.

    Parameters
    ----------
    inputs : Inputs
        What may be given.
    given : mapping of str to Any
        What is, by name.
    zip, coords
        As `PathGraph.sweep` takes them.

    Returns
    -------
    SweepGrid
    """
    del zip, coords
    axes, fixed = [], {}
    for name, value in given.items():
        numbers = np.asarray(value)
        if not numbers.ndim:
            fixed[name] = value
            continue
        parameter = inputs.open[name]
        axes.append(SweepAxis(name, name, numbers, "rad", numbers, parameter.help))
    return SweepGrid(tuple(axes), fixed)
