"""Names, coordinates and attributes of a sweep's Dataset, and tables of it as text."""

from __future__ import annotations

import csv
from dataclasses import fields
from importlib.metadata import version
from io import StringIO
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import ParameterError, PathError
from optipath.faults import listed
from optipath.light.frame import Frame
from optipath.light.quantities import QUANTITIES
from optipath.plan.reading import pieces
from optipath.values.units import BASE_UNITS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    import numpy.typing as npt
    import xarray as xr

    from optipath.light.quantities import LightQuantity
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.answers import Answers
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepGrid
    from optipath.values.parameters import Parameter


DETECTOR = "detector"
"""The dimension of several detectors."""

CAPITALIZED = {"psi": "Psi", "delta": "Delta"}
"""What both ellipsometric angles are called where a parameter has the name of one."""


def is_variable(name: str) -> bool:
    """Tell whether a column of a file is called as a variable of a sweep."""
    own = {quantity.variable for quantity in QUANTITIES}
    return name.partition(" at ")[0] in {*own, *CAPITALIZED.values()}


def detectors_of(plan: Plan) -> tuple[str, ...]:
    """Return the names of the detectors of a plan; dumps are none."""
    return tuple(plan.program.detectors)


def variable_names(grid: SweepGrid, plan: Plan) -> dict[str, str]:
    """Return what the variable of each quantity is called."""
    taken = dict.fromkeys([*grid.sizes, *plan.inputs.open])
    other = CAPITALIZED if CAPITALIZED.keys() & taken.keys() else {}
    names = {each.variable: other.get(each.variable, each.variable) for each in QUANTITIES}
    own = dict.fromkeys(names.values(), "variable")
    own |= {DETECTOR: "dimension"} if len(detectors_of(plan)) > 1 else {}
    ParameterError.raise_for(
        f"'{name}' is what a sweep calls a {own[name]} of its own; give the parameter or dimension "
        f"another name, such as '{name}_'"
        for name in taken
        if name in own
    )
    return names


_ROWS = 1 << 16
"""How many rows are computed at once."""


def heading(name: str, unit: str) -> str:
    """Return the heading of a column, with the unit of its numbers.

    >>> heading("delta", "deg"), heading("n1", "")
    ('delta (deg)', 'n1')
    """
    return f"{name} ({unit})" if unit else name


def regions(shape: Sequence[int], most: int = _ROWS) -> Iterator[tuple[slice, ...]]:
    """Yield parts of a grid in the order of its points.

    >>> [[(cut.start, cut.stop) for cut in region] for region in regions((2, 3), 2)]
    [[(0, 1), (0, 2)], [(0, 1), (2, 3)], [(1, 2), (0, 2)], [(1, 2), (2, 3)]]
    """
    for piece in pieces(tuple(shape), most):
        cuts = [each if isinstance(each, slice) else slice(each, each + 1) for each in piece.where]
        yield (*cuts, *[slice(0, size) for size in shape[len(cuts) :]])


def csv_parts(plan: Plan, grid: SweepGrid) -> Iterator[str]:
    """Yield a sweep as CSV, part by part: a line of headings, and one for each point."""
    names, ends = variable_names(grid, plan), detectors_of(plan)
    at = [f" at {end}" for end in ends] if len(ends) > 1 else [""]
    heads = [heading(axis.name, axis.unit) for axis in grid.axes]
    heads += [heading(names[e.variable] + place, e.shown_unit) for place in at for e in QUANTITIES]
    yield _csv([heads])
    for region in regions(grid.shape):
        part = grid.part(region)
        columns = []
        for axis in part.axes:
            behind = len(part.shape) - 1 - [*part.sizes].index(axis.dimension)
            columns.append(axis.shown.reshape(-1, *(1,) * behind))
        lights = plan.run_all(**part.given())
        columns += [each.shown_of(lights[end]) + 0.0 for end in ends for each in QUANTITIES]
        laid_out = [np.broadcast_to(column, part.shape).ravel().tolist() for column in columns]
        yield _csv(zip(*laid_out, strict=True))


def _csv(rows: Iterable[Iterable[Any]]) -> str:
    text = StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def sweep_dataset(
    path: PathGraph,
    plan: Plan,
    grid: SweepGrid,
    composer: Composer | None,
    data: Callable[[], Mapping[str, Any]],
) -> xr.Dataset:
    """Return the Dataset of a sweep; all is checked before the data of its variables are made."""
    import pandas as pd  # noqa: PLC0415 - not for tables
    import xarray as xr  # noqa: PLC0415
    from xarray.indexes import PandasIndex  # noqa: PLC0415

    names, coords = variable_names(grid, plan), coordinates_of(grid, plan)
    dims = (*[DETECTOR] * (len(detectors_of(plan)) > 1), *grid.sizes)
    found, indexes = data(), {}
    variables: dict[str, Any] = {
        names[each.variable]: (dims, found[each.variable], attributes_of(each))
        for each in QUANTITIES
    }
    light = [*variables]
    for name, (dimension, values, attrs) in coords.items():
        variables[name] = variable = xr.Variable(dimension, values, attrs, fastpath=True)
        if dimension == name:
            # By default pandas copies what may be a long axis.
            is_double = values.dtype == np.float64
            labels = pd.Index(values, copy=False) if is_double else values
            indexes[name] = PandasIndex(labels, name, values.dtype)
            variables |= indexes[name].create_variables({name: variable})
    # With indexes of one's own nothing is merged, which takes longer than a short run.
    result = xr.Coordinates(variables, indexes).to_dataset().reset_coords(light)
    result.attrs.update(dataset_attributes(path, plan, composer))
    return result


def coordinates_of(grid: SweepGrid, plan: Plan) -> dict[str, tuple[Any, Any, dict[str, str]]]:
    """Return a coordinate for every axis and every value that is fixed."""
    several = detectors_of(plan)
    results: dict[str, tuple[Any, Any, dict[str, str]]] = {}
    if len(several) > 1:
        attrs = {"long_name": "where the light is read"}
        results[DETECTOR] = DETECTOR, np.array(several, object), attrs
    for axis in grid.axes:
        attrs = _attrs(axis.help, axis.unit, axis.shown)
        results[axis.name] = axis.dimension, _for_files(axis.shown), attrs
    for name, parameter in plan.inputs.open.items():
        if name not in results:
            base = BASE_UNITS.get(plan.inputs.dimensions.get(name, ""), "")
            argument, unit = grid.labels.get(name, (grid.fixed.get(name, parameter.default), base))
            value = _single(parameter, argument)
            results[name] = (), value, _attrs(parameter.help, unit, value)
    return results


def attributes_of(quantity: LightQuantity) -> dict[str, str]:
    """Return the attributes of the variable of a quantity."""
    unit = {"units": quantity.unit} if quantity.unit else {}
    return {"long_name": quantity.name, **unit}


def _attrs(name: str, unit: str, value: Any) -> dict[str, str]:
    is_number = np.asarray(value).dtype.kind in "fiu"
    message = {"long_name": name} if name else {}
    return message | ({"units": unit or "1"} if is_number else {})


def _single(parameter: Parameter, value: Any) -> Any:
    """Return a value that is fixed as an array without axes: a number, or a text."""
    if isinstance(value, str) and not value[:1].isalpha():
        value = parameter.resolve(value).value
    numbers = np.asarray(float(value) if type(value) is int else value)
    is_number = numbers.dtype.kind in "fiu" and not numbers.ndim
    return numbers if is_number else _for_files(str(value))


def _for_files(values: Any) -> npt.NDArray[Any]:
    """Return numbers as they are, and texts as they come back from files: Zarr has no others."""
    argument = np.asarray(values)
    return argument.astype(object) if argument.dtype.kind == "U" else argument


_COMPONENTS = ("S0", "S1", "S2", "S3")
_UNREPORTED = ("threads", "keep")


def dataset_attributes(
    path: PathGraph, plan: Plan, composer: Composer | None = None
) -> dict[str, str | float]:
    """Return the attributes of the Dataset of a sweep, texts and numbers."""
    stored = _KEPT.get(plan.answers)
    words = path.description, dict(path.cases)
    if stored is None or stored[0] != words:
        stored = _KEPT[plan.answers] = words, _attributes(path, plan, composer or Composer())
    return dict(stored[1])


_KEPT: WeakKeyDictionary[Answers, tuple[Any, dict[str, str | float]]] = WeakKeyDictionary()
"""By what belongs to one plan alone; telling all of it takes longer than to run 1e6 points."""


def _attributes(path: PathGraph, plan: Plan, composer: Composer) -> dict[str, str | float]:
    options = {each.name: getattr(composer, each.name) for each in fields(Composer)}
    for name in _UNREPORTED:
        del options[name]
    ends = plan.program.detectors.items()
    return {
        "path": _toml(path),
        "explanation": plan.explain(),
        "optipath_version": version("optipath"),
        **{name: value for name, value in options.items() if value is not None},
        "frame": "\n".join(f"{name}: {_axes(end.frame)}" for name, end in ends),
        **_unread(plan),
    }


def _toml(path: PathGraph) -> str:
    try:
        return path.to_toml()
    except PathError as fault:
        return f"the path cannot be written here, since it has no form in TOML: {fault}"


def _axes(frame: Any) -> str:
    if not isinstance(frame, Frame) or frame.z.ndim > 1:
        return "depends on the values"
    axes = {name: getattr(frame, name).tolist() for name in "xyz"}
    return "; ".join(f"{name} = {', '.join(map(_short, axis))}" for name, axis in axes.items())


def _short(number: float) -> str:
    """Return a number with all its digits, and without a point where it is whole."""
    return repr(number + 0.0).removesuffix(".0")


def _unread(plan: Plan) -> dict[str, str]:
    """Return a sentence of the components that detectors do not read, if there are any."""
    messages = [
        f"{listed(_COMPONENTS[each.components :])} at {name}, which reads "
        f"{listed(_COMPONENTS[: each.components])}"
        for name, each in plan.program.detectors.items()
        if each.components < len(_COMPONENTS)
    ]
    return {"unread": f"NaN: {'; '.join(messages)}"} if messages else {}
