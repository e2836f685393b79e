"""The usual range of a parameter: what a curve or a slider goes over where nobody says."""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import ParameterError
from optipath.values.units import dimension_of, in_unit, parse_quantity
from optipath.values.use import AxisDomain, axes_for
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use


VISIBLE = 380e-9, 780e-9
"""The wavelengths that are seen, in metres."""

_AXES = (0.0, math.pi), (-math.pi / 2, math.pi / 2)
_TURNS = (0.0, 2 * math.pi), (-math.pi, math.pi)
_INDEX = 1.0, 3.0
_WIDEST = 10.0
"""How many times as wide as what is given a range may be that is taken as it is."""

_MOST = sys.float_info.max
_ROUND = 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0


def usual_range(path: PathGraph, name: str) -> tuple[float, float]:
    """Return between which values a parameter is usually looked at.

    It has the default and all cases within allowed values: visible light, a half turn of an axis,
    an index from 1 to 3, an incidence to 90 degrees, twice the largest value of an open range.

    >>> import optipath as op
    >>> path = op.load_preset("glass-slab")
    >>> usual_range(path, "n"), usual_range(path, "intensity")
    ((1.0, 3.0), (0.0, 2.0))
    """
    inputs = path.compose().inputs
    if name not in inputs.open:
        raise ParameterError(inputs.unknown(name))
    parameter, limits = inputs.open[name], inputs.limits[name]
    if inputs.tails.get(name):
        raise ParameterError(f"parameter '{name}' is an array; a range is one of single numbers")
    uses = [use for use in inputs.uses if use.value.name == name]
    seen = [*_seen(path, parameter, uses)]
    names = {use.domain.name for use in uses}
    if isinstance(parameter, Wavelength) or "wavelength" in names:
        low, high = _of_light(seen, limits)
    elif "angle" in {use.domain.dimension for use in uses}:
        is_axis = any(isinstance(use.domain, AxisDomain) for use in uses)
        low, high = _of_angles(seen, limits, is_axis=is_axis)
    elif "index of refraction" in names:
        low, high = _of_index(seen)
    else:
        low, high = _of_sizes(seen, parameter, limits)
    low, high = max(low, limits[0]), min(high, limits[1])
    if not low < high:
        low, high = _between(parameter, limits)
    most = min(_MOST, _MOST / in_unit(1.0, parameter.unit))
    low, high = max(low, -most), min(high, most)
    return (low, high) if math.isfinite(high - low) else (low / 2, high / 2)


def _between(parameter: Parameter, limits: tuple[float, float]) -> tuple[float, float]:
    """Return the limits themselves where nothing usual lies between them, as far as they go."""
    low, high = limits
    if low == high:
        raise ParameterError(f"parameter '{parameter.name}' has one value alone, and no range")
    one = _in_base_unit(1.0, parameter)
    if math.isinf(low):
        low = high - max(one, abs(high))
    return low, high if math.isfinite(high) else low + max(one, abs(low))


def _seen(path: PathGraph, parameter: Parameter, uses: list[Use]) -> Iterable[float]:
    """Go through the numbers that the default and the cases have."""
    name = parameter.name
    arguments = [parameter.default, *(case.values.get(name) for case in path.cases.values())]
    for value in arguments:
        if value is None:
            continue
        value = axes_for(name, value, uses)  # noqa: PLW2901 - the same, as a number
        resolved = parameter.resolve(value)
        numbers = np.atleast_1d(resolved.value)[np.atleast_1d(resolved.present)]
        if numbers.dtype.kind == "c":
            cure = "give the values, or n and k by parameters of their own"
            raise ParameterError(f"parameter '{name}' has the complex value {numbers[0]:g}; {cure}")
        yield from numbers[np.isfinite(numbers)].tolist()


def _of_light(seen: list[float], limits: tuple[float, float]) -> tuple[float, float]:
    low, high = max(VISIBLE[0], limits[0]), min(VISIBLE[1], limits[1])
    if low < high and (not seen or any(low <= each <= high for each in seen)):
        return min([low, *seen]), max([high, *seen])
    return (min(seen) / 1.5, max(seen) * 1.5) if seen else limits


def _of_angles(
    seen: list[float], limits: tuple[float, float], *, is_axis: bool
) -> tuple[float, float]:
    if limits[1] - limits[0] <= math.pi:
        return limits
    for low, high in (*(_AXES if is_axis else ()), *_TURNS):
        if all(low <= each <= high for each in seen):
            return low, high
    return min(0.0, *seen), max(2 * math.pi, *seen)


def _of_index(seen: list[float]) -> tuple[float, float]:
    low, high = _INDEX
    if seen and (least := min(seen)) < low:
        low = 10.0 ** math.floor(math.log10(least)) if least > 0.0 else 2 * least
    return low, max(high, _rounded_up(max(seen, default=0.0)))


def _of_sizes(
    seen: list[float], parameter: Parameter, limits: tuple[float, float]
) -> tuple[float, float]:
    one = _in_base_unit(1.0, parameter)
    largest = max(map(abs, seen), default=0.0)
    widest = max(map(abs, limits))
    # Of a pure number, as a share, the whole is seen; one of a unit says nothing about sizes.
    enough = max(_WIDEST * largest, 0.0 if parameter.unit else one)
    if math.isfinite(widest) and (not largest or widest <= enough):
        return limits
    end = _in_base_unit(_rounded_up(2 * in_unit(largest, parameter.unit)), parameter) or one
    return (-end if limits[0] < 0.0 else 0.0), end


def _in_base_unit(number: float, parameter: Parameter) -> float:
    """Return a number in the unit of a parameter in base units, as a text of it would be read."""
    return float(parse_quantity(repr(number), dimension_of(parameter.unit), parameter.unit).real)


def _rounded_up(number: float) -> float:
    """Return the next round number, or the largest float."""
    if not number:
        return 0.0
    power = 10.0 ** math.floor(math.log10(min(number, _MOST)))
    factor = next((each for each in _ROUND if number <= each * power * (1 + 1e-9)), 10.0)
    return min(factor * power, _MOST)
