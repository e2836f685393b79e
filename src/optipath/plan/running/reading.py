"""Reading: what is given to a plan, as numbers and arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.plan.running.batch import sliced
from optipath.values.angles import CosSin
from optipath.values.input_key import InputKey
from optipath.values.operands import ABSENT, MANY, ONE, WIDE, part_of
from optipath.values.roundings import as_doubles, is_beyond

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping

    from optipath.engines.program.program import Program
    from optipath.values.inputs import Inputs

_PAIR = ("cos", "sin")
_DOUBLE = np.dtype(np.float64)


class ResolvedInputs(NamedTuple):
    """Numbers for a program."""

    numbers: Mapping[InputKey, Any]
    batch: tuple[int, ...]
    before: ResolvedInputs | None = None
    where: tuple[Any, ...] = ()

    @property
    def paths(self) -> int:
        """The number of paths."""
        return int(np.prod(self.batch, dtype=np.int64))

    def cut(self, array: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        """Return what belongs to this part of an array that broadcasts to the whole batch."""
        if self.before is None or not array.ndim:
            return array
        return sliced(self.before.cut(array), self.before.batch, self.where)

    def part(self, where: tuple[Any, ...]) -> ResolvedInputs:
        """Return a part of what is given: an index for each axis, or a mask of the paths."""
        numbers = {
            key: _one_number(sliced(n, self.batch, where)) if isinstance(n, np.ndarray) else n
            for key, n in self.numbers.items()
        }
        return ResolvedInputs(numbers, np.broadcast_to(0.0, self.batch)[where].shape, self, where)

    def within(self, limits: Mapping[Hashable, tuple[float, float]]) -> bool:
        """Tell whether each single number is within the range of its parameter."""
        for key, number in self.numbers.items():
            if isinstance(number, (np.ndarray, bool)) or key.part in _PAIR:
                continue
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
        found = dict.fromkeys([o.input_key for o in program.operands if not o.known])
        computed = [value.name for value in inputs.computed]
        self.keys = {n: [r for r in found if r.name == n] for n in (*inputs.open, *computed)}
        affine = [key for key in found if key.is_affine]
        self._affine = {key.name: [a for a in affine if a.name == key.name] for key in affine}
        # A formula checks the range of a number that it reads, and of no other.
        self._plain = {
            name
            for name, keys in self.keys.items()
            if not inputs.tails[name] and any(key.part in ("value", "real") for key in keys)
        }
        shows = {use.value.name: use.domain.shows_in_light for use in inputs.uses}
        self._plain |= {name for name, keys in self.keys.items() if keys and shows[name]}
        self._angles = {name for name in self._plain if inputs.dimensions[name] == "angle"}
        self._angles -= {name for name, p in inputs.open.items() if p.optional}
        # Nothing else would look at their cosines and sines.
        self._angles -= {
            name for name, several in self._affine.items() if several == self.keys[name]
        }

    def key(self, parameters: Mapping[str, Any]) -> tuple[Any, ...] | None:
        """Return what the names, shapes and types of what is given say of how it is run.

        A word stands for itself. None for what must be looked at.
        """
        if self.inputs.hidden:
            return None
        found: list[Any] = []
        for name, value in parameters.items():
            kind = type(value)
            if kind is np.ndarray:
                if value.dtype is not _DOUBLE or value.size == 1:
                    return None
                found.append((name, value.shape))
            elif kind is float:
                found.append((name, None))
            elif kind is str:
                found.append((name, value))
            else:
                return None
        return tuple(found)

    def read(self, parameters: Mapping[str, Any]) -> ResolvedInputs:
        """Return the numbers that are given.

        Ranges of plain floats and arrays of floats are left to be checked by who uses them.
        """
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
        return ResolvedInputs(numbers, batch)

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
            value.dtype.char != "f" or is_beyond(value, self.inputs.limits[name])
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


def _one_number(array: np.ndarray[Any, Any]) -> Any:
    """Return an array of one number as that number."""
    return array if array.size != 1 or array.dtype.char == "g" else array.item()


def _form(number: Any, dtype: np.dtype[Any]) -> str:
    if isinstance(number, np.ndarray):
        return WIDE if number.dtype.itemsize > dtype.itemsize else MANY
    return ABSENT if number is False else ONE
