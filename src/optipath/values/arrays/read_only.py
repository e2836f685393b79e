"""Values that do not change: read-only copies of arrays, and equality that knows arrays."""

from __future__ import annotations

from copy import copy
from dataclasses import fields
from types import NoneType
from typing import Any, TypeVar

import numpy as np

from optipath.errors import OptipathError
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced
from optipath.values.roundings import ENDLESS, doubles, within

T = TypeVar("T")
_SCALARS = (str, bytes, int, float, complex, NoneType)


class Unchanging:
    """An object that is made once and never changes."""

    __slots__ = ()

    def __setattr__(self, name: str, value: Any) -> None:
        kind = type(self).__name__
        raise AttributeError(f"a {kind} cannot change; make a new one instead of setting '{name}'")

    def __delattr__(self, name: str) -> None:
        kind = type(self).__name__
        raise AttributeError(f"a {kind} cannot change; '{name}' stays")

    def __setstate__(self, own: dict[str, Any]) -> None:
        # NumPy's own copies and pickles can be written to.
        vars(self).update({name: locked(value) for name, value in own.items()})


def locked(value: Any) -> Any:
    """Return a value; an array of NumPy's, which nobody else has, is read-only from now on.

    Examples
    --------
    >>> locked(np.zeros(2)).flags.writeable
    False
    """
    if type(value) is np.ndarray:
        value.setflags(write=False)
    return value


def read_only(value: Any, limits: tuple[float, float] = ENDLESS, *, widened: bool = True) -> Any:
    """Return a value that nobody can change: whatever is an array becomes a read-only copy.

    What is a read-only array of its own already stays what it is, and what is no array of
    numbers or words is kept as given, for validation to name.

    Examples
    --------
    >>> read_only([1.0, 2.0]).flags.writeable
    False
    """
    if type(value) in _SCALARS or is_traced(value):
        return value
    try:
        array = as_given("", value)
        array = within(array, limits) if array.ndim and not widened else doubles(array, limits)
    except OptipathError:
        # A list is copied all the same.
        return tuple(value) if type(value) is list else value
    if isinstance(value, (list, tuple, np.ndarray)) or array.dtype.kind != "O":
        if array is value and array.ndim and array.flags.owndata and not array.flags.writeable:
            return array
        array = array.copy()
        if array.ndim == 0:
            return array.item()
        array.flags.writeable = False
        return array
    return value


def same(first: Any, second: Any) -> bool:
    """Tell whether two values are equal, arrays by shape and elements.

    Examples
    --------
    >>> same(np.array([1.0, 2.0]), np.array([1.0, 2.0]))
    True
    """
    if first is second:
        return True
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    if isinstance(first, dict) and isinstance(second, dict):
        return first.keys() == second.keys() and all(same(first[key], second[key]) for key in first)
    try:
        if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
            return np.array_equal(np.asarray(first), np.asarray(second))
        return bool(first == second)
    except Exception:  # noqa: BLE001 - what cannot be compared is not the same
        return False


def changed(value: T, **others: Any) -> T:
    """Return a copy of a frozen dataclass with other fields, of which nothing is checked again.

    Examples
    --------
    >>> from optipath.values.materials import Material
    >>> changed(Material(1.5), k=0.1)
    Material(n=1.5, k=0.1)
    """
    found = copy(value)
    vars(found).update(others)
    return found


def same_fields(first: Any, second: Any) -> Any:
    """Tell whether two values of one dataclass have the same fields; for its ``__eq__``.

    Examples
    --------
    >>> from optipath.values.materials import Material
    >>> same_fields(Material(1.5), Material(1.5, 0.1))
    False
    """
    if type(second) is not type(first):
        return NotImplemented
    return all(same(getattr(first, f.name), getattr(second, f.name)) for f in fields(first))
