"""Axes given as coordinates, labeled values or columns of a file."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from os import PathLike
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import OptipathError, ParameterError, collecting, shown
from optipath.sweeps.labels import DETECTOR, is_variable
from optipath.values.columns import NO_UNIT, columns_of, first_of, missing_unit
from optipath.values.text import AxisValues, read_entries
from optipath.values.units import BASE_UNITS, UNITS, dimension_of, units_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from optipath.plan.inputs import Inputs
    from optipath.values.columns import TextColumn
    from optipath.values.parameters import Parameter


_ROWS = "point"
"""The dimension along which the columns of a file vary together."""


_OPENED = {
    ".nc": "xr.open_dataset",
    ".h5": "xr.open_dataset",
    ".zarr": "xr.open_zarr",
}
"""What reads the coordinates of files that are no tables."""


class CoordinateArgument(NamedTuple):
    """What is given for a parameter, and along which dimension."""

    value: Any
    dimension: str = ""


def coords_axes(inputs: Inputs, coords: Any, faults: list[str]) -> dict[str, CoordinateArgument]:
    """Return what ``coords=`` gives, by name."""
    if coords is None:
        return {}
    try:
        if isinstance(coords, (str, PathLike)):
            return _of_file(inputs, coords, faults)
        if has_coordinates(coords):
            return _of_dataset(inputs, coords, faults)
    except OptipathError as fault:
        faults += [each.under(fault.about) for each in fault.faults]
        return {}
    if isinstance(coords, Mapping):
        return {str(name): CoordinateArgument(value) for name, value in coords.items()}
    what = f"a {type(coords).__name__}" if hasattr(coords, "columns") else shown(coords)
    faults.append(
        f"coords is {what}; give the name of a CSV file, a Dataset, or columns by name, such as "
        f"{{'delta': [...]}}, and zip= where they vary together"
    )
    return {}


def _of_file(
    inputs: Inputs, path: str | PathLike[str], faults: list[str]
) -> dict[str, CoordinateArgument]:
    if (opened := _OPENED.get(PurePath(path).suffix)) is not None:
        raise ParameterError(
            f"coords='{path}' is no CSV file; give what it holds, coords={opened}('{path}')"
        )
    # The table of a sweep has its axes, and what was found along them.
    columns = [
        column
        for column in columns_of(path, inputs.open)
        if column.name in inputs.open or not is_variable(column.name)
    ]
    dimension = _ROWS if len(columns) > 1 else ""
    names = [column.name for column in columns]
    faults += [f"{path}: {inputs.unknown(name)}" for name in names if name not in inputs.open]
    known = [column for column in columns if column.name in inputs.open]
    return {column.name: CoordinateArgument(column, dimension) for column in known}


def _of_dataset(inputs: Inputs, argument: Any, faults: list[str]) -> dict[str, CoordinateArgument]:
    results = {}
    coords, order = getattr(argument, "coords", argument), _order_of_dimensions(argument)
    # Those of a store that was opened are in the order of the alphabet.
    first = sorted(coords.items(), key=lambda each: min(map(order.index, each[1].dims), default=0))
    for name, array in first:
        if name not in inputs.open and (name == DETECTOR or _is_label(inputs, coords, name)):
            continue
        if name not in inputs.open:
            faults.append(f"{inputs.unknown(str(name))}, or leave it out, .drop_vars('{name}')")
        elif array.ndim > 1:
            faults.append(
                f"coordinate '{name}' is along {', '.join(map(str, array.dims))}, and an axis has "
                f"one dimension; leave it out, .drop_vars('{name}'), or make it of one, .stack(...)"
            )
        else:
            results[str(name)] = CoordinateArgument(array, str(array.dims[0]) if array.dims else "")
    return results


def _order_of_dimensions(argument: Any) -> list[Any]:
    """Return the dimensions, as data have them, and then as coordinates do."""
    data = sorted(getattr(argument, "data_vars", {}).values(), key=lambda each: -each.ndim)
    several = [*data, argument, *getattr(argument, "coords", argument).values()]
    return list(dict.fromkeys(dimension for each in several for dimension in each.dims))


def _is_label(inputs: Inputs, coords: Any, name: Any) -> bool:
    """Tell whether a coordinate says what the points of a dimension are called, and no more."""
    return coords[name].dims == (name,) and any(
        other in inputs.open and array.dims == (name,) for other, array in coords.items()
    )


_NO_UNIT = ("", NO_UNIT, "dimensionless")


def is_labelled(value: Any, axes: int | None = None) -> bool:
    """Tell whether a value is a `DataArray`, without importing xarray.

    >>> is_labelled([0.5])
    False
    """
    xarray = sys.modules.get("xarray")
    result = xarray is not None and isinstance(value, xarray.DataArray)
    return result and (axes is None or value.ndim == axes)


def has_coordinates(value: Any) -> bool:
    """Tell whether a value is a `DataArray`, a `Dataset`, or the coordinates of one.

    >>> has_coordinates({"delta": [0.5]})
    False
    """
    xarray = sys.modules.get("xarray")
    return xarray is not None and isinstance(
        value, (xarray.DataArray, xarray.Dataset, xarray.Coordinates)
    )


def unit_of_array(parameter: Parameter, unit: Any) -> str:
    """Return the unit that an attribute says."""
    unit = unit.strip() if isinstance(unit, str) else unit
    dimension = dimension_of(parameter.unit)
    if not isinstance(unit, str) or (dimension and unit in _NO_UNIT):
        why = f"is a DataArray of unit {shown(unit)}" if unit else "is a DataArray without a unit"
        known = ", ".join(units_of(dimension)) if dimension else NO_UNIT
        raise ParameterError(
            f"parameter '{parameter.name}' {why}; write one of {known} into .attrs['units']"
        )
    if unit in _NO_UNIT:
        return ""
    parameter.parse(f"1 {unit}")
    return unit


def in_base_units(parameter: Parameter, numbers: npt.NDArray[Any], unit: str) -> npt.NDArray[Any]:
    """Return numbers of a unit as the parameter has them."""
    if unit in ("", BASE_UNITS.get(dimension_of(parameter.unit))):
        return numbers.copy()
    known, is_real = UNITS.get(unit), numbers.dtype.kind == "f"
    doubles = numbers.astype(np.float64) if is_real else numbers
    if is_real and known is not None and not known.power:
        return doubles * known.size
    # The decimal point is moved in the number as it is written, which rounds once.
    results = [
        parameter.parse(f"{number} {unit}") if np.isfinite(number) else number
        for number in doubles.ravel().tolist()
    ]
    return np.array(results).reshape(numbers.shape)


def read_column(inputs: Inputs, column: TextColumn) -> AxisValues:
    """Return the values of a column; faults are told by the lines of their cells."""
    parameter = inputs.open[column.name]
    if lacking := missing_unit(column, parameter):
        raise ParameterError(f"{column.file}: {lacking}")

    def read(texts: Sequence[str]) -> AxisValues:
        result = read_entries(texts, parameter, "", inputs.uses)
        # Its range.
        inputs.numbers_for(column.name, result.given if len(texts) > 1 else result.given[0])
        return result

    try:
        return read(column.texts)
    except OptipathError as fault:
        message: list[str] = []
        for line, text in zip(column.lines, column.texts, strict=True):
            of_one: list[str] = []
            with collecting(of_one):
                read([text])
            message += [f"line {line}: {sentence}" for sentence in of_one]
        message = message or [*fault.faults]
    raise ParameterError(*[f"{column.file}: {sentence}" for sentence in first_of(message)])
