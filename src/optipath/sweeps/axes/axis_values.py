"""What is given for one parameter of a sweep, as the values of an axis or as a single one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.sweeps.axes.labelled_values import cure_of_table, is_labelled, read_labelled
from optipath.values.angles import CosSin
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import check_known, known
from optipath.values.arrays.read_only import locked
from optipath.values.axis_texts import AxisValues, read_axis_text, read_entries
from optipath.values.cures import no_value
from optipath.values.units import BASE_UNITS, dimension_of

if TYPE_CHECKING:
    from optipath.values.inputs import Inputs


def read_values(inputs: Inputs, name: str, value: Any) -> AxisValues:
    """Return what is given for a parameter.

    Units: value in radians.
    """
    if value is None:
        raise ParameterError(no_value(name))
    if inputs.tails.get(name):
        raise ParameterError(
            f"parameter '{name}' takes several numbers for one path, which no axis has; bind it, "
            f"by path.bind({name}=...), or leave out what sweeps it"
        )
    if isinstance(value, CosSin):
        raise ParameterError(
            f"parameter '{name}' is a cosine and a sine, which no axis shows; give the angle"
        )
    if cure := cure_of_table(name, value):
        raise ParameterError(
            f"parameter '{name}' is a {type(value).__name__}; give {cure}, or all by coords="
        )
    check_known(f"parameter '{name}' of a sweep", value)
    parameter = inputs.open[name]
    if is_labelled(value):
        return _of_one_dimension(name, read_labelled(parameter, value, inputs.uses))
    if isinstance(value, str):
        several = read_axis_text(value, parameter, "", inputs.uses)
        if several is not None:
            return several
    inputs.ask_in_doubt(name, value)
    array = as_given(f"parameter '{name}'", known(value), ParameterError)
    if array.dtype.kind in "UO":
        _of_one_dimension(name, AxisValues(array, "", array))
        return read_entries(array.ravel().tolist(), parameter, "", inputs.uses).reshaped(
            array.shape
        )
    if array.dtype.kind not in "iufc":
        parameter.resolve(value)  # Which says what is wrong with it.
    array = locked(array.astype(np.float64) if array.dtype.kind in "iu" else array.copy())
    base = BASE_UNITS.get(dimension_of(parameter.unit), "")
    return _of_one_dimension(name, AxisValues(array, base, array))


def _of_one_dimension(name: str, found: AxisValues) -> AxisValues:
    shape = found.shown.shape
    if len(shape) > 1:
        raise ParameterError(
            f"parameter '{name}' has the shape {shape}, and an axis has one dimension; give its "
            f"values in a row, .ravel(), and zip=('{name}', ...) for parameters that vary together"
        )
    if 0 in shape:
        raise ParameterError(f"parameter '{name}' has no values; give one at least")
    return found
