"""Operand: one number for each path, taken from a value that may have more."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.kernels import FLOAT, NUMPY, cosine, sine
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import same
from optipath.values.parameters import Parameter, Resolved
from optipath.values.roundings import doubles

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping


_COS, _SIN = cosine(NUMPY), sine(NUMPY)
_FLOAT_COS, _FLOAT_SIN = cosine(FLOAT), sine(FLOAT)
_DOUBLE = np.dtype(np.float64)


ZERO, ONE, MANY, WIDE, ABSENT = "zero", "one", "many", "wide", "absent"
"""What is given: 0, one number, an array, one of more digits than the plan's, or nothing."""


_COMPARED = 1 << 20
"""How many bytes of an array are compared with those of another."""


class InputKey(NamedTuple):
    """A number that is given for a parameter, before anything is done to it.

    Attributes
    ----------
    name : str
        The parameter.
    part : str or int
        As in `Operand`; cosines and sines are made of ``"value"``.
    """

    name: str
    part: str | int = "value"

    def __str__(self) -> str:
        return f"{self.name} {self.part}"


def part_of(numbers: Any, part: str | int, tail: tuple[int, ...]) -> Any:
    """Return a part of numbers, as `Operand` names them.

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
    """A number, an array or a parameter, and which part of it a kernel is given.

    Attributes
    ----------
    value : Any
        A number, an array, or a `Parameter`.
    part : str or int
        ``"value"``, ``"real"``, ``"imag"``, ``"cos"``, ``"sin"``, ``"present"`` (is an
        optional parameter there?), or the position in a flattened vector or matrix.
    tail : tuple of int
        The axes of the value behind the batch.
    """

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
        return InputKey(self.value.name, self.input_part)

    @property
    def input_part(self) -> str | int:
        """The part, but for cosines and sines, which are made of the value."""
        return "value" if self.part in ("cos", "sin") else self.part

    def numbers(
        self, given: Mapping[str, Resolved], kind: np.dtype[Any] = _DOUBLE
    ) -> np.ndarray[Any, Any]:
        """Return this part of the value, parameters being given.

        Cosines and sines are computed in the precision of `kind`.
        """
        if not isinstance(self.value, Parameter):
            return np.asarray(
                self._done_to(part_of(_doubles(self.value), self.input_part, self.tail), kind)
            )
        if self.part == "present":
            return self.present(given)
        raw = part_of(_doubles(self._resolved(given).value), self.input_part, self.tail)
        return np.asarray(self.of(raw, kind))

    def of(self, raw: Any, kind: np.dtype[Any] = _DOUBLE) -> Any:
        """Return this part of a parameter's value, from the number or array that is given."""
        return self._done_to(-raw if self.value.negative else raw, kind)

    def of_float(self, raw: float) -> Any:
        """Return this part of a parameter's value, from one float, without arrays."""
        signed = -raw if self.value.negative else raw
        if self.part in ("cos", "sin"):
            return (_FLOAT_COS if self.part == "cos" else _FLOAT_SIN)(signed)
        return signed

    @property
    def known_float(self) -> float | None:
        """The number that it is, if it comes of a plain float; None for all else."""
        if type(self.value) is not float or isinstance(self.part, int):
            return None
        if self.part in ("value", "real"):
            return self.value
        return float(self.numbers({})) if self.part in ("cos", "sin", "imag") else None

    def present(self, given: Mapping[str, Resolved] | None = None) -> np.ndarray[Any, Any]:
        """Return where an optional parameter is there."""
        return self._resolved(given or {}).present

    @property
    def span(self) -> tuple[float, float]:
        """The least and the largest number that it can be, as far as that is known."""
        if self.traced or self.part == "present":
            return -np.inf, np.inf
        if self.known:
            numbers = self.numbers({})
            return (float(numbers.min()), float(numbers.max())) if numbers.size else (0.0, 0.0)
        if self.part not in ("value", "real") or self.tail:
            return -np.inf, np.inf
        low, high = self.value.minimum, self.value.maximum
        return (-high, -low) if self.value.negative else (low, high)

    def negated(self) -> Operand:
        """Return the same view of the value with the other sign."""
        return Operand(-self.value, self.part, self.tail)

    def key(self) -> Hashable:
        """Return what equal operands share; a large array is equal to itself alone."""
        if type(self.value) is float and self.value:
            return self.value, self.part
        if isinstance(self.value, Parameter):
            return self.value.name, self.value.negative, self.part
        if isinstance(self.value, (int, float, complex)):
            return repr(complex(self.value)), self.part
        if isinstance(self.value, np.ndarray) and self.value.nbytes <= _COMPARED:
            value = self.value
            return value.tobytes(), value.dtype.str, value.shape, self.part, self.tail
        # Whoever keeps the key keeps the operand as well, so that no other array gets this number.
        is_array = isinstance(self.value, np.ndarray)
        return (id(self.value), self.part, self.tail) if is_array else None

    def _resolved(self, given: Mapping[str, Resolved]) -> Resolved:
        parameter: Parameter = self.value
        return parameter.resolve(parameter.default) if parameter.bound else given[parameter.name]

    def _done_to(self, numbers: Any, kind: np.dtype[Any]) -> Any:
        if self.part in ("cos", "sin"):
            return (_COS if self.part == "cos" else _SIN)(np.asarray(numbers).astype(kind))
        return numbers

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Operand):
            return NotImplemented
        if self.known and other.known and "present" not in (self.part, other.part):
            return same(self.numbers({}), other.numbers({}))
        return self.part == other.part and same(self.value, other.value)

    __hash__ = None  # type: ignore[assignment]


def _doubles(numbers: Any) -> Any:
    """Return numbers as arrays of doubles at least; what JAX traces, as it is."""
    return numbers if is_traced(numbers) else doubles(np.asarray(numbers))


def operand_of(argument: Any) -> Operand:
    """Return the argument of an operation as an operand."""
    return argument if isinstance(argument, Operand) else Operand(argument)
