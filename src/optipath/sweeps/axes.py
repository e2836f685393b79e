"""Axes of a sweep, from its arguments, coordinates or columns of a file, and their faults."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import fields, replace
from os import PathLike
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import OptipathError, ParameterError
from optipath.faults import closest, did_you_mean, listed, no_value, shown
from optipath.paths.path_graph import PathGraph
from optipath.sweeps.datasets import DETECTOR, is_variable
from optipath.sweeps.grid import SweepAxis, SweepGrid, sweep_axis
from optipath.values.angles import CosSin
from optipath.values.arrays import as_argument, broadcast_fault, locked
from optipath.values.columns import NO_UNIT, TextColumn, columns_of, missing_unit
from optipath.values.jax_values import check_known, known
from optipath.values.text import AxisValues, IdleValues, read_axis_text, read_entries
from optipath.values.units import BASE_UNITS, UNITS, dimension_of, units_of

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    import numpy.typing as npt

    from optipath.plan.inputs import Inputs
    from optipath.values.parameters import Parameter

Given: TypeAlias = "dict[str, tuple[Any, str]]"
"""What is given for each parameter, and along which dimension, "" for one of its own."""


_SHORT = 16
"""How many times the values of all axes a grid has at least beside which they are few."""

_LARGE = 1 << 22
"""How many points a grid has at least whose run takes longer than to look at short axes twice."""


def grid_of(
    inputs: Inputs,
    arguments: Mapping[str, Any],
    zip: Any = (),  # noqa: A002 - as `path.sweep` has it
    coords: Any = None,
    *,
    ranges: bool = True,
) -> SweepGrid:
    """Return the grid of a sweep."""
    faults: list[str] = []
    besides = _coords_axes(inputs, coords, faults)
    faults += [
        f"'{name}' is given by its name, and in coords as well; leave one of them out"
        for name in arguments
        if name in besides
    ]
    several = {name: (value, "") for name, value in arguments.items()} | besides
    values = _read(inputs, several, faults)
    dimensions = {name: several[name][1] or name for name in values}
    several_values = {n: v.given for n, v in values.items() if v.given.ndim}
    own = {name: len(given) for name, given in several_values.items() if dimensions[name] == name}
    dimensions |= zipped_dimensions(zip, own, {*inputs.open, *values}, faults)
    along = {n: v.dims[0] for n, v in arguments.items() if _is_labelled(v) and v.ndim == 1}
    faults += shared_dimensions(along, dimensions)
    faults += [
        f"'{name}' is along the dimension '{dimension}', which is the name of a parameter with "
        f"another axis; rename the dimension, such as coords.rename_dims({dimension}='point')"
        for dimension, name in {dimensions[name]: name for name in several_values}.items()
        if dimension in inputs.open and dimensions.get(dimension) != dimension
    ]
    faults += unnamed_arrays(inputs, several)
    axes: list[SweepAxis] = []
    fixed: dict[str, Any] = {}
    labels: dict[str, tuple[Any, str]] = {}
    for name, value in values.items():
        numbers = value.given
        if numbers.ndim:
            axes.append(sweep_axis(inputs.open, name, value, dimensions[name]))
            continue
        fixed[name] = numbers.item() if numbers.dtype.char in "dDUO" else numbers[()]
        labels[name] = value.shown, value.unit
    grid = SweepGrid(tuple(axes), fixed, labels)
    is_short = max(_LARGE, _SHORT * sum(map(len, axes))) < grid.points
    ranges = ranges or bool(faults) or is_short
    faults += _axis_faults(inputs, grid, ranges=ranges)
    if not faults and ranges and inputs.computed:
        with OptipathError.collecting(faults):
            # Along the dimensions of what it follows from, and nothing is laid out.
            replace(inputs, agreements=(), for_complex=()).resolve(grid.given())
    ParameterError.raise_for(faults)
    # What has a unit besides says what it is.
    plain = {
        name: value
        for name, (value, _) in several.items()
        if not isinstance(value, TextColumn | AxisValues) and not _is_labelled(value)
    }
    inputs.warn_of_angles(plain)
    return grid


def _read(inputs: Inputs, several: Given, faults: list[str]) -> dict[str, AxisValues]:
    """Return the values of each parameter that there is, and that nothing is wrong with."""
    idle = {name for name, (value, _) in several.items() if isinstance(value, IdleValues)}
    faults += unknown_names(inputs, {n: v for n, (v, _) in several.items() if n not in idle})
    results = {}
    for name, (value, _) in several.items():
        if name in inputs.open or name in idle:
            with OptipathError.collecting(faults):
                if isinstance(value, AxisValues):
                    results[name] = value
                elif isinstance(value, TextColumn):
                    results[name] = _read_column(inputs, value)
                else:
                    results[name] = read_values(inputs, name, value)
    return results


def read_values(inputs: Inputs, name: str, value: Any) -> AxisValues:
    """Return what is given for a parameter. Units: value in radians."""
    if value is None:
        raise ParameterError(no_value(name))
    if inputs.tails.get(name):
        raise ParameterError(
            f"parameter '{name}' takes several numbers for one path, which no axis has; bind it, "
            f"by path.bind({name}=...), or leave out what sweeps it"
        )
    if isinstance(value, CosSin) or hasattr(value, "data_vars") or hasattr(value, "columns"):
        raise ParameterError(
            f"parameter '{name}' is a {type(value).__name__}, and an axis is of numbers; give an "
            f"angle itself, of a table one of its columns or coordinates, or all by coords="
        )
    check_known(f"parameter '{name}' of a sweep", value)
    parameter, labelled = inputs.open[name], _is_labelled(value)
    if isinstance(value, str):
        several = read_axis_text(value, parameter, "", inputs.uses)
        if several is not None:
            return several
    if not labelled:
        inputs.refuse_materials(name, value)
    numbers = value.values if labelled else known(value)
    array = as_argument(f"parameter '{name}'", numbers, ParameterError)
    if array.ndim > 1:
        raise ParameterError(
            f"parameter '{name}' has the shape {array.shape}, and an axis has one dimension; give "
            f"its values in a row, .ravel(), and zip=('{name}', ...) for parameters that vary "
            f"together"
        )
    if not array.size:
        raise ParameterError(f"parameter '{name}' has no values; give one at least")
    if array.dtype.kind in "UO":
        texts = read_entries(array.ravel().tolist(), parameter, "", inputs.uses)
        return texts.reshaped(array.shape)
    if array.dtype.kind not in "iufc":
        parameter.resolve(numbers)  # Which says what is wrong with it.
    array = array.astype(np.float64) if array.dtype.kind in "iu" else array.copy()
    if labelled:
        unit = _unit_of_array(parameter, value.attrs.get("units", ""))
        return AxisValues(array, unit, _in_base_units(parameter, array, unit))
    array = locked(array)
    return AxisValues(array, BASE_UNITS.get(dimension_of(parameter.unit), ""), array)


_AS = "zip=('a', 'b'), zip=[('a', 'b'), ('c', 'd')] or zip={'point': ('a', 'b')}"

_UNNAMED = "dim_0"
"""What xarray calls a dimension that nobody has named."""


def zipped_dimensions(
    zipped: Any, lengths: Mapping[str, int], parameters: Collection[str], faults: list[str]
) -> dict[str, str]:
    """Return the dimension of each parameter that varies together with others.

    >>> zipped_dimensions(("delta", "rho"), {"delta": 3, "rho": 3, "phi": 2}, [], [])
    {'delta': 'delta_rho', 'rho': 'delta_rho'}
    """
    if isinstance(zipped, Mapping):
        groups = [*zipped.items()]
    else:
        is_one = not isinstance(zipped, (list, tuple)) or all(isinstance(n, str) for n in zipped)
        groups = [("", each) for each in ([zipped] if is_one else zipped)] if zipped else []
    results: dict[str, str] = {}
    for given, names in groups:
        is_group = isinstance(names, (list, tuple)) and all(isinstance(n, str) for n in names)
        if not (is_group and len(names) > 1 and isinstance(given, str)):
            faults.append(f"zip is {shown(zipped)}, and a group is two names or more; write {_AS}")
            return {}
        dimension = given or "_".join(names)
        wrong = []
        for name in dict.fromkeys(names):
            if name not in lengths:
                meant = did_you_mean(name, lengths)
                wrong.append(f"zip names '{name}', which has no axis of its own{meant}")
            if name in results or names.count(name) > 1:
                wrong.append(f"zip names '{name}' twice; write it in one group, once")
        if dimension in parameters or dimension in results.values():
            wrong.append(
                f"zip calls a dimension '{dimension}', which is the name of a parameter or of "
                f"another; give it another, such as zip={{'point': {(*names,)}}}"
            )
        if not wrong and len({lengths[name] for name in names}) > 1:
            counted = listed([f"{lengths[name]} of '{name}'" for name in names])
            wrong.append(f"zip pairs values one by one, but there are {counted}; give as many each")
        faults += wrong
        results |= {} if wrong else dict.fromkeys(names, dimension)
    return results


def shared_dimensions(along: Mapping[str, Any], dimensions: Mapping[str, str]) -> list[str]:
    """Return what is wrong with arrays along one dimension that may or may not vary together."""
    faults = []
    for shared in dict.fromkeys(along.values()):
        names = [name for name in along if along[name] == shared]
        if len({dimensions.get(name, name) for name in names}) > 1 and shared != _UNNAMED:
            quoted = listed([f"'{name}'" for name in names])
            faults.append(
                f"{quoted} are all along '{shared}'; write zip={{'{shared}': {(*names,)}}} if they "
                f"vary together, or .rename({shared}='{names[-1]}') for all combinations"
            )
    return faults


KEYWORDS = frozenset(PathGraph.sweep.__kwdefaults__ or ())
"""What `PathGraph.sweep` takes by name beside parameters."""


def _axis_faults(inputs: Inputs, grid: SweepGrid, *, ranges: bool = True) -> list[str]:
    """Return what is wrong with values of a grid, each axis by itself."""
    faults = broadcast_fault({"a sweep": grid.shape})
    arguments = {**grid.fixed, **{axis.name: axis.given for axis in grid.axes if not axis.idle}}
    for name, value in arguments.items():
        uses = tuple([use for use in inputs.uses if use.value.name == name])
        with OptipathError.collecting(faults):
            if any(use.domain.takes_any for use in uses):
                inputs.open[name].resolve(value)  # No light is looked at that NaN comes from.
            if ranges:
                # As if there were no other parameters.
                own: dict[str, Any] = {"open": {name: inputs.open[name]}, "uses": uses}
                own |= dict.fromkeys(("known", "agreements", "for_complex", "computed"), ())
                replace(inputs, shapes={}, **own).resolve({name: value})
    return faults


def unnamed_arrays(inputs: Inputs, arguments: Collection[str]) -> list[str]:
    """Return what is wrong with a path that has arrays, of which no axis has the name."""
    faults = [
        f"{owner} has an array of shape {shape}, and no axis has its name; put a Parameter there, "
        f"and sweep it"
        for owner, shape in inputs.shapes.items()
        if shape
    ]
    for name, parameter in inputs.open.items():
        if name in arguments:
            continue
        if parameter.default is None and name in KEYWORDS:
            faults.append(
                f"parameter '{name}' has no value, and sweep has a keyword of that name; give it "
                f"by coords={{'{name}': ...}}"
            )
        elif parameter.default is None:
            faults.append(no_value(name))
        elif np.ndim(parameter.default) > len(inputs.tails.get(name, ())):
            faults.append(
                f"parameter '{name}' has an array of shape {np.shape(parameter.default)} by "
                f"default, which is no axis; give it, {name}=..., or one value"
            )
    return faults


_OPTIONS = frozenset(each.name for each in fields(Composer)) - {"keep"}
"""Of a composer, which is given besides and not composed by hand."""


def unknown_names(inputs: Inputs, arguments: Mapping[str, Any]) -> list[str]:
    """Return what is wrong with names that no parameter has."""
    unknown = [name for name in arguments if name not in inputs.open]
    chosen = {*inputs.open, *inputs.bound, *inputs.choices}
    options = [name for name in unknown if name in _OPTIONS and closest(name, chosen) is None]
    faults = [inputs.unknown(name) for name in unknown if name not in options]
    if options:
        names = listed([f"'{name}'" for name in options])
        are = "is no parameter" if len(options) == 1 else "are no parameters"
        written = ", ".join(f"{name}={shown(arguments[name])}" for name in options)
        faults.append(f"{names} {are} of the path; give composer=op.Composer({written})")
    return faults


_ROWS = "point"
"""The dimension along which the columns of a file vary together."""

_OPENED = {".nc": "xr.open_dataset", ".h5": "xr.open_dataset", ".zarr": "xr.open_zarr"}
"""What reads the coordinates of files that are no tables."""


def _coords_axes(inputs: Inputs, coords: Any, faults: list[str]) -> Given:
    """Return what ``coords=`` gives, by name."""
    if coords is None:
        return {}
    if isinstance(coords, Mapping) and not _is_labelled(coords, "Dataset", "Coordinates"):
        return {str(name): (value, "") for name, value in coords.items()}
    with OptipathError.collecting(faults), ParameterError.wrapping():
        if isinstance(coords, (str, PathLike)):
            return _of_file(inputs, coords, faults)
        if _is_labelled(coords, "Dataset", "Coordinates"):
            return _of_dataset(inputs, coords, faults)
        what = f"a {type(coords).__name__}" if hasattr(coords, "columns") else shown(coords)
        raise ParameterError(
            f"coords is {what}; give the name of a CSV file, a Dataset, or columns by name, such "
            f"as {{'delta': [...]}}, and zip= where they vary together"
        )
    return {}


def _of_file(inputs: Inputs, path: str | PathLike[str], faults: list[str]) -> Given:
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
    return {each.name: (each, dimension) for each in columns if each.name in inputs.open}


def _of_dataset(inputs: Inputs, argument: Any, faults: list[str]) -> Given:
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
            results[str(name)] = array, str(array.dims[0]) if array.dims else ""
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


def _is_labelled(value: Any, *others: str) -> bool:
    """Tell whether a value is a DataArray, or of another class of xarray, which is not imported."""
    xarray = sys.modules.get("xarray")
    return xarray is not None and any(
        isinstance(value, getattr(xarray, each)) for each in ("DataArray", *others)
    )


def _unit_of_array(parameter: Parameter, unit: Any) -> str:
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


def _in_base_units(parameter: Parameter, numbers: npt.NDArray[Any], unit: str) -> npt.NDArray[Any]:
    """Return numbers of a unit as the parameter has them."""
    if unit in ("", BASE_UNITS.get(dimension_of(parameter.unit))):
        return numbers.copy()
    known = UNITS.get(unit)
    if numbers.dtype.kind == "f":
        numbers = numbers.astype(np.float64)
        if known is not None and not known.power:
            return numbers * known.size
    # The decimal point is moved in the number as it is written, which rounds once.
    results = [
        parameter.parse(f"{number} {unit}") if np.isfinite(number) else number
        for number in numbers.ravel().tolist()
    ]
    return np.array(results).reshape(numbers.shape)


def _read_column(inputs: Inputs, column: TextColumn) -> AxisValues:
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
            with OptipathError.collecting(message, about=f"line {line}"):
                read([text])
        message = message or [*fault.faults]
    raise ParameterError(*[f"{column.file}: {sentence}" for sentence in message])
