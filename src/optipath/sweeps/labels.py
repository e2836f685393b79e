"""Names of variables, and tables of a sweep as text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.light.quantities import QUANTITIES
from optipath.plan.reading import pieces

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepGrid


DETECTOR = "detector"
"""The dimension of several detectors."""

CAPITALIZED = {"psi": "Psi", "delta": "Delta"}
"""What both ellipsometric angles are called where a parameter has the name of one."""


def is_variable(name: str) -> bool:
    """Tell whether a column of a file is called as a variable of a sweep, at a detector or at all.

    >>> is_variable("S0"), is_variable("DoP at camera"), is_variable("rho")
    (True, True, False)
    """
    own = {quantity.variable for quantity in QUANTITIES}
    return name.partition(" at ")[0] in {*own, *CAPITALIZED.values()}


def detectors_of(plan: Plan) -> tuple[str, ...]:
    """Return the names of the detectors of a plan; dumps are none."""
    return tuple(plan.program.detectors)


def variable_names(grid: SweepGrid, plan: Plan) -> dict[str, str]:
    """Return what the variable of each quantity is called."""
    taken = [*dict.fromkeys([*grid.sizes, *plan.inputs.open])]
    own = [quantity.variable for quantity in QUANTITIES]
    other = CAPITALIZED if CAPITALIZED.keys() & set(taken) else {}
    names = {name: other.get(name, name) for name in own}
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


_ROWS = 1 << 16
"""How many rows are computed at once."""


def heading(name: str, unit: str) -> str:
    """Return the heading of a column, with the unit of its numbers.

    >>> heading("delta", "deg"), heading("n1", "")
    ('delta (deg)', 'n1')
    """
    return f"{name} ({unit})" if unit else name


def regions(shape: Sequence[int], most: int = _ROWS) -> Iterator[tuple[slice, ...]]:
    """Yield parts of a grid in the order of its points.

    >>> [[(cut.start, cut.stop) for cut in region] for region in regions((2, 3), 2)]
    [[(0, 1), (0, 2)], [(0, 1), (2, 3)], [(1, 2), (0, 2)], [(1, 2), (2, 3)]]
    """
    for piece in pieces(tuple(shape), most):
        cuts = [each if isinstance(each, slice) else slice(each, each + 1) for each in piece.where]
        yield (*cuts, *[slice(0, size) for size in shape[len(cuts) :]])


def table_heads(plan: Plan, grid: SweepGrid) -> list[str]:
    """Return the heading of each column: of the axes, then of the quantities of light."""
    names = variable_names(grid, plan)
    ends = detectors_of(plan)
    at = [f" at {end}" for end in ends] if len(ends) > 1 else [""]
    messages = [
        heading(names[quantity.variable] + place, quantity.shown_unit)
        for place in at
        for quantity in QUANTITIES
    ]
    return [_quoted(name) for name in (*[heading(a.name, a.unit) for a in grid.axes], *messages)]


def table_columns(plan: Plan, grid: SweepGrid, region: Sequence[slice]) -> Iterator[Sequence[str]]:
    """Yield the texts of each column for a part of a grid."""
    shape = tuple(cut.stop - cut.start for cut in region)
    places = dict(zip(grid.sizes, range(len(shape)), strict=True))
    for axis in grid.axes:
        place = places[axis.dimension]
        texts = np.array([_text(value) for value in axis.shown[region[place]].tolist()], object)
        along = texts.reshape(-1, *(1,) * (len(shape) - 1 - place))
        yield np.broadcast_to(along, shape).ravel().tolist()
    lights = plan.run_all(**grid.given(region))
    for end in detectors_of(plan):
        for quantity in QUANTITIES:
            numbers = quantity.shown_of(lights[end])
            each = np.broadcast_to(numbers + 0.0, shape)  # It may be the same along an axis.
            yield [repr(number) for number in each.ravel().tolist()]


def _text(value: Any) -> str:
    return _quoted(value) if isinstance(value, str) else repr(value)


def _quoted(text: str) -> str:
    """Return a cell of a table, in quotation marks where it needs them."""
    return '"' + text.replace('"', '""') + '"' if any(each in text for each in ',"\n') else text
