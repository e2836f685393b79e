"""Ranges, lists and columns of files that are given by options: ``--delta 0:90:91``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import OptipathError, ParameterError, collecting, shown
from optipath.sweeps.grid import SweepGrid, sweep_axis
from optipath.values.text import read_axis_text
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter
    from optipath.values.text import AxisValues
    from optipath.values.use import Use


RANGES = (
    "Several values: 0:90:91 (start:stop:count), 10,20,30, or @FILE.csv for a column of a file."
)
"""How an option takes more than one value, for help."""


def axis_argument(parameter: Parameter, text: str, uses: Sequence[Use]) -> AxisValues | None:
    """Return the values that the text of an option stands for.

    >>> from optipath.values.parameters import Parameter
    >>> axis_argument(Parameter("delta", unit="deg"), "0:90:3", ()).shown.tolist()
    [0.0, 45.0, 90.0]
    """
    # A bare wavelength may be nanometres, micrometres or electronvolts; a file says its units.
    is_shown = isinstance(parameter, Wavelength) or text.lstrip().startswith("@")
    unit = "" if is_shown else parameter.unit
    try:
        return read_axis_text(text, parameter, unit, uses)
    except OptipathError as error:
        about = f"{error.about}: " if error.about else ""
        raise ParameterError(*[f"{about}{fault}" for fault in error.faults]) from None


def axis_faults(path: PathGraph, axes: Mapping[str, AxisValues]) -> list[str]:
    """Return what is wrong with the values of axes, a sentence each."""
    faults: list[str] = []
    for name, values in axes.items():
        if name in path.parameters:
            with collecting(faults):
                path.bind(**{name: values.given})
    return faults


def grid_of_axes(path: PathGraph, axes: Mapping[str, AxisValues]) -> SweepGrid:
    """Return the grid of what is given several values."""
    known = path.parameters if axes else {}
    return SweepGrid(tuple([sweep_axis(known, name, values) for name, values in axes.items()]))


def refuse_axes(command: str, texts: Mapping[str, Sequence[str]], axes: Iterable[str]) -> None:
    """Raise where a command is given several values for a parameter, of which it takes one."""
    faults = [
        f"--{name.replace('_', '-')} is given several values, {shown(texts[name][-1])}, of which "
        f"{command} takes one; give one, or write 'optipath run' or 'optipath sweep'"
        for name in axes
    ]
    if faults:
        raise ParameterError(*faults)


def refuse_arrays(path: PathGraph, axes: Collection[str]) -> None:
    """Raise where a path has arrays of its own, whose values would each go with one of an axis."""
    faults = [
        f"parameter '{name}' has several values in the file; give one by "
        f"--{name.replace('_', '-')}, or a range"
        for name, parameter in (path.parameters.items() if axes else ())
        if name not in axes and isinstance(parameter.default, np.ndarray)
    ]
    if faults:
        raise ParameterError(*faults)
