"""The labels of a sweep's Dataset: coordinates with units, and what variables are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from optipath.sweeps.labels.variable_names import DETECTOR, detectors_of
from optipath.values.units import BASE_UNITS

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_axis import SweepAxis
    from optipath.sweeps.axes.sweep_grid import SweepGrid
    from optipath.sweeps.labels.light_quantities import LightQuantity
    from optipath.values.parameters import Parameter


def dimensions_of(grid: SweepGrid, plan: Plan) -> tuple[str, ...]:
    """Return the dimensions of the variables: detectors, if there are several, and the axes."""
    front = (DETECTOR,) if len(detectors_of(plan)) > 1 else ()
    return (*front, *grid.sizes)


def coordinates_of(grid: SweepGrid, plan: Plan) -> dict[str, tuple[Any, Any, dict[str, str]]]:
    """Return a coordinate for every axis and every value that is fixed."""
    several = detectors_of(plan)
    found: dict[str, tuple[Any, Any, dict[str, str]]] = {}
    if len(several) > 1:
        attrs = {"long_name": "where the light is read"}
        found[DETECTOR] = DETECTOR, np.array(several, object), attrs
    for axis in grid.axes:
        attrs = _attrs(axis.help, axis.unit, axis.shown)
        found[axis.name] = axis.dimension, _labels(axis), attrs
    for name, parameter in plan.inputs.open.items():
        if name not in found:
            base = BASE_UNITS.get(plan.inputs.dimensions.get(name, ""), "")
            given, unit = grid.labels.get(name, (grid.fixed.get(name, parameter.default), base))
            value = _single(parameter, given)
            found[name] = (), value, _attrs(parameter.help, unit, value)
    return found


def attributes_of(quantity: LightQuantity) -> dict[str, str]:
    """Return the attributes of the variable of a quantity.

    Examples
    --------
    >>> from optipath.sweeps.labels.light_quantities import DERIVED
    >>> attributes_of(DERIVED[0])
    {'long_name': 'degree of polarisation', 'units': '1'}
    """
    unit = {"units": quantity.unit} if quantity.unit else {}
    return {"long_name": quantity.name, **unit}


def _labels(axis: SweepAxis) -> Any:
    values = _for_files(axis.shown)
    if axis.name != axis.dimension or values.dtype != np.float64:
        return values
    return pd.Index(values, copy=False)  # By default pandas copies what may be a long axis.


def _attrs(name: str, unit: str, value: Any) -> dict[str, str]:
    is_number = np.asarray(value).dtype.kind in "fiu"
    told = {"long_name": name} if name else {}
    return told | ({"units": unit or "1"} if is_number else {})


def _single(parameter: Parameter, value: Any) -> Any:
    """Return a value that is fixed as an array without axes: a number, or a text."""
    if isinstance(value, str) and not value[:1].isalpha():
        value = parameter.resolve(value).value
    numbers = np.asarray(float(value) if type(value) is int else value)
    is_number = numbers.dtype.kind in "fiu" and not numbers.ndim
    return numbers if is_number else _for_files(str(value))


def _for_files(values: Any) -> npt.NDArray[Any]:
    """Return numbers as they are, and texts as they come back from files: Zarr has no others."""
    given = np.asarray(values)
    return given.astype(object) if given.dtype.kind == "U" else given
