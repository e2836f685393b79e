"""Operands and operations: the numbers of each path, and kernels applied to them."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.kernels.primitives import NUMPY, made
from optipath.kernels.trigonometry import cosine, sine
from optipath.values.arrays import ComparedByFields, same
from optipath.values.jax_values import check_known, is_traced
from optipath.values.parameters import Parameter
from optipath.values.precision import affine, doubles

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from optipath.kernels.kernel import Kernel, KernelFamily
    from optipath.kernels.primitives import Primitives
    from optipath.values.parameters import Resolved


_DOUBLE = np.dtype(np.float64)
_FLOATS = frozenset({float})

NOTHING: Mapping[str, Resolved] = MappingProxyType({})
"""What is given where all is known."""

ONE, MANY, WIDE, ABSENT = "one", "many", "wide", "absent"
"""What is given: one number, an array, one of more digits than the plan's, or nothing."""


_COMPARED = 1 << 20
"""How many bytes of an array are compared with those of another."""


def part_of(numbers: Any, part: str | int, tail: tuple[int, ...]) -> Any:
    """Return a part of numbers (..., *tail), as `Operand` names them."""
    if isinstance(part, int):
        return numbers[(..., *map(int, np.unravel_index(part, tail)))]
    if part == "real":
        return np.real(numbers)
    # Adding 0 turns -0 into 0: an index without absorption has one sign only.
    return np.imag(numbers) + 0.0 if part == "imag" else numbers


@dataclass(eq=False, slots=True)  # Not frozen, which takes thrice the time to make.
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

    def number_in(self, numbers: Mapping[InputKey, Any], sort: Callable[[Any], Any]) -> Any:
        """Return what is given for it among numbers, as `evaluated` takes it."""
        key = self.input_key
        if key in numbers:
            return sort(numbers[key])
        return tuple(sort(numbers[key._replace(part=part)]) for part in ("cos", "sin"))

    def raw(self, arguments: Mapping[str, Resolved] = NOTHING) -> Any:
        """Return the number of the `input_part` in a known value, or among parameters given."""
        value = self.value
        if isinstance(value, Parameter):
            resolved = value.resolve(value.default) if value.bound else arguments[value.name]
            if self.part == "present":
                return resolved.present
            value = self.placed(resolved.value)
        return part_of(_doubles(value), self.input_part, self.tail)

    def at(self, arguments: Mapping[str, Resolved] = NOTHING) -> Any:
        """Return this part of the value, for what is given."""
        return self.evaluated(NUMPY, self.raw(arguments))

    def placed(self, numbers: Any) -> Any:
        """Return numbers for its value, for those of a parameter, but for the sign of that."""
        value = self.value
        if not isinstance(value, Parameter) or value.is_signed:
            return numbers
        return value.placed(numbers)

    def numbers(
        self, arguments: Mapping[str, Resolved] = NOTHING, kind: np.dtype[Any] = _DOUBLE
    ) -> np.ndarray[Any, Any]:
        """Return this part of the value as an array."""
        raw = self.raw(arguments)
        check_known(_BY_ITSELF, raw)
        if self.part in ("cos", "sin"):
            raw = np.asarray(raw).astype(kind)
        return np.asarray(self.evaluated(NUMPY, raw))

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
        return value.span_of((value.minimum, value.maximum))

    def negated(self) -> Operand:
        """Return the same part of the value with the other sign."""
        return Operand(-self.value, self.part, self.tail)

    def key(self) -> Hashable:
        """Return what equal operands share; a large array is equal to itself alone."""
        if type(self.value) is float and self.value:
            return self.value, self.part
        value = self.value
        if isinstance(value, Parameter):
            return value.name, value.scale, value.offset, self.part
        if isinstance(value, (int, float, complex)):
            return repr(complex(value)), self.part
        if not isinstance(value, np.ndarray):
            return None
        if value.nbytes <= _COMPARED:
            return value.tobytes(), value.dtype.str, value.shape, self.part, self.tail
        # Whoever keeps the key keeps the operand as well, so that no other array gets this number.
        return id(value), self.part, self.tail

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


@dataclass(eq=False, slots=True)
class Operation(ComparedByFields):
    """A kernel and the values it is given.

    Attributes
    ----------
    kernel : Kernel or KernelFamily
        What is computed; of a family, the method that the composer is asked for.
    arguments : tuple
        Numbers, arrays, parameters, operands, and what other operations come to.

    Examples
    --------
    An index of refraction n = 1.5 + 0.004 / wavelength^2 (in um), as a kernel is given it:

    >>> from optipath.kernels.kernel import Kernel
    >>> from optipath.kernels.primitives import FLOAT
    >>> cauchy = Kernel("Cauchy", None, lambda xp: lambda a, b, length: (a + b / length**2, 0.0))
    >>> n, k = Operation(cauchy, (1.5, 0.004, 0.5)).results(2)
    >>> n.operation.numbers(FLOAT, float)
    (1.516, 0.0)
    """

    kernel: Kernel | KernelFamily
    arguments: tuple[Any, ...]

    @property
    def is_of_floats(self) -> bool:
        """Whether it is given plain floats alone."""
        return _FLOATS.issuperset(map(type, self.arguments))

    def results(self, count: int) -> tuple[ResultOf, ...]:
        """Return as many numbers as it comes to, as arguments of other operations."""
        return tuple(ResultOf(self, place) for place in range(count))

    def numbers(
        self, xp: Primitives, read: Callable[[Any], Any], method: str = "stable"
    ) -> tuple[Any, ...]:
        """Return what it comes to.

        Parameters
        ----------
        xp : Primitives
            What is computed with.
        read : callable
            Gives the number of an argument that is no result of another operation.
        method : str, optional
            Of a family of kernels.

        Returns
        -------
        tuple
            The numbers of the kernel's structure.
        """
        known: dict[int, tuple[Any, ...]] = {}
        arguments = []
        for argument in self.arguments:
            if isinstance(argument, ResultOf):
                inner = argument.operation
                if id(inner) not in known:
                    known[id(inner)] = inner.numbers(xp, read, method)
                arguments.append(known[id(inner)][argument.place])
            else:
                arguments.append(read(argument))
        return self.kernel.by_method(method).made_for(xp)(*arguments)

    def operands(self) -> list[Operand]:
        """Return the operands that it is given, and those behind the results that it is given."""
        inner = {id(a.operation): a.operation for a in self.arguments if isinstance(a, ResultOf)}
        behind = [operand for operation in inner.values() for operand in operation.operands()]
        return behind + [operand_of(a) for a in self.arguments if not isinstance(a, ResultOf)]


@dataclass(frozen=True, slots=True)
class ResultOf:
    """One of the numbers that an operation comes to."""

    operation: Operation
    place: int

    __hash__ = None  # type: ignore[assignment]


class InputKey(NamedTuple):
    """A number that is given for a parameter, before anything is done to it."""

    name: str
    part: str | int = "value"
    scale: float = 1.0
    offset: float = 0.0

    def __str__(self) -> str:
        plain = f"{self.name} {self.part}"
        return f"{self.scale} * {plain} + {self.offset}" if self.is_affine else plain

    @property
    def is_affine(self) -> bool:
        """Whether it is a multiple of what is given, or has an offset."""
        return self.scale != 1.0 or self.offset != 0.0

    @property
    def quantity(self) -> Hashable:
        """What it is a part of: the parameter by its name, or a multiple of it with an offset."""
        return (self.name, self.scale, self.offset) if self.is_affine else self.name

    def limits_in(self, ranges: Mapping[Hashable, tuple[float, float]]) -> tuple[float, float]:
        """Return its least and its largest number, for the ranges of quantities."""
        low, high = ranges[self.quantity]
        # An index that is never 0 absorbs nothing all the same.
        return (min(low, 0.0), high) if self.part == "imag" else (low, high)

    def placed(self, numbers: Any, limits: tuple[float, float]) -> Any:
        """Return numbers for it."""
        return affine(self.scale, self.offset, numbers, limits) if self.is_affine else numbers


class Ranges(dict["Hashable", "tuple[float, float]"]):
    """The ranges of quantities, by what `InputKey.quantity` says.

    A multiple that is no element's value has the range that follows from that of its parameter.
    """

    def __missing__(self, quantity: tuple[str, float, float]) -> tuple[float, float]:
        name, scale, offset = quantity
        low, high = sorted(affine(scale, offset, end) for end in self[name])
        self[quantity] = low, high
        return low, high


def kernel_values(
    factory: Callable[[Primitives], Callable[..., tuple[Any, ...]]], *numbers: Any
) -> tuple[Any, ...]:
    """Return what a kernel makes of real numbers: JAX's where traced, else NumPy's float64."""
    if any(map(is_traced, numbers)):
        return _traced_values(factory, numbers)
    argument = np.broadcast_arrays(*(np.asarray(number, np.float64) for number in numbers))
    with np.errstate(all="ignore"):
        result = made(factory, NUMPY)(*argument)
    return tuple(np.array(np.broadcast_to(part, argument[0].shape), np.float64) for part in result)


def _traced_values(factory: Any, numbers: tuple[Any, ...]) -> tuple[Any, ...]:
    import jax.numpy as jnp  # noqa: PLC0415 - an extra, which is there where it traces

    from optipath.values.jax_primitives import JAX, sloped, with_slopes  # noqa: PLC0415

    kind = jnp.zeros(()).dtype
    argument = jnp.broadcast_arrays(*(jnp.asarray(number, kind) for number in numbers))
    shape = argument[0].shape
    values, slopes = (
        [jnp.broadcast_to(jnp.asarray(part, kind), shape) for part in made(factory, xp)(*of)]
        for xp, of in ((JAX, JAX.fixed(argument)), (sloped(kind), argument))
    )
    return tuple(map(with_slopes, values, slopes))
