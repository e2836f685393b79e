"""Texts in place of numbers: ``"30 deg"`` alone, and in lists and arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from optipath.errors import OptipathError, ValueFault
from optipath.values.arrays.array_likes import as_given

if TYPE_CHECKING:
    from collections.abc import Callable

T = TypeVar("T")
_NUMBER = (float, int, complex, np.number)


def numbers_for(
    what: str,
    value: Any,
    parse: Callable[[str], Any],
    error: type[OptipathError] = ValueFault,
) -> Any:
    """Return a value with the number in place of each text that stands for one.

    Examples
    --------
    >>> from optipath.values.units import parse_quantity
    >>> numbers_for("a turn", ["180 deg", 0.5], lambda text: parse_quantity(text, "angle"))
    array([3.14159265, 0.5       ])
    """
    if not may_hold_texts(value):
        return value
    if isinstance(value, str):
        return _number(what, value, parse, error)
    try:
        array = as_given(what, value)
    except ValueFault:
        return value  # For validation to name.
    entries = array.astype(object).ravel() if array.dtype.kind in "UO" else np.empty(0)
    places = [place for place, entry in enumerate(entries) if isinstance(entry, str)]
    if not places:
        return value
    faults: list[str] = []
    for place in places:
        try:
            entries[place] = _number(what, entries[place], parse, error)
        except error as fault:
            faults += fault.faults
    if faults:
        raise error(*dict.fromkeys(faults))
    if all(isinstance(entry, _NUMBER) and not isinstance(entry, bool) for entry in entries):
        entries = np.array(entries.tolist())
    return entries.reshape(array.shape)


def may_hold_texts(value: Any) -> bool:
    """Tell, quickly, whether a value is a text, or a list or an array of more than numbers.

    Examples
    --------
    >>> may_hold_texts("30 deg"), may_hold_texts(np.zeros(3)), may_hold_texts([0.5])
    (True, False, True)
    """
    if isinstance(value, (np.ndarray, np.generic)):
        return value.dtype.kind in "UO"
    return isinstance(value, (str, list, tuple))


def _number(what: str, text: str, parse: Callable[[str], T], error: type[OptipathError]) -> T:
    try:
        return parse(text)
    except OptipathError as fault:
        raise error(*(f"{what}: {reason}" for reason in fault.faults)) from None
