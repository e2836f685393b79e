"""Coordinates, variables and attributes of a sweep's Dataset."""

from __future__ import annotations

from dataclasses import fields
from importlib.metadata import version
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np
import pandas as pd

from optipath.composer.composer import Composer
from optipath.errors import PathError, listed
from optipath.light.frame import Frame
from optipath.sweeps.labels import DETECTOR, detectors_of
from optipath.values.units import BASE_UNITS

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.quantities import LightQuantity
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.answers import Answers
    from optipath.plan.plan import Plan
    from optipath.sweeps.grid import SweepAxis, SweepGrid
    from optipath.values.parameters import Parameter


def dimensions_of(grid: SweepGrid, plan: Plan) -> tuple[str, ...]:
    """Return the dimensions of the variables: detectors, if there are several, and the axes."""
    front = (DETECTOR,) if len(detectors_of(plan)) > 1 else ()
    return (*front, *grid.sizes)


def coordinates_of(grid: SweepGrid, plan: Plan) -> dict[str, tuple[Any, Any, dict[str, str]]]:
    """Return a coordinate for every axis and every value that is fixed."""
    several = detectors_of(plan)
    results: dict[str, tuple[Any, Any, dict[str, str]]] = {}
    if len(several) > 1:
        attrs = {"long_name": "where the light is read"}
        results[DETECTOR] = DETECTOR, np.array(several, object), attrs
    for axis in grid.axes:
        attrs = _attrs(axis.help, axis.unit, axis.shown)
        results[axis.name] = axis.dimension, _labels(axis), attrs
    for name, parameter in plan.inputs.open.items():
        if name not in results:
            base = BASE_UNITS.get(plan.inputs.dimensions.get(name, ""), "")
            argument, unit = grid.labels.get(name, (grid.fixed.get(name, parameter.default), base))
            value = _single(parameter, argument)
            results[name] = (), value, _attrs(parameter.help, unit, value)
    return results


def attributes_of(quantity: LightQuantity) -> dict[str, str]:
    """Return the attributes of the variable of a quantity.

    >>> from optipath.light.quantities import DERIVED
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
    """Return the attributes of the Dataset of a sweep, texts and numbers.

    >>> import optipath as op
    >>> path = op.load_preset("malus")
    >>> attributes = dataset_attributes(path, path.compose())
    >>> attributes["method"], attributes["frame"]
    ('stable', 'eye: x = 1, 0, 0; y = 0, 1, 0; z = 0, 0, 1')
    """
    stored = _KEPT.get(plan.answers)
    words = path.description, dict(path.cases)
    if stored is None or stored[0] != words:
        stored = _KEPT[plan.answers] = words, _attributes(path, plan, composer or Composer())
    return dict(stored[1])


_KEPT: WeakKeyDictionary[Answers, tuple[Any, dict[str, str | float]]] = WeakKeyDictionary()
"""By what belongs to one plan alone; telling all of it takes longer than to run 1e6 points."""


def _attributes(path: PathGraph, plan: Plan, composer: Composer) -> dict[str, str | float]:
    options = {each.name: getattr(composer, each.name) for each in fields(Composer)}
    messages = {name: value for name, value in options.items() if name not in _UNREPORTED}
    return {
        "path": _toml(path),
        "explanation": plan.explain(),
        "optipath_version": version("optipath"),
        **{name: value for name, value in messages.items() if value is not None},
        "frame": "\n".join(f"{name}: {_axes(end.frame)}" for name, end in _ends(plan)),
        **_unread(plan),
    }


def _toml(path: PathGraph) -> str:
    try:
        return path.to_toml()
    except PathError as fault:
        return f"the path cannot be written here, since it has no form in TOML: {fault}"


def _ends(plan: Plan) -> Any:
    return plan.program.detectors.items()


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
    several = [(name, end.components) for name, end in _ends(plan) if end.components < 4]
    messages = [
        f"{listed(_COMPONENTS[count:])} at {name}, which reads {listed(_COMPONENTS[:count])}"
        for name, count in several
    ]
    return {"unread": f"NaN: {'; '.join(messages)}"} if messages else {}
