"""Values with a unit: an `xarray.DataArray` whose attribute ``units`` says it."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, shown
from optipath.values.arrays.array_likes import as_given
from optipath.values.axis_texts import AxisValues, read_entries
from optipath.values.text_tables import NO_UNIT
from optipath.values.units import BASE_UNITS, UNITS, dimension_of, units_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy.typing as npt
    import xarray as xr

    from optipath.values.parameters import Parameter
    from optipath.values.use import Use

_NO_UNIT = ("", NO_UNIT, "dimensionless")


def is_labelled(value: Any, axes: int | None = None) -> bool:
    """Tell whether a value is a `DataArray`, without importing xarray.

    Examples
    --------
    >>> is_labelled([0.5])
    False
    """
    xarray = sys.modules.get("xarray")
    found = xarray is not None and isinstance(value, xarray.DataArray)
    return found and (axes is None or value.ndim == axes)


def has_coordinates(value: Any) -> bool:
    """Tell whether a value is a `DataArray`, a `Dataset`, or the coordinates of one.

    Examples
    --------
    >>> has_coordinates({"delta": [0.5]})
    False
    """
    xarray = sys.modules.get("xarray")
    return xarray is not None and isinstance(
        value, (xarray.DataArray, xarray.Dataset, xarray.Coordinates)
    )


def cure_of_table(name: str, value: Any) -> str:
    """Return what of a table is an axis; ``""`` for what is no table of several.

    Examples
    --------
    >>> cure_of_table("delta", [0.5])
    ''
    """
    if has_coordinates(value) and not is_labelled(value):
        return f"one of its coordinates, such as ds['{name}']"
    if hasattr(value, "columns") and hasattr(value, "to_numpy"):
        return f"one of its columns, such as df['{name}'].to_numpy()"
    return ""


def read_labelled(parameter: Parameter, array: xr.DataArray, uses: Iterable[Use]) -> AxisValues:
    """Return the values of an array with a unit.

    Units: the result in degrees.
    """
    numbers = as_given(f"parameter '{parameter.name}'", array.values, ParameterError)
    if numbers.dtype.kind in "UO":
        return read_entries(numbers.ravel().tolist(), parameter, "", uses).reshaped(numbers.shape)
    if numbers.dtype.kind not in "iufc":
        parameter.resolve(numbers)  # Which says what is wrong with it.
    numbers = numbers.astype(np.float64) if numbers.dtype.kind in "iu" else numbers.copy()
    unit = _unit_of(parameter, array.attrs.get("units", ""))
    return AxisValues(numbers, unit, _in_base_units(parameter, numbers, unit))


def _unit_of(parameter: Parameter, unit: Any) -> str:
    """Return the unit that an attribute says."""
    if not isinstance(unit, str):
        raise ParameterError(
            f"the unit of parameter '{parameter.name}' is {shown(unit)}; write a text into "
            f".attrs['units']"
        )
    dimension = dimension_of(parameter.unit)
    if unit.strip() in _NO_UNIT:
        if dimension:
            known = ", ".join(units_of(dimension))
            raise ParameterError(
                f"parameter '{parameter.name}' is a DataArray without a unit; write one of {known} "
                f"into .attrs['units']"
            )
        return ""
    parameter.parse(f"1 {unit.strip()}")
    return unit.strip()


def _in_base_units(parameter: Parameter, numbers: npt.NDArray[Any], unit: str) -> npt.NDArray[Any]:
    if unit in ("", BASE_UNITS.get(dimension_of(parameter.unit))):
        return numbers.copy()
    known, is_real = UNITS.get(unit), numbers.dtype.kind == "f"
    doubles = numbers.astype(np.float64) if is_real else numbers
    if is_real and known is not None and not known.power:
        return doubles * known.size
    # The decimal point is moved in the number as it is written, which rounds once.
    found = [
        parameter.parse(f"{number} {unit}") if np.isfinite(number) else number
        for number in doubles.ravel().tolist()
    ]
    return np.array(found).reshape(numbers.shape)
