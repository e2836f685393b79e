"""Operand: one number for each path, taken from a value that may have more."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.numbers.circular import cosine, sine
from optipath.kernels.numbers.primitives import NUMPY, made
from optipath.values.arrays.jax_values import check_known, is_traced
from optipath.values.arrays.read_only import same
from optipath.values.input_key import InputKey
from optipath.values.parameters import Parameter
from optipath.values.roundings import doubles

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from optipath.kernels.numbers.primitives import Primitives
    from optipath.values.resolved import Resolved


_DOUBLE = np.dtype(np.float64)

NOTHING: Mapping[str, Resolved] = MappingProxyType({})
"""What is given where all is known."""

ONE, MANY, WIDE, ABSENT = "one", "many", "wide", "absent"
"""What is given: one number, an array, one of more digits than the plan's, or nothing."""


_COMPARED = 1 << 20
"""How many bytes of an array are compared with those of another."""


def part_of(numbers: Any, part: str | int, tail: tuple[int, ...]) -> Any:
    """Return a part of numbers, as `Operand` names them.

    Shapes: numbers (..., *tail); returns (...).

    Examples
    --------
    >>> part_of(np.array([[1.0, 2.0], [3.0, 4.0]]), 2, (2, 2))
    array(3.)
    """
    if isinstance(part, int):
        return numbers.reshape(*numbers.shape[: -len(tail)], prod(tail))[..., part]
    if part == "real":
        return np.real(numbers)
    # Adding 0 turns -0 into 0: an index without absorption has one sign only.
    return np.imag(numbers) + 0.0 if part == "imag" else numbers


@dataclass(frozen=True, eq=False, slots=True)
class Operand:
    """A number, an array or a parameter, and which part of it a kernel is given."""

    value: Any
    part: str | int = "value"
    tail: tuple[int, ...] = ()

    @property
    def known(self) -> bool:
        """Whether the value is known before the plan runs."""
        return not isinstance(self.value, Parameter) or self.value.bound

    @property
    def traced(self) -> bool:
        """Whether the value is one that JAX does not know yet."""
        value = self.value
        return is_traced(value.default if isinstance(value, Parameter) else value)

    @property
    def input_key(self) -> InputKey:
        """What must be given for it, where it is not known."""
        value, part = self.value, self.input_part
        if part == "present" or value.is_signed:
            return InputKey(value.name, part)
        return InputKey(value.name, part, value.scale, value.offset)

    @property
    def input_part(self) -> str | int:
        """The part, but for cosines and sines, which are made of the value."""
        return "value" if self.part in ("cos", "sin") else self.part

    def evaluated(self, xp: Primitives, raw: Any) -> Any:
        """Return what a kernel is given, for the number that is given for the `input_key`."""
        if self.part == "present":
            return raw
        negative = isinstance(self.value, Parameter) and self.value.is_negative
        if isinstance(raw, tuple):
            cos, sin = raw
            if self.part == "cos":
                return cos
            raw = sin if self.part == "sin" else xp.atan2(sin, cos)
        elif self.part in ("cos", "sin"):
            return made(cosine if self.part == "cos" else sine, xp)(-raw if negative else raw)
        return -raw if negative else raw

    def given_in(self, numbers: Mapping[InputKey, Any], sort: Callable[[Any], Any]) -> Any:
        """Return what is given for it among numbers, as `evaluated` takes it."""
        key = self.input_key
        if key in numbers:
            return sort(numbers[key])
        return tuple(sort(numbers[key._replace(part=part)]) for part in ("cos", "sin"))

    def raw(self, given: Mapping[str, Resolved] = NOTHING) -> Any:
        """Return the number of the `input_part` in a known value, or among parameters given."""
        value = self.value
        if isinstance(value, Parameter):
            resolved = value.resolve(value.default) if value.bound else given[value.name]
            if self.part == "present":
                return resolved.present
            value = self.placed(resolved.value)
        return part_of(_doubles(value), self.input_part, self.tail)

    def placed(self, numbers: Any) -> Any:
        """Return numbers for its value, for those of a parameter, but for the sign of that."""
        value = self.value
        if not isinstance(value, Parameter) or value.is_signed:
            return numbers
        return value.placed(numbers)

    def numbers(
        self, given: Mapping[str, Resolved] = NOTHING, kind: np.dtype[Any] = _DOUBLE
    ) -> np.ndarray[Any, Any]:
        """Return this part of the value as an array."""
        raw = self.raw(given)
        check_known(_BY_ITSELF, raw)
        if self.part in ("cos", "sin"):
            raw = np.asarray(raw).astype(kind)
        return np.asarray(self.evaluated(NUMPY, raw))

    @property
    def known_float(self) -> float | None:
        """The number that it is, if it comes of a plain float; None for all else."""
        if type(self.value) is not float or isinstance(self.part, int):
            return None
        if self.part in ("value", "real"):
            return self.value
        return float(self.numbers()) if self.part in ("cos", "sin", "imag") else None

    @property
    def span(self) -> tuple[float, float]:
        """The least and the largest number that it can be, as far as that is known."""
        if self.traced or self.part == "present":
            return -np.inf, np.inf
        if self.known:
            numbers = self.numbers()
            return (float(numbers.min()), float(numbers.max())) if numbers.size else (0.0, 0.0)
        if self.part not in ("value", "real") or self.tail:
            return -np.inf, np.inf
        value: Parameter = self.value
        return value.span_of(value.minimum, value.maximum)

    def negated(self) -> Operand:
        """Return the same part of the value with the other sign."""
        return Operand(-self.value, self.part, self.tail)

    def key(self) -> Hashable:
        """Return what equal operands share; a large array is equal to itself alone."""
        if type(self.value) is float and self.value:
            return self.value, self.part
        if isinstance(self.value, Parameter):
            return self.value.name, self.value.scale, self.value.offset, self.part
        if isinstance(self.value, (int, float, complex)):
            return repr(complex(self.value)), self.part
        if isinstance(self.value, np.ndarray) and self.value.nbytes <= _COMPARED:
            value = self.value
            return value.tobytes(), value.dtype.str, value.shape, self.part, self.tail
        # Whoever keeps the key keeps the operand as well, so that no other array gets this number.
        is_array = isinstance(self.value, np.ndarray)
        return (id(self.value), self.part, self.tail) if is_array else None

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Operand):
            return NotImplemented
        if self.known and other.known and "present" not in (self.part, other.part):
            return same(self.numbers(), other.numbers())
        return self.part == other.part and same(self.value, other.value)

    __hash__ = None  # type: ignore[assignment]


_BY_ITSELF = "an element by itself (in a path, give the value to trace())"
"""What numbers are taken for outside of a run."""


def _doubles(numbers: Any) -> Any:
    """Return numbers as arrays of doubles at least; what JAX traces, as it is."""
    return numbers if is_traced(numbers) else doubles(np.asarray(numbers))


def operand_of(argument: Any) -> Operand:
    """Return the argument of an operation as an operand."""
    return argument if isinstance(argument, Operand) else Operand(argument)
