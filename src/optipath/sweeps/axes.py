"""Axes of a sweep, from its arguments, and their faults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import (
    ParameterError,
    closest,
    collecting,
    did_you_mean,
    listed,
    no_value,
    shown,
)
from optipath.paths.path_graph import PathGraph
from optipath.plan.inputs import LargeAngles
from optipath.sweeps.coords import (
    CoordinateArgument,
    coords_axes,
    has_coordinates,
    in_base_units,
    is_labelled,
    read_column,
    unit_of_array,
)
from optipath.sweeps.grid import SweepAxis, SweepGrid, sweep_axis
from optipath.values.angles import CosSin
from optipath.values.arrays import as_argument, broadcast_fault, locked
from optipath.values.columns import TextColumn
from optipath.values.jax_values import check_known, known
from optipath.values.text import AxisValues, IdleValues, read_axis_text, read_entries
from optipath.values.units import BASE_UNITS, dimension_of

if TYPE_CHECKING:
    from collections.abc import Collection

    from optipath.plan.inputs import Inputs


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
    besides = coords_axes(inputs, coords, faults)
    twice = [name for name in arguments if name in besides]
    drop = f", such as coords.drop_vars({twice})" if has_coordinates(coords) else ""
    faults += [
        f"'{name}' is given by its name, and in coords as well; leave one of them out{drop}"
        for name in twice
    ]
    several = {name: CoordinateArgument(value) for name, value in arguments.items()} | besides
    values = _read(inputs, several, faults)
    dimensions = {name: several[name].dimension or name for name in values}
    own = {n: len(v.given) for n, v in values.items() if v.given.ndim and dimensions[n] == n}
    dimensions |= zipped_dimensions(zip, own, {*inputs.open, *values}, faults)
    along = {name: value.dims[0] for name, value in arguments.items() if is_labelled(value, axes=1)}
    faults += shared_dimensions(along, dimensions)
    faults += _named_as_others(dimensions, values, inputs)
    faults += unnamed_arrays(inputs, several)
    axes: list[SweepAxis] = []
    fixed: dict[str, Any] = {}
    labels: dict[str, tuple[Any, str]] = {}
    for name, value in values.items():
        numbers = value.given
        if numbers.ndim:
            axes.append(sweep_axis(inputs.open, name, value, dimensions[name]))
        else:
            fixed[name] = numbers.item() if numbers.dtype.char in "dDUO" else numbers[()]
            labels[name] = value.shown, value.unit
    grid = SweepGrid(tuple(axes), fixed, labels)
    is_short = max(_LARGE, _SHORT * sum(map(len, axes))) < grid.points
    ranges = ranges or bool(faults) or is_short
    faults += _axis_faults(inputs, grid, ranges=ranges)
    if not faults and ranges and inputs.computed:
        with collecting(faults):
            # Along the dimensions of what it follows from, and nothing is laid out.
            replace(inputs, agreements=(), for_complex=()).resolve(grid.given())
    if faults:
        raise ParameterError(*dict.fromkeys(faults))
    # What has a unit besides says what it is.
    plain = {
        name: given.value
        for name, given in several.items()
        if not isinstance(given.value, TextColumn | AxisValues) and not is_labelled(given.value)
    }
    LargeAngles(inputs).look(plain)
    return grid


def _read(
    inputs: Inputs, several: Mapping[str, CoordinateArgument], faults: list[str]
) -> dict[str, AxisValues]:
    """Return the values of each parameter that there is, and that nothing is wrong with."""
    idle = {name for name, each in several.items() if isinstance(each.value, IdleValues)}
    faults += unknown_names(inputs, {n: g.value for n, g in several.items() if n not in idle})
    results = {}
    for name, (value, _) in several.items():
        if name in inputs.open or name in idle:
            with collecting(faults):
                if isinstance(value, AxisValues):
                    results[name] = value
                elif isinstance(value, TextColumn):
                    results[name] = read_column(inputs, value)
                else:
                    results[name] = read_values(inputs, name, value)
    return results


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


def read_values(inputs: Inputs, name: str, value: Any) -> AxisValues:
    """Return what is given for a parameter. Units: value in radians."""
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
    if hasattr(value, "data_vars") or hasattr(value, "columns"):
        raise ParameterError(
            f"parameter '{name}' is a {type(value).__name__}; give the numbers of one of its "
            f"columns or coordinates, or all by coords="
        )
    check_known(f"parameter '{name}' of a sweep", value)
    parameter, labelled = inputs.open[name], is_labelled(value)
    if isinstance(value, str):
        several = read_axis_text(value, parameter, "", inputs.uses)
        if several is not None:
            return several
    if not labelled:
        inputs.refuse_materials(name, value)
    numbers = value.values if labelled else known(value)
    array = as_argument(f"parameter '{name}'", numbers, ParameterError)
    _check_one_dimension(name, array.shape)
    if array.dtype.kind in "UO":
        texts = read_entries(array.ravel().tolist(), parameter, "", inputs.uses)
        return texts.reshaped(array.shape)
    if array.dtype.kind not in "iufc":
        parameter.resolve(numbers)  # Which says what is wrong with it.
    array = array.astype(np.float64) if array.dtype.kind in "iu" else array.copy()
    if labelled:
        unit = unit_of_array(parameter, value.attrs.get("units", ""))
        return AxisValues(array, unit, in_base_units(parameter, array, unit))
    array = locked(array)
    return AxisValues(array, BASE_UNITS.get(dimension_of(parameter.unit), ""), array)


def _check_one_dimension(name: str, shape: tuple[int, ...]) -> None:
    if len(shape) > 1:
        raise ParameterError(
            f"parameter '{name}' has the shape {shape}, and an axis has one dimension; give its "
            f"values in a row, .ravel(), and zip=('{name}', ...) for parameters that vary together"
        )
    if 0 in shape:
        raise ParameterError(f"parameter '{name}' has no values; give one at least")


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
    several = zipped or ()
    if isinstance(several, (list, tuple)) and several and all(isinstance(n, str) for n in several):
        several = [several]
    groups = several.items() if isinstance(several, Mapping) else [("", each) for each in several]
    results: dict[str, str] = {}
    for given, names in groups:
        is_group = isinstance(names, (list, tuple)) and all(isinstance(n, str) for n in names)
        if not (is_group and len(names) > 1 and isinstance(given, str)):
            faults.append(f"zip is {shown(zipped)}, and a group is two names or more; write {_AS}")
            return {}
        dimension = given or "_".join(names)
        wrong = [
            f"zip names '{name}', which has no axis of its own{did_you_mean(name, lengths)}"
            for name in names
            if name not in lengths
        ]
        wrong += [
            f"zip names '{name}' twice; write it in one group, once"
            for name in dict.fromkeys(names)
            if name in results or names.count(name) > 1
        ]
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
    """Return what is wrong with arrays along one dimension that may or may not vary together.

    >>> shared_dimensions({"a": "x", "b": "x"}, {"a": "a_b", "b": "a_b"})
    []
    """
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
        with collecting(faults):
            if any(use.domain.takes_any for use in uses):
                inputs.open[name].resolve(value)  # No light is looked at that NaN comes from.
            if ranges:
                # As if there were no other parameters.
                alone = replace(
                    inputs,
                    open={name: inputs.open[name]},
                    uses=uses,
                    shapes={},
                    known=(),
                    agreements=(),
                    for_complex=(),
                    computed=(),
                )
                alone.resolve({name: value})
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
    """Return what is wrong with names that no parameter has.

    >>> import optipath as op
    >>> inputs = op.load_preset("malus").compose().inputs
    >>> unknown_names(inputs, {"engine": "numba", "dtype": "float32"})
    ["'engine' and 'dtype' are no parameters of the path; give \
composer=op.Composer(engine='numba', dtype='float32')"]
    """
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
