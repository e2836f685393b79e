"""What the variables of a sweep are called, beside coordinates with names of a user's own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import ParameterError
from optipath.sweeps.labels.light_quantities import FAINT, QUANTITIES

if TYPE_CHECKING:
    from collections.abc import Collection

    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_grid import SweepGrid

DETECTOR = "detector"
"""The dimension of several detectors."""

_BESIDE = {"psi": "Psi", "delta": "Delta"}
"""What both ellipsometric angles are called where a parameter has the name of one."""


def is_variable(name: str) -> bool:
    """Tell whether a column of a file is called as a variable of a sweep, at a detector or at all.

    Examples
    --------
    >>> is_variable("S0"), is_variable("DoP at camera"), is_variable("rho")
    (True, True, False)
    """
    own = {quantity.variable for quantity in (*QUANTITIES, FAINT)}
    return name.partition(" at ")[0] in {*own, *_BESIDE.values()}


def detectors_of(plan: Plan) -> tuple[str, ...]:
    """Return the names of the detectors of a plan; dumps are none."""
    return tuple(plan.program.detectors)


def variable_names(grid: SweepGrid, plan: Plan) -> dict[str, str]:
    """Return what the variable of each quantity is called."""
    taken = [*dict.fromkeys([*grid.sizes, *plan.inputs.open])]
    own = [quantity.variable for quantity in (*QUANTITIES, FAINT)]
    beside = _BESIDE if _BESIDE.keys() & set(taken) else {}
    names = {name: beside.get(name, name) for name in own}
    several = len(detectors_of(plan)) > 1
    if faults := [*_faults(taken, {*names.values(), *([DETECTOR] if several else [])})]:
        raise ParameterError(*faults)
    return names


def _faults(taken: Collection[str], names: Collection[str]) -> list[str]:
    return [
        f"'{name}' is what a sweep calls a {'dimension' if name == DETECTOR else 'variable'} of "
        f"its own; give the parameter or dimension another name, such as '{name}_'"
        for name in taken
        if name in names
    ]
