"""Ranges, lists and columns of files that are given by options: ``--delta 0:90:91``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import ParameterError, shown
from optipath.sweeps.sweep_axis import SweepAxis
from optipath.sweeps.sweep_grid import SweepGrid
from optipath.values.axis_texts import is_axis_text, read_axis_text
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter

RANGES = (
    "Several values: 0:90:91 (start:stop:count), 10,20,30, or @FILE.csv for a column of a file."
)
"""How an option takes more than one value, for help."""


def gives_axis(text: str) -> bool:
    """Tell whether the text of an option stands for several values.

    Examples
    --------
    >>> [gives_axis(text) for text in ("0:90:91", "10,20", "@angles.csv", "45 deg")]
    [True, True, True, False]
    """
    return is_axis_text(text)


def axis_given(parameter: Parameter, text: str) -> SweepAxis:
    """Return the axis that the text of an option stands for.

    Parameters
    ----------
    parameter : Parameter
        For which it is given; numbers without a unit are in its own.
    text : str
        A range, a list, or a file.

    Returns
    -------
    SweepAxis

    Raises
    ------
    OptipathError
        With all that is wrong.
    """
    # A bare number may be nanometres, micrometres or electronvolts.
    unit = "" if isinstance(parameter, Wavelength) else parameter.unit
    values = read_axis_text(text, parameter, unit)
    name = parameter.name
    return SweepAxis(name, name, values.shown, values.unit, values.given, parameter.help)


def refuse_axes(command: str, texts: Mapping[str, Sequence[str]], axes: Iterable[str]) -> None:
    """Raise where a command is given several values for a parameter, of which it takes one.

    Parameters
    ----------
    command : str
        Its name.
    texts : mapping of str to sequence of str
        What stands behind the option of each parameter.
    axes : iterable of str
        The parameters that are given several values.

    Raises
    ------
    ParameterError
        Naming each, and the commands that take them.
    """
    faults = [
        f"--{name.replace('_', '-')} is given several values, {shown(texts[name][-1])}, of which "
        f"{command} takes one; give one, or write 'optipath run' or 'optipath sweep'"
        for name in axes
    ]
    if faults:
        raise ParameterError(*faults)


def grid_of_axes(path: PathGraph, axes: Mapping[str, SweepAxis]) -> SweepGrid:
    """Return the grid of what is given several values for.

    Parameters
    ----------
    path : PathGraph
        Bound to what has one value.
    axes : mapping of str to SweepAxis
        By name.

    Returns
    -------
    SweepGrid

    Raises
    ------
    ParameterError
        If the path has arrays of its own, of which each value would go with one of an axis.
    """
    arrays = (
        []
        if not axes
        else [
            name
            for name, parameter in path.parameters.items()
            if name not in axes and isinstance(parameter.default, np.ndarray)
        ]
    )
    if arrays:
        raise ParameterError(
            *[
                f"parameter '{name}' has several values in the file; give one by "
                f"--{name.replace('_', '-')}, or a range"
                for name in arrays
            ]
        )
    return SweepGrid(tuple(axes.values()))
