"""Pairs of numbers, which may be the two parts of one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault

if TYPE_CHECKING:
    from collections.abc import Iterable

_REAL = (float, int, np.floating, np.integer)


def is_pair(value: Any) -> bool:
    """Tell whether a value is two real numbers written by hand; arrays are of several paths.

    Examples
    --------
    >>> is_pair((0.2, 3.4)), is_pair([0.2, 3.4]), is_pair((1.5, 1.6, 1.7))
    (True, True, False)
    >>> is_pair(np.array([0.2, 3.4]))
    False
    """
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        return False
    return all(isinstance(part, _REAL) and not isinstance(part, bool) for part in value)


def pair_faults(name: str, value: Any, uses: Iterable[Any]) -> list[str]:
    """Ask what a pair given for a parameter means, where one complex number may be meant.

    Parameters
    ----------
    name : str
        The parameter.
    value : Any
        What is given for it.
    uses : iterable of Use
        Where parameters stand.

    Returns
    -------
    list of str
        A sentence for each such place of the parameter; mostly none.
    """
    faults: list[str] = []
    for use in uses if is_pair(value) else ():
        try:
            if use.value.name == name:
                use.domain.read(f"parameter '{name}' (at {use.owner})", value)
        except ValueFault as fault:
            faults += fault.faults
    return faults
