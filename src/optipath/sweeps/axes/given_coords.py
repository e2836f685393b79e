"""Axes that stand elsewhere: what ``coords=`` gives."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.errors import OptipathError, ParameterError, shown
from optipath.sweeps.axes.labelled_values import cure_of_table, has_coordinates
from optipath.sweeps.labels.variable_names import is_variable
from optipath.values.text_tables import columns_of

if TYPE_CHECKING:
    from optipath.values.inputs import Inputs

DETECTOR = "detector"
"""The dimension of several detectors in what a sweep returns."""

_ROWS = "point"
"""The dimension along which the columns of a file vary together."""


_OPENED = {
    ".nc": "xr.open_dataset",
    ".h5": "xr.open_dataset",
    ".zarr": "xr.open_zarr",
}
"""What reads the coordinates of files that are no tables."""


class GivenCoordinate(NamedTuple):
    """What is given for a parameter, and along which dimension."""

    value: Any
    dimension: str = ""


def given_coords(inputs: Inputs, coords: Any, faults: list[str]) -> dict[str, GivenCoordinate]:
    """Return what ``coords=`` gives, by name."""
    if coords is None:
        return {}
    try:
        if isinstance(coords, (str, PathLike)):
            return _of_file(inputs, coords, faults)
        if has_coordinates(coords):
            return _of_dataset(inputs, coords, faults)
    except OptipathError as fault:
        about = f"{fault.about}: " if fault.about else ""
        faults += [f"{about}{sentence}" for sentence in fault.faults]
        return {}
    if isinstance(coords, Mapping):
        return {str(name): GivenCoordinate(value) for name, value in coords.items()}
    name = next(iter(inputs.open), "delta")
    if cure_of_table(name, coords):
        faults.append(
            f"coords is a {type(coords).__name__}; give a CSV file, a Dataset, or columns by name: "
            f"{{'{name}': df['{name}'].to_numpy()}}, and zip= where they vary together"
        )
        return {}
    faults.append(
        f"coords is {shown(coords)}; give the name of a CSV file, a Dataset, or a mapping such as "
        f"{{'delta': [...]}}"
    )
    return {}


def _of_file(
    inputs: Inputs, path: str | PathLike[str], faults: list[str]
) -> dict[str, GivenCoordinate]:
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
    return {column.name: GivenCoordinate(column, dimension) for column in known}


def _of_dataset(inputs: Inputs, given: Any, faults: list[str]) -> dict[str, GivenCoordinate]:
    found = {}
    coords, order = getattr(given, "coords", given), _order_of_dimensions(given)
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
            found[str(name)] = GivenCoordinate(array, str(array.dims[0]) if array.dims else "")
    return found


def _order_of_dimensions(given: Any) -> list[Any]:
    """Return the dimensions, as data have them, and then as coordinates do."""
    data = [*given.data_vars.values()] if hasattr(given, "data_vars") else [given]
    data = sorted(
        (each for each in data if hasattr(each, "dims")), key=lambda each: -len(each.dims)
    )
    several = [*data, *getattr(given, "coords", given).values()]
    return list(dict.fromkeys(dimension for each in several for dimension in each.dims))


def _is_label(inputs: Inputs, coords: Any, name: Any) -> bool:
    """Tell whether a coordinate says what the points of a dimension are called, and no more."""
    return coords[name].dims == (name,) and any(
        other in inputs.open and array.dims == (name,) for other, array in coords.items()
    )
