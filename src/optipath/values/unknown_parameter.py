"""What is said of a name that no parameter has, but something else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import did_you_mean
from optipath.spelling import closest

if TYPE_CHECKING:
    from collections.abc import Iterable

_OF_A_COMPOSER = ("method", "model", "engine", "dtype", "tolerance", "composing", "loops")
_CASE = "cas"
"""What the word case begins with, however it goes on."""


def unknown_parameter(name: str, known: Iterable[str]) -> str:
    """Return the sentence for a parameter that there is not.

    Parameters
    ----------
    name : str
        What was written.
    known : iterable of str
        What could have been meant.

    Returns
    -------
    str
        It says where a case is named, and an option of a composer, if these were meant.

    Examples
    --------
    >>> unknown_parameter("dtype", ["delta"])
    "'dtype' is no parameter of the path; write Composer(dtype=...).compose(path)"
    """
    names = [*known]
    if closest(name, names) is None:
        if name in _OF_A_COMPOSER:
            return f"'{name}' is no parameter of the path; write Composer({name}=...).compose(path)"
        if name.lower().startswith(_CASE):
            return f"'{name}' is no parameter of the path; write load_preset(..., case=...)"
    return f"parameter '{name}' is unknown{did_you_mean(name, names)}"
