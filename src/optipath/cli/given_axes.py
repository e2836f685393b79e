"""Ranges, lists and columns of files that are given by options: ``--delta 0:90:91``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.composer.path_values import Values
from optipath.errors import OptipathError, ParameterError, shown
from optipath.sweeps.read_axes import grid_of
from optipath.values.axis_names import AXES
from optipath.values.several_texts import several_texts
from optipath.values.units import unit_of
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter

RANGES = (
    "Several values: 0:90:91 (start:stop:count), 10,20,30, or @FILE.csv for a column of a file."
)
"""How an option takes more than one value, for help."""


def axis_texts(parameter: Parameter, text: str) -> list[str] | None:
    """Return the texts of the values that the text of an option stands for, with their units.

    Parameters
    ----------
    parameter : Parameter
        For which it is given; numbers without a unit are in its own.
    text : str
        A range, a list, or a file.

    Returns
    -------
    list of str or None
        None for a single value.

    Raises
    ------
    ParameterError
        With all that is wrong.

    Examples
    --------
    >>> from optipath.values.parameters import Parameter
    >>> axis_texts(Parameter("delta", unit="deg"), "0:90:3")
    ['0 deg', '45.0 deg', '90 deg']
    """
    try:
        texts = several_texts(parameter, text)
    except OptipathError as error:
        about = f"{error.about}: " if error.about else ""
        raise ParameterError(*[f"{about}{fault}" for fault in error.faults]) from None
    # A bare number may be nanometres, micrometres or electronvolts.
    if texts is None or isinstance(parameter, Wavelength) or not parameter.unit:
        return texts
    return [f"{each} {parameter.unit}" if is_bare(each) else each for each in texts]


def is_bare(text: str) -> bool:
    """Tell whether a text is a number without a unit.

    Examples
    --------
    >>> is_bare("45"), is_bare("45 deg"), is_bare("horizontal")
    (True, False, False)
    """
    return not unit_of(text) and text not in AXES and not text[:1].isalpha()


def axis_faults(path: PathGraph, axes: Mapping[str, Sequence[str]]) -> list[str]:
    """Return what is wrong with the values of axes, a sentence each.

    Parameters
    ----------
    path : PathGraph
        What they are given for, not bound yet.
    axes : mapping of str to sequence of str
        The texts of the values of each.

    Returns
    -------
    list of str
        Nothing of a parameter that comes with a material.
    """
    inputs = Values(path.graph).inputs()
    try:
        grid_of(inputs, {name: texts for name, texts in axes.items() if name in inputs.open})
    except OptipathError as error:
        return [*error.faults]
    return []


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


def refuse_arrays(path: PathGraph, axes: Iterable[str]) -> None:
    """Raise where a path has arrays of its own, of which each value would go with one of an axis.

    Parameters
    ----------
    path : PathGraph
        Bound to what has one value.
    axes : iterable of str
        The parameters that are given several values.

    Raises
    ------
    ParameterError
        Naming each, and how one value is given.
    """
    faults = [
        f"parameter '{name}' has several values in the file; give one by "
        f"--{name.replace('_', '-')}, or a range"
        for name, parameter in path.parameters.items()
        if name not in axes and isinstance(parameter.default, np.ndarray)
    ]
    if axes and faults:
        raise ParameterError(*faults)
