"""Array-likes: what is taken for numbers, and what is refused because it is more than that."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from types import NoneType
from typing import Any

import numpy as np

from optipath.errors import OptipathError, ValueFault, shown
from optipath.values.arrays.memory import memory
from optipath.values.roundings import ENDLESS, NARROW, RIGHT_ANGLES, Array, doubles, with_limits

_PLAIN = frozenset(
    {float, int, complex, bool, str, bytes, NoneType, np.ndarray, *np.sctypeDict.values()}
)
_DEEPEST = 64
_FEW, _PATH = 2**20, 32
"""How many numbers take no memory to speak of, and how many bytes a path of each takes."""
_LONG = "gG"
_LABELS = ("to_numpy", "dims", "coords", "columns")
_UNITS = ("unit", "units")
_CURES = {
    "columns": "those of one column, [...].to_numpy()",
    "to_numpy": ".to_numpy()",
    "data_vars": "those of one variable, [...].values",
    "values": ".values",
}
_ANY_CURE = "numpy.asarray(...)"
_OURS = {
    "Light": (
        "and light is no number; only where a state is asked for give its Stokes vector, as in "
        "op.Source(stokes=light.stokes), whose frame is not looked at; several lights of one frame "
        "are op.Light([a.stokes, b.stokes], a.frame)"
    ),
    "Mueller": (
        "whose frames are not looked at; only where a Mueller matrix is asked for give its numbers,"
        " as in op.MuellerElement(mueller.matrix)"
    ),
}
"""What is given in place of light and of what light meets."""


def array_of(
    what: str,
    value: Any,
    error: type[OptipathError] = ValueFault,
    limits: tuple[float, float] = ENDLESS,
) -> Array:
    """Return an array of a value, of float64 at least; words beside numbers stay words.

    Examples
    --------
    >>> array_of("a turn", [0.5, "none"]).tolist()
    [0.5, 'none']
    """
    return doubles(as_given(what, value, error), limits)


def as_given(what: str, value: Any, error: type[OptipathError] = ValueFault) -> Array:
    """Return an array of a value, in the precision in which it is given.

    Examples
    --------
    >>> as_given("a turn", [0.5, 1.0])
    array([0.5, 1. ])
    """
    if type(value) in _PLAIN:
        array = np.asarray(value)
        if array.size <= _FEW and array.dtype.char not in _LONG:
            return array
    try:
        _refuse_endless(value)
        kinds = _kinds(value, set())
        _refuse_too_long(value)
        array = np.asarray(value)
        _refuse_beyond(array)
    except _MoreThanNumbers as more:
        raise error(f"{what} {more}") from None
    except MemoryError:
        raise error(f"{what} takes more memory than there is; give fewer numbers") from None
    except Exception as fault:  # noqa: BLE001 - what is given may raise anything
        raise error(f"{what} {_reason(fault)}") from None
    if array.dtype.kind == "U" and not isinstance(value, str):
        return np.asarray(value, dtype=object)
    if array.dtype.type is np.float64:
        # Among numbers of more precision, a right angle of less is a right angle all the same.
        for kind in kinds.intersection(NARROW):
            array = with_limits(array, kind, RIGHT_ANGLES)
    return array


def entries_of(
    what: str, each: str, value: Any, error: type[OptipathError] = ValueFault
) -> tuple[Any, ...]:
    """Return the entries of a sequence, of which each may be an array or a parameter.

    Examples
    --------
    >>> entries_of("turns", "angles", [0.5, "30 deg"])
    (0.5, '30 deg')
    """
    try:
        _refuse_more(value)
        _refuse_too_long(value)
        # What never ends has no length.
        if len(value) >= 0 and not isinstance(value, (str, bytes, AbstractSet, Mapping)):
            return tuple(value)
        reason = f"must be a sequence of {each}, not {shown(value)}"
    except _MoreThanNumbers as more:
        reason = str(more)
    except MemoryError:
        reason = "takes more memory than there is"
    except Exception:  # noqa: BLE001 - what is given may raise anything
        reason = f"must be a sequence of {each}, not {shown(value)}; for one, write [...]"
    raise error(f"{what} {reason}")


class _MoreThanNumbers(Exception):  # noqa: N818 - a reason, for the sentence around it
    """Why something is no array; what comes behind the name of what it is given for."""


def _kinds(value: Any, seen: set[int]) -> set[type]:
    """Return the types of all numbers in lists in lists; refuse what is more than numbers.

    Each list is looked at once, since it may be in itself.
    """
    if not isinstance(value, (list, tuple)):
        if type(value) not in _PLAIN:
            _refuse_more(value)
        return {type(value)}
    kinds = set(map(type, value))
    if np.ndarray in kinds:
        _refuse_count(sum(entry.size for entry in value if type(entry) is np.ndarray))
    if kinds <= _PLAIN:
        return kinds
    seen.add(id(value))
    several = (_kinds(entry, seen) for entry in value if id(entry) not in seen)
    return set().union(*several)


def _refuse_endless(value: Any) -> None:
    """Refuse a list in itself, which NumPy would open for ever."""
    depth = 0
    while isinstance(value, (list, tuple)) and value:
        value, depth = value[0], depth + 1
        if depth > _DEEPEST:
            raise _MoreThanNumbers(f"is a list in lists, more than {_DEEPEST} deep; give numbers")


def _refuse_too_long(value: Any) -> None:
    """Refuse what says how long it is, and is longer than there is memory for."""
    # A view of one number as many takes none, until it is copied.
    if isinstance(value, np.ndarray):
        _refuse_count(value.size)
    # A number of JAX has a length, and refuses to tell it.
    elif not isinstance(value, (str, bytes)) and getattr(value, "ndim", None) != 0:
        _refuse_count(len(value) if hasattr(type(value), "__len__") else 0)


def _refuse_count(count: int) -> None:
    if count > _FEW and count * _PATH > memory():
        raise _MoreThanNumbers(f"has {count:.3g} entries, more than this machine has memory for")


def _refuse_beyond(array: Array) -> None:
    """Refuse numbers of more precision that are no doubles."""
    if array.dtype.char in _LONG and np.any(np.isfinite(array) & (abs(array) > sys.float_info.max)):
        raise _MoreThanNumbers("has a number beyond those of double precision; give smaller ones")


def _refuse_more(value: Any) -> None:
    """Refuse what has masked entries, a unit or labels."""
    if type(value).__module__.partition(".")[0] == "optipath":
        if (cure := _OURS.get(type(value).__name__)) is not None:
            raise _MoreThanNumbers(f"is a {type(value).__name__}, {cure}")
        return
    if isinstance(value, type):
        raise _MoreThanNumbers(f"is the class {value.__name__}, and none of its kind; make one")
    mask = getattr(value, "mask", None)
    if not callable(mask) and np.any(mask):
        raise _MoreThanNumbers(
            "has masked entries; leave them out, .compressed(), or say what they are, .filled(...)"
        )
    if any(hasattr(value, name) for name in _LABELS):
        cure = next((cure for name, cure in _CURES.items() if hasattr(value, name)), _ANY_CURE)
        raise _MoreThanNumbers(
            f"is a {type(value).__name__} with labels, by which nothing is aligned here; give its "
            f"numbers alone, {cure}"
        )
    for name in _UNITS:
        if (unit := getattr(value, name, None)) is not None:
            raise _MoreThanNumbers(
                f"has a unit, {shown(unit)}, which nothing looks at; give plain numbers, in "
                f"radians or metres"
            )


def _reason(fault: Exception) -> str:
    if type(fault).__name__ == "TracerArrayConversionError":
        return "is a value that JAX traces; do it outside of jit and grad, or give it to trace()"
    said = [argument for argument in fault.args if type(argument) is str]
    if any("inhomogeneous" in text for text in said):
        return "has rows of unequal lengths; make it one shape"
    return f"cannot be made an array, which raises {shown(fault)}; give numbers"
