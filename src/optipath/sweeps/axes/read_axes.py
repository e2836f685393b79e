"""The axes of a sweep, out of what is given for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ParameterError
from optipath.sweeps.axes.axis_values import read_values
from optipath.sweeps.axes.checked_axes import axis_faults, computed_faults, unnamed_arrays
from optipath.sweeps.axes.file_columns import read_column
from optipath.sweeps.axes.given_coords import GivenCoordinate, given_coords
from optipath.sweeps.axes.labelled_values import has_coordinates, is_labelled
from optipath.sweeps.axes.sweep_axis import SweepAxis, sweep_axis
from optipath.sweeps.axes.sweep_grid import SweepGrid
from optipath.sweeps.axes.zipped_axes import shared_dimensions, zipped_dimensions
from optipath.sweeps.unknown_names import unknown_names
from optipath.values.axis_texts import AxisValues, IdleValues
from optipath.values.large_angles import LargeAngles
from optipath.values.text_tables import TextColumn

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs

_SHORT = 16
"""How many times the values of all axes a grid has at least beside which they are few."""

_LARGE = 1 << 22
"""How many points a grid has at least whose run takes longer than to look at short axes twice."""


def grid_of(
    inputs: Inputs,
    given: Mapping[str, Any],
    zip: Any = (),  # noqa: A002 - as `path.sweep` has it
    coords: Any = None,
    *,
    ranges: bool = True,
) -> SweepGrid:
    """Return the grid of a sweep."""
    faults: list[str] = []
    besides = given_coords(inputs, coords, faults)
    twice = [name for name in given if name in besides]
    drop = f", such as coords.drop_vars({twice})" if has_coordinates(coords) else ""
    faults += [
        f"'{name}' is given by its name, and in coords as well; leave one of them out{drop}"
        for name in twice
    ]
    several = {name: GivenCoordinate(value) for name, value in given.items()} | besides
    values = _read(inputs, several, faults)
    dimensions = {name: several[name].dimension or name for name in values}
    own = {n: len(v.given) for n, v in values.items() if v.given.ndim and dimensions[n] == n}
    dimensions |= zipped_dimensions(zip, own, {*inputs.open, *values}, faults)
    along = {name: value.dims[0] for name, value in given.items() if is_labelled(value, axes=1)}
    faults += shared_dimensions(along, dimensions)
    faults += _named_as_others(dimensions, values, inputs)
    faults += unnamed_arrays(inputs, several)
    axes: list[SweepAxis] = []
    fixed: dict[str, Any] = {}
    labels: dict[str, tuple[Any, str]] = {}
    for name, value in values.items():
        numbers = value.given
        # Labels of half precision are none of pandas.
        half = value.shown.dtype == np.float16
        shown = value.shown.astype(np.float32) if half else value.shown
        if numbers.ndim:
            told = value._replace(shown=shown)
            axes.append(sweep_axis(inputs.open, name, told, dimensions[name]))
        else:
            fixed[name] = numbers.item() if numbers.dtype.char in "dDUO" else numbers[()]
            labels[name] = shown, value.unit
    grid = SweepGrid(tuple(axes), fixed, labels)
    is_short = max(_LARGE, _SHORT * sum(map(len, axes))) < grid.points
    ranges = ranges or bool(faults) or is_short
    faults += axis_faults(inputs, grid, ranges=ranges)
    if not faults and ranges:
        faults = computed_faults(inputs, grid)
    if faults:
        raise ParameterError(*dict.fromkeys(faults))
    LargeAngles(inputs).look({n: g.value for n, g in several.items() if _is_plain(g.value)})
    return grid


def _read(
    inputs: Inputs, several: Mapping[str, GivenCoordinate], faults: list[str]
) -> dict[str, AxisValues]:
    """Return the values of each parameter that there is, and that nothing is wrong with."""
    found = {}
    told = {n: g.value for n, g in several.items() if not isinstance(g.value, IdleValues)}
    faults += unknown_names(inputs, told)
    for name, (value, _) in several.items():
        if name not in inputs.open and not isinstance(value, IdleValues):
            continue
        try:
            if isinstance(value, TextColumn):
                found[name] = read_column(inputs, value)
            else:
                is_read = isinstance(value, AxisValues)
                found[name] = value if is_read else read_values(inputs, name, value)
        except OptipathError as fault:
            faults += fault.faults
    return found


def _named_as_others(
    dimensions: Mapping[str, str], values: Mapping[str, AxisValues], inputs: Inputs
) -> list[str]:
    """Return what is wrong with dimensions that are called as parameters of other axes."""
    along = {dimensions[name]: name for name, value in values.items() if value.given.ndim}
    return [
        f"'{name}' is along the dimension '{dimension}', which is the name of a parameter with "
        f"another axis; rename the dimension, such as coords.rename_dims({dimension}='point')"
        for dimension, name in along.items()
        if dimension in inputs.open and dimensions.get(dimension) != dimension
    ]


def _is_plain(value: Any) -> bool:
    """Tell whether a value may have plain numbers, without a unit beside them."""
    return not (isinstance(value, TextColumn | AxisValues) or is_labelled(value))
