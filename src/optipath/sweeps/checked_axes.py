"""Faults of the axes of a sweep, and names that no parameter has."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.composer import Composer
from optipath.errors import closest, collecting, listed, shown
from optipath.paths.path_graph import PathGraph
from optipath.values.arrays import broadcast_fault
from optipath.values.messages import no_value

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from optipath.plan.inputs import Inputs
    from optipath.sweeps.grid import SweepGrid
    from optipath.values.use import Use


KEYWORDS = frozenset(PathGraph.sweep.__kwdefaults__ or ())
"""What `PathGraph.sweep` takes by name beside parameters."""


def axis_faults(inputs: Inputs, grid: SweepGrid, *, ranges: bool = True) -> list[str]:
    """Return what is wrong with values of a grid, each axis looked at by itself.

    What combinations of values do not fit together is found when they are run.
    """
    faults = broadcast_fault({"a sweep": grid.shape})
    arguments = {**grid.fixed, **{axis.name: axis.given for axis in grid.axes if not axis.idle}}
    for name, value in arguments.items():
        uses = tuple([use for use in inputs.uses if use.value.name == name])
        with collecting(faults):
            if any(use.domain.takes_any for use in uses):
                inputs.open[name].resolve(value)  # No light is looked at that NaN comes from.
            if ranges:
                _alone(inputs, name, uses).resolve({name: value})
    return faults


def computed_faults(inputs: Inputs, grid: SweepGrid) -> list[str]:
    """Return what is wrong with what follows from values of a grid, each of which is well."""
    if not inputs.computed:
        return []
    faults: list[str] = []
    with collecting(faults):
        # Along the dimensions of what it follows from, and nothing is laid out.
        replace(inputs, agreements=(), for_complex=()).resolve(grid.given())
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


def _alone(inputs: Inputs, name: str, uses: tuple[Use, ...]) -> Inputs:
    """Return what may be given for one parameter, as if there were no others."""
    return replace(
        inputs,
        open={name: inputs.open[name]},
        uses=uses,
        shapes={},
        known=(),
        agreements=(),
        for_complex=(),
        computed=(),
    )


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
