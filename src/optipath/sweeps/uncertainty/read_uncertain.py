"""Values with uncertainties, out of what is given for a path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ParameterError, shown
from optipath.sweeps.uncertainty.uncertain_value import UncertainValue
from optipath.sweeps.unknown_names import unknown_names
from optipath.values.arrays.array_likes import array_of
from optipath.values.arrays.jax_values import check_known
from optipath.values.arrays.shapes import broadcast_fault, first_place
from optipath.values.domains.axis import axes_for
from optipath.values.materials import Material
from optipath.values.texts import numbers_for
from optipath.values.units import dimension_of, format_quantity, parse_quantity

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.inputs import Inputs

_PAIR = 2


def read_uncertain(
    inputs: Inputs, given: Mapping[str, Any]
) -> tuple[dict[str, Any], list[UncertainValue], list[str]]:
    """Return what is exact, what is uncertain, and what is wrong with either."""
    faults = unknown_names(inputs, given)
    known = {name: value for name, value in given.items() if name in inputs.open}
    exact = {name: value for name, value in known.items() if not isinstance(value, tuple)}
    uncertain: list[UncertainValue] = []
    for name, value in known.items():
        if name not in exact:
            try:
                uncertain.append(_read(inputs, name, value))
            except OptipathError as fault:
                faults += fault.faults
    if not any(isinstance(value, tuple) for value in given.values()):
        faults.append(
            "nothing that is given has an uncertainty; give a value and its standard uncertainty, "
            f"such as {_example(inputs)}"
        )
    values = {**exact, **{each.name: each.value for each in uncertain}}
    try:
        inputs.resolve(values)
    except OptipathError as fault:
        told = tuple([f"parameter '{n}' has no value" for n in given if n not in values])
        faults += [sentence for sentence in fault.faults if not sentence.startswith(told)]
    return exact, uncertain, faults


def _example(inputs: Inputs) -> str:
    if not inputs.open:
        return "delta=(0.8, 0.001), for a parameter of the path, which has none yet"
    return f"{next(iter(inputs.open))}=(0.8, 0.001)"


def _read(inputs: Inputs, name: str, given: tuple[Any, ...]) -> UncertainValue:
    if len(given) != _PAIR:
        raise ParameterError(
            f"parameter '{name}' is a tuple of {len(given)}; a value and its standard "
            f"uncertainty are two, and several values without one are a list or an array"
        )
    if inputs.tails.get(name):
        raise ParameterError(
            f"parameter '{name}' is of several numbers, which have no uncertainty here; give "
            f"them exactly, as a list or an array"
        )
    value, sigma = _value(inputs, name, given[0]), _sigma(inputs, name, given[1])
    shapes = {f"the values of '{name}'": value.shape, "their uncertainties": sigma.shape}
    if faults := broadcast_fault(shapes):
        raise ParameterError(*faults)
    value, sigma = np.broadcast_arrays(value, sigma)
    low, high = inputs.limits[name]
    return UncertainValue(name, value, sigma, low, high, inputs.open[name].unit)


def _value(inputs: Inputs, name: str, value: Any) -> Any:
    if isinstance(value, Material):
        raise ParameterError(
            f"parameter '{name}' is a Material, which has no one uncertainty; write "
            f"op.Material(op.Parameter('n'), op.Parameter('k')) in the path, and give n and k"
        )
    check_known(f"propagate({name}=...)", value)
    for use in inputs.uses:
        if use.value.name == name and (doubt := use.doubt(value)):
            raise ParameterError(doubt)
    value, present = inputs.numbers_for(name, axes_for(name, value, inputs.uses))
    if not np.all(present):
        raise ParameterError(
            f"parameter '{name}' is 'none', which takes an element out of the path and has no "
            f"uncertainty; give it without one, {name}='none'"
        )
    if np.iscomplexobj(value):
        raise ParameterError(
            f"parameter '{name}' is complex, and its parts have an uncertainty each; write "
            f"op.Material(op.Parameter('n'), op.Parameter('k')) in the path, and give n and k"
        )
    return np.asarray(value, np.float64)


def _sigma(inputs: Inputs, name: str, sigma: Any) -> Any:
    what, unit = f"the standard uncertainty of parameter '{name}'", inputs.open[name].unit
    check_known(what, sigma)
    dimension = inputs.dimensions.get(name, dimension_of(unit))
    numbers = numbers_for(what, sigma, lambda text: parse_quantity(text, dimension), ParameterError)
    array = array_of(what, numbers, ParameterError)
    if array.dtype.kind not in "iuf":
        kind = "complex" if array.dtype.kind == "c" else "no number"
        raise ParameterError(f"{what} is {kind}, {shown(sigma)}; give a number of 0 or more")
    if np.any(bad := ~(np.isfinite(array) & (array >= 0.0))):
        found = format_quantity(float(array[bad].ravel()[0]), unit)
        raise ParameterError(
            f"{what} is {found}{first_place(bad)}; give a finite number of 0 or more"
        )
    return array.astype(np.float64)
