"""Reading: arguments of a run as numbers and arrays, in batches and pieces."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.values.angles import CosSin
from optipath.values.operands import ABSENT, MANY, ONE, WIDE, InputKey, part_of
from optipath.values.precision import as_doubles, within

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Iterator, Mapping

    from optipath.engines.program import Program
    from optipath.plan.inputs import Inputs
    from optipath.values.precision import Array


_PAIR = ("cos", "sin")
_DOUBLE = np.dtype(np.float64)


class Batch(NamedTuple):
    """Numbers for a program by their keys, their joint shape, and what they were read from."""

    numbers: Mapping[InputKey, Any]
    shape: tuple[int, ...]
    parameters: Mapping[str, Any]
    before: Batch | None = None
    where: tuple[Any, ...] = ()

    @property
    def paths(self) -> int:
        """The number of paths."""
        return int(np.prod(self.shape, dtype=np.int64))

    @property
    def ahead(self) -> int:
        """The number of paths of the whole, of which this may be a part."""
        return self.paths if self.before is None else self.before.ahead

    def cut(self, array: Array) -> Array:
        """Return what belongs to this part of an array that broadcasts to the whole batch."""
        if self.before is None or not array.ndim:
            return array
        return sliced(self.before.cut(array), self.before.shape, self.where)

    def part(self, where: tuple[Any, ...]) -> Batch:
        """Return a part of what is given: an index for each axis, or a mask of the paths."""
        numbers = {
            key: _one_number(sliced(n, self.shape, where)) if isinstance(n, np.ndarray) else n
            for key, n in self.numbers.items()
        }
        shape = np.broadcast_to(0.0, self.shape)[where].shape
        return Batch(numbers, shape, self.parameters, self, where)

    def within(self, limits: Mapping[Hashable, tuple[float, float]]) -> bool:
        """Tell whether each single number is within the range of its parameter."""
        for key, number in self.numbers.items():
            if not isinstance(number, (np.ndarray, bool)) and key.part not in _PAIR:
                low, high = key.limits_in(limits)
                if not (low <= number <= high and abs(number) < np.inf):
                    return False
        return True

    @property
    def nothing(self) -> frozenset[InputKey]:
        """What is not there: optional elements by their presence, and imaginary parts."""
        return frozenset([key for key, number in self.numbers.items() if number is False])

    @property
    def is_of_floats(self) -> bool:
        """Whether every number of a path is a plain float, or says that an element is there."""
        for key, number in self.numbers.items():
            floats = type(number) is float or getattr(number, "dtype", _DOUBLE) == _DOUBLE
            if number is not True and number is not False and (key.part in _PAIR or not floats):
                return False
        return True

    def forms(self, dtype: np.dtype[Any]) -> tuple[tuple[InputKey, str], ...]:
        """Return in which form each number is given, for a precision."""
        return tuple([(key, _form(number, dtype)) for key, number in self.numbers.items()])


class InputReader:
    """Reads what is given to a program."""

    def __init__(
        self, program: Program, inputs: Inputs, dtype: np.dtype[Any], *, reproducible: bool = False
    ) -> None:
        self.inputs = inputs
        self._widest = np.result_type(dtype, np.float64)
        # An engine of doubles reads what it is given as doubles, where it stands.
        self._known_kinds = "fd?" if dtype == np.float32 and not reproducible else "d?"
        computed = [value.name for value in inputs.computed]
        self.keys: dict[str, list[InputKey]] = {n: [] for n in (*inputs.open, *computed)}
        for key in dict.fromkeys([o.input_key for o in program.operands if not o.known]):
            self.keys[key.name].append(key)
        affine = {n: [key for key in keys if key.is_affine] for n, keys in self.keys.items()}
        self._affine = {name: keys for name, keys in affine.items() if keys}
        # A formula checks the range of a number that it reads, and of no other.
        shows = {use.value.name: use.domain.shows_in_light for use in inputs.uses}
        self._plain = {
            name
            for name, keys in self.keys.items()
            if (keys and shows[name])
            or (not inputs.tails[name] and any(key.part in ("value", "real") for key in keys))
        }
        # Nothing else would look at the cosines and sines of angles that are all multiples.
        self._angles = {
            name
            for name in self._plain
            if inputs.dimensions[name] == "angle"
            and self._affine.get(name) != self.keys[name]
            and not (name in inputs.open and inputs.open[name].optional)
        }

    def key(self, parameters: Mapping[str, Any]) -> tuple[Any, ...] | None:
        """Return names, shapes and types of inputs, which choose the run; None if that is open."""
        if self.inputs.hidden:
            return None
        results: list[Any] = []
        for name, value in parameters.items():
            kind = type(value)
            if kind is np.ndarray and value.dtype is _DOUBLE and value.size != 1:
                results.append((name, value.shape))
            elif kind is float or kind is str:
                results.append((name, None if kind is float else value))
            else:
                return None
        return tuple(results)

    def read(self, parameters: Mapping[str, Any]) -> Batch:
        """Return the given numbers; ranges of plain floats and arrays are checked by the caller."""
        resolved, batch = self.inputs.resolve(parameters, self.is_plain)
        numbers: dict[InputKey, Any] = {}
        value: Any
        for name, (value, present) in resolved.items():
            if type(value) is CosSin:
                for part in _PAIR:
                    numbers[InputKey(name, part)] = self._number(getattr(value, part))
                # Of a multiple, or with an offset, the angle is what is needed.
                for key in self._affine.get(name, ()):
                    numbers[key] = self._number(
                        self._placed(key, as_doubles(np.asarray(value.angle)))
                    )
                continue
            for key in self.keys[name]:
                numbers[key] = self._number(self.part(key, value, present))
        return Batch(numbers, batch, parameters)

    def is_plain(self, name: str, value: Any) -> bool:
        """Tell whether a value is taken as it stands: a float, an array of them, or an angle."""
        if name not in self._plain:
            return False
        tail = self.inputs.tails[name]
        if type(value) is float:
            return not tail
        if isinstance(value, CosSin):
            return name in self._angles
        if type(value) is not np.ndarray or not value.dtype.isnative:
            return False
        if value.dtype.char != "d" and (
            value.dtype.char != "f" or within(value, self.inputs.limits[name]) is not value
        ):
            return False
        return bool(value.shape[value.ndim - len(tail) :] == tail)

    def part(self, key: InputKey, value: Any, present: Any = True) -> Any:  # noqa: FBT002
        """Return a part of a value that has been read."""
        if key.part == "present":
            return True if np.all(present) else present
        # Of real numbers it is known for all paths, and the kernels without absorption do.
        if key.part == "imag" and not np.iscomplexobj(value):
            return False
        if type(value) is float:
            return self._placed(key, value)
        return part_of(self._placed(key, value), key.part, self.inputs.tails[key.name])

    def _placed(self, key: InputKey, value: Any) -> Any:
        """Return the numbers of a multiple with an offset; those of a plain parameter as given."""
        return key.placed(value, self.inputs.limits[key.quantity]) if key.is_affine else value

    def _number(self, value: Any) -> Any:
        """Return one number as a float or a bool, and arrays in a precision engines know."""
        if isinstance(value, bool) or type(value) is float:
            return value
        array = np.asarray(value)
        if array.dtype.char not in self._known_kinds or not array.dtype.isnative:
            array = array.astype(self._widest)
        return _one_number(array)


def _one_number(array: Array) -> Any:
    """Return an array of one number as that number."""
    return array if array.size != 1 or array.dtype.char == "g" else array.item()


def _form(number: Any, dtype: np.dtype[Any]) -> str:
    if isinstance(number, np.ndarray):
        return WIDE if number.dtype.itemsize > dtype.itemsize else MANY
    return ABSENT if number is False else ONE


_THIN = 64
"""How long an axis must be for a loop of its own."""


class Layout:
    """The axes of a batch; neighbours that all arrays have together, or lack, are one.

    >>> layout = Layout((4, 3, 2), {"a": np.ones((4, 1, 1)), "b": np.ones((3, 2))})
    >>> layout.shape, layout.axes["b"]
    ((4, 6), frozenset({1}))
    """

    def __init__(self, batch: tuple[int, ...], arrays: Mapping[Any, Array]) -> None:
        own = {name: _differing(array.shape, len(batch)) for name, array in arrays.items()}
        groups: list[list[int]] = []
        last: Any = None
        for axis, length in enumerate(batch):
            members = frozenset([name for name, axes in own.items() if axis in axes])
            if length == 1:
                continue
            if groups and members == last:
                groups[-1].append(axis)
            else:
                groups.append([axis])
            last = members
        self.batch = batch
        self.paths = prod(batch)
        self.groups = groups
        self.shape = tuple(prod(batch[axis] for axis in group) for group in groups)
        self.axes = {
            name: frozenset(i for i, group in enumerate(groups) if group[0] in axes)
            for name, axes in own.items()
        }

    @property
    def all_axes(self) -> frozenset[int]:
        """The axes that are left."""
        return frozenset(range(len(self.shape)))

    @property
    def last(self) -> int | None:
        """The innermost axis, if it is long enough for a loop of its own."""
        if len(self.shape) < 2 or self.shape[-1] < _THIN:
            return None
        return len(self.shape) - 1

    @property
    def key(self) -> tuple[Any, ...]:
        """What layouts have in common that one formula serves."""
        return len(self.shape), self.last, frozenset(self.axes.items())

    def lengths(self, axes: Iterable[int]) -> tuple[int, ...]:
        """Return the lengths of some of the axes, in order."""
        return tuple(self.shape[axis] for axis in sorted(axes))

    def among(self, array: Array, own: frozenset[int], axes: frozenset[int]) -> Array:
        """Return an array with an axis for each of some, long where it differs along it."""
        return array.reshape([self.shape[axis] if axis in own else 1 for axis in sorted(axes)])

    def in_batch(self, array: Array, own: frozenset[int]) -> Array:
        """Return an array with an axis for each of the batch, long where it differs along it."""
        lengths = [1] * len(self.batch)
        for axis in own:
            for member in self.groups[axis]:
                lengths[member] = self.batch[member]
        return array.reshape(lengths)


def sliced(array: Array, batch: tuple[int, ...], where: tuple[Any, ...]) -> Array:
    """Return what belongs to a part of the batch, still without the axes along which it is one.

    >>> sliced(np.ones((3, 1)), (3, 5), (slice(0, 2), slice(1, 4))).shape
    (2, 1)
    """
    results: Array
    if where and not isinstance(where[0], (int, slice)):
        results = np.broadcast_to(array, batch)[where]
    else:
        shape = (1,) * (len(batch) - array.ndim) + array.shape
        index = [
            _sliced(at, own, whole) for at, own, whole in zip(where, shape, batch, strict=False)
        ]
        results = array.reshape(shape)[tuple(index)]
    return results


def _sliced(at: Any, own: int, whole: int) -> Any:
    """Return the index along an axis, along which the array may be one and the batch not."""
    if own != 1 or whole == 1:
        return at
    return 0 if isinstance(at, int) else slice(None)


def _differing(shape: tuple[int, ...], count: int) -> frozenset[int]:
    before = count - len(shape)
    return frozenset(before + axis for axis, length in enumerate(shape) if length != 1)


class Piece(NamedTuple):
    """A part of a batch."""

    where: tuple[int | slice, ...]
    start: int
    stop: int


def pieces(batch: tuple[int, ...], size: int) -> Iterator[Piece]:
    """Yield the parts of a batch in order, each of a size at most.

    >>> [piece.where for piece in pieces((2, 3), 4)]
    [(slice(0, 1, None),), (slice(1, 2, None),)]
    """
    if 0 < prod(batch) <= size:
        yield Piece((slice(0, batch[0]),) if batch else (), 0, prod(batch))
        return
    axis = 0
    while axis < len(batch) - 1 and prod(batch[axis + 1 :]) > size:
        axis += 1
    inner = prod(batch[axis + 1 :])
    step = max(1, size // max(inner, 1))
    start = 0
    for outer in np.ndindex(batch[:axis]):
        for begin in range(0, batch[axis], step):
            end = min(begin + step, batch[axis])
            stop = start + (end - begin) * inner
            yield Piece((*outer, slice(begin, end)), start, stop)
            start = stop
