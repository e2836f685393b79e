"""Arrays: what is accepted as numbers, shapes that broadcast, memory, read-only copies."""

from __future__ import annotations

import os
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from contextlib import contextmanager
from copy import copy
from dataclasses import fields
from math import prod
from types import NoneType
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from optipath.errors import OptipathError, ShapeError, ValueFault
from optipath.faults import shown
from optipath.values.jax_values import is_jax, is_traced
from optipath.values.precision import ENDLESS, Array, doubles, within

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    import numpy.typing as npt


_PLAIN = frozenset(
    {float, int, complex, bool, str, bytes, NoneType, np.ndarray, *np.sctypeDict.values()}
)


def array_of(
    what: str,
    value: Any,
    error: type[OptipathError] = ValueFault,
    limits: tuple[float, float] = ENDLESS,
) -> Array:
    """Return an array of a value, numbers as float64 or complex128; words among them stay words."""
    return doubles(as_argument(what, value, error), limits)


def as_argument(what: str, value: Any, error: type[OptipathError] = ValueFault) -> Array:
    """Return an array of a value, in its own precision; float16 as float64."""
    try:
        reason = _more_than_numbers(value)
        array = np.asarray(None if reason else value)
    except MemoryError:
        raise error(f"{what} takes more memory than there is; give fewer numbers") from None
    except Exception as fault:  # noqa: BLE001 - what is given may raise anything
        raise error(f"{what} {_reason(fault)}") from None
    if reason:
        raise error(f"{what} {reason}")
    refuse_too_large(array.shape, array.itemsize, error=error)
    if array.dtype.kind == "U" and not isinstance(value, str):
        return np.asarray(value, dtype=object)
    if array.dtype == np.float16:
        return array.astype(np.float64)
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def entries_of(
    what: str, each: str, value: Any, error: type[OptipathError] = ValueFault
) -> tuple[Any, ...]:
    """Return the entries of a sequence, of which each may be an array or a parameter."""
    try:
        reason = _more_than_numbers(value)
        is_sequence = not isinstance(value, (str, bytes, AbstractSet, Mapping))
        if not reason and is_sequence and len(value) >= 0:  # What never ends has no length.
            return tuple(value)
    except Exception:  # noqa: BLE001 - what is given may raise anything
        reason = ""
    reason = reason or f"must be a sequence of {each}, not {shown(value)}; for one, write [...]"
    raise error(f"{what} {reason}")


def _more_than_numbers(value: Any) -> str:
    """Return why something is more than numbers, as a sentence goes on; mostly nothing."""
    if type(value) in _PLAIN:
        return ""
    if isinstance(value, (list, tuple)):
        if _PLAIN.issuperset(map(type, value)):
            return ""
        return next(filter(None, map(_more_than_numbers, value)), "")
    kind = type(value)
    if cure := getattr(kind, "instead_of_numbers", ""):
        return f"is a {kind.__name__}, {cure}"
    if kind.__module__.startswith("optipath.") or isinstance(value, type):
        return ""
    mask = getattr(value, "mask", None)
    if not callable(mask) and np.any(mask):
        return "has masked entries; leave them out, .compressed(), or fill them, .filled(...)"
    if any(hasattr(value, name) for name in ("to_numpy", "dims", "coords", "columns")):
        return (
            f"is a {kind.__name__} with labels, which are not aligned here; give its numbers "
            f"alone, as .to_numpy() does"
        )
    units = (getattr(value, name, None) for name in ("unit", "units"))
    if (unit := next((unit for unit in units if unit is not None), None)) is not None:
        return f"has a unit, {shown(unit)}; give plain numbers, in radians or metres"
    return ""


def _reason(fault: Exception) -> str:
    if type(fault).__name__ == "TracerArrayConversionError":
        return "is a value that JAX traces; do it outside of jit and grad, or give it to trace()"
    if "inhomogeneous" in str(fault):
        return "has rows of unequal lengths; make it one shape"
    return f"cannot be made an array, which raises {shown(fault)}; give numbers"


_STOKES = 32
"""How many bytes four doubles have."""

MOST_AXES = 30
"""How many axes a batch may have: NumPy goes along 32, and a matrix has two."""

MOST_PATHS = 2**53
"""How many paths a batch may have, be it never laid out as a whole."""


def joint_shape(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape that shapes broadcast to."""
    result = _joint(shapes)
    if result is None or len(result) > MOST_AXES or prod(result) > MOST_PATHS:
        raise ShapeError(*broadcast_fault({f"array {n}": s for n, s in enumerate(shapes, 1)}))
    return result


def broadcast_fault(shapes: Mapping[str, tuple[int, ...]]) -> list[str]:
    """Return the sentence that names shapes which do not broadcast, or nothing."""
    result = _joint(shapes.values())
    if result is None:
        named = ", ".join(f"{owner} {shape}" for owner, shape in shapes.items() if shape)
        cure = "make their axes equal or 1, as x[:, None] does"
        return [f"arrays do not broadcast together: {named}; {cure}"]
    if len(result) > MOST_AXES:
        owner = max(shapes, key=lambda owner: len(shapes[owner]))
        return [f"{owner} has {len(result)} axes, and a batch has {MOST_AXES} at most; join some"]
    if prod(result) > MOST_PATHS:
        paths = f"{prod(result):.2g} paths, of shape {result}"
        return [f"a batch has {MOST_PATHS:.2g} paths at most, not {paths}; give fewer values"]
    return []


def _joint(shapes: Iterable[tuple[int, ...]]) -> tuple[int, ...] | None:
    """Return the shape that shapes broadcast to; None where they do not."""
    several = tuple(shapes)
    result = [1] * max(map(len, several), default=0)
    for shape in several:
        for axis, length in enumerate(shape, len(result) - len(shape)):
            if result[axis] == 1:
                result[axis] = length
            elif length not in (1, result[axis]):
                return None
    return tuple(result)


def check_broadcast(shapes: Mapping[str, tuple[int, ...]]) -> tuple[int, ...]:
    """Return the shape that several shapes broadcast to."""
    ShapeError.raise_for(broadcast_fault(shapes))
    batch = joint_shape(*shapes.values())
    refuse_too_large(batch, _STOKES)
    return batch


def real_array(what: str, value: Any, tail: tuple[int, ...]) -> npt.NDArray[Any]:
    """Return an array of real numbers whose last axes are given; what is JAX's stays so."""
    array = value if is_jax(value) else as_argument(what, value, ShapeError)
    if array.dtype.kind in "iub":
        array = array.astype(np.float64)
    if array.dtype.kind != "f" or array.shape[-len(tail) :] != tail:
        shape = ", ".join(map(str, ("...", *tail)))
        raise ShapeError(f"{what} is real and of shape ({shape}), not {array.dtype} {array.shape}")
    return array


def place_text(shape: tuple[int, ...], at: int) -> str:
    """Say where something stands in an array, ready to be put behind it; nothing of one alone."""
    place = tuple(int(i) for i in np.unravel_index(at, shape))
    return f" at {place if len(place) > 1 else place[0]}" if place else ""


def first_place(bad: npt.NDArray[np.bool_]) -> str:
    """Say where the first of an array is true, as `place_text` does."""
    return place_text(bad.shape, int(np.argmax(bad)))


UNTOLD = 16 * 2**30
"""How many bytes of memory a machine is taken to have that does not tell."""

CURE = "give fewer values at a time"

PATHS = "batch of {:.3g} paths"
"""What takes memory, with a place for how many there are."""

_LITTLE = 2**26


def refuse_too_large(
    batch: tuple[int, ...],
    each: int,
    cure: str = CURE,
    error: type[OptipathError] = ShapeError,
    what: str = PATHS,
) -> None:
    """Refuse a batch that takes more memory than the machine has."""
    needed = prod(batch) * each
    if needed > _LITTLE and needed > memory():
        raise error(_too_much(batch, each, cure, what))


@contextmanager
def enough_for(
    batch: tuple[int, ...], each: int, cure: str = CURE, error: type[OptipathError] = ShapeError
) -> Iterator[None]:
    """Do what takes memory for each path of a batch, if there is enough of it."""
    refuse_too_large(batch, each, cure, error)
    try:
        yield
    except MemoryError:
        raise error(_too_much(batch, each, cure, PATHS)) from None


def memory() -> int:
    """Return how many bytes of memory the machine has, or how many a process may take."""
    try:
        import resource  # noqa: PLC0415 - Windows has none

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ImportError, AttributeError, ValueError, OSError):
        return UNTOLD
    return there if limit == resource.RLIM_INFINITY else min(there, limit)


def _too_much(batch: tuple[int, ...], each: int, cure: str, what: str) -> str:
    needed, there = (f"{size / 1e9:,.1f} GB" for size in (prod(batch) * each, memory()))
    return (
        f"a {what.format(prod(batch))}, of shape {batch}, takes {needed} of memory or more, "
        f"and this machine has {there}; {cure}"
    )


T = TypeVar("T")
_SCALARS = (str, bytes, int, float, complex, NoneType)


class Unchanging:
    """An object that is made once and never changes."""

    __slots__ = ()

    def __setattr__(self, name: str, value: Any) -> None:
        kind = type(self).__name__
        raise AttributeError(f"a {kind} cannot change; make a new one instead of setting '{name}'")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a {type(self).__name__} cannot change; '{name}' stays")

    def __setstate__(self, own: dict[str, Any]) -> None:
        # NumPy's own copies and pickles can be written to.
        vars(self).update({name: locked(value) for name, value in own.items()})


def locked(value: Any) -> Any:
    """Return a value; an array of NumPy's, which nobody else has, is read-only from now on."""
    if type(value) is np.ndarray:
        value.setflags(write=False)
    return value


def read_only(value: Any, limits: tuple[float, float] = ENDLESS, *, widened: bool = True) -> Any:
    """Return a value that nobody can change: arrays as read-only copies, the rest as it is."""
    if type(value) in _SCALARS or is_traced(value):
        return value
    try:
        array = as_argument("", value)
    except OptipathError:
        # A list is copied all the same.
        return tuple(value) if type(value) is list else value
    if array.dtype.kind == "O" and not isinstance(value, (list, tuple, np.ndarray)):
        return value
    array = within(array, limits) if array.ndim and not widened else doubles(array, limits)
    if array.ndim == 0:
        return array.item()
    if array is value and array.flags.owndata and not array.flags.writeable:
        return array
    return locked(array.copy())


def same(first: Any, second: Any) -> bool:
    """Tell whether two values are equal, arrays by shape and elements."""
    if first is second:
        return True
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    if isinstance(first, dict) and isinstance(second, dict):
        return first.keys() == second.keys() and all(same(first[key], second[key]) for key in first)
    try:
        if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
            return np.array_equal(first, second)
        return bool(first == second)
    except Exception:  # noqa: BLE001 - what cannot be compared is not the same
        return False


def changed(value: T, **others: Any) -> T:
    """Return a copy of a frozen dataclass with other fields, of which nothing is checked again."""
    # Some classes of a user's own say how they are copied; by copy(), all take twice the time.
    plain = not hasattr(value, "__copy__")
    result = object.__new__(type(value)) if plain else copy(value)
    vars(result).update(vars(value) if plain else {}, **others)
    return result


def same_fields(first: Any, second: Any) -> Any:
    """Tell whether two values of one dataclass have the same fields; for its ``__eq__``."""
    if type(second) is not type(first):
        return NotImplemented
    return all(same(getattr(first, f.name), getattr(second, f.name)) for f in fields(first))


class ComparedByFields:
    """A dataclass that equals another of the same fields, and has no hash, as arrays have none."""

    __slots__ = ()
    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]


_NUMBER = (float, int, complex, np.number)


def numbers_for(
    what: str, value: Any, parse: Callable[[str], Any], error: type[OptipathError] = ValueFault
) -> Any:
    """Return a value with the number in place of each text that stands for one."""
    if isinstance(value, str):
        return _number(what, value, parse, error)
    if not isinstance(value, (list, tuple, np.ndarray, np.generic)):
        return value
    try:
        array = as_argument(what, value)
    except ValueFault:
        return value  # For validation to name.
    if array.dtype.kind not in "UO":
        return value
    entries = array.astype(object).ravel()
    faults: list[str] = []
    for place, entry in enumerate(entries):
        if isinstance(entry, str):
            with error.collecting(faults):
                entries[place] = _number(what, entry, parse, error)
    error.raise_for(faults)
    if all(isinstance(entry, _NUMBER) and not isinstance(entry, bool) for entry in entries):
        entries = np.array(entries.tolist())
    return entries.reshape(array.shape)


def _number(what: str, text: str, parse: Callable[[str], T], error: type[OptipathError]) -> T:
    with error.wrapping(what):
        return parse(text)
