"""Arithmetic with what is not known yet: times a number, plus a number, and nothing else."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NoReturn, Self

import numpy as np

from optipath.errors import ParameterError, shown
from optipath.values.affine import Affine, real_number
from optipath.values.arrays.jax_values import is_jax

if TYPE_CHECKING:
    from collections.abc import Callable


class AffineArithmetic(Affine):
    """What gives a multiple with an offset by arithmetic, and refuses all other arithmetic.

    Examples
    --------
    >>> from optipath.values.parameters import Parameter
    >>> (90 - 2 * Parameter("d")).formula
    '-2 * d + 90'
    """

    def __neg__(self) -> Self:
        return self.shaped(-self.scale, 0.0 - self.offset, self.offset_dimension)

    def __pos__(self) -> Self:
        return self

    def __mul__(self, other: Any) -> Self:
        if not (factor := real_number(other)):
            self._refuse(f"multiplied by {_named(other)}", other)
        return self._made(factor * self.scale, factor * self.offset)

    def __truediv__(self, other: Any) -> Self:
        if not (divisor := real_number(other)):
            self._refuse(f"divided by {_named(other)}")
        return self._made(self.scale / divisor, self.offset / divisor)

    def __add__(self, other: Any) -> Self:
        return self._shifted(other, 1.0)

    def __sub__(self, other: Any) -> Self:
        return self._shifted(other, -1.0)

    def __rsub__(self, other: Any) -> Self:
        return (-self)._shifted(other, 1.0)

    __rmul__, __radd__ = __mul__, __add__

    def _shifted(self, other: Any, sign: float) -> Self:
        number, dimension = other, self.offset_dimension
        if isinstance(other, str):
            number, dimension = self.parsed(other)
        if (number := real_number(number)) is None:
            self._refuse(f"added to {_named(other)} or subtracted from it", other)
        return self._made(self.scale, self.offset + sign * number, dimension)

    def _made(self, scale: float, offset: float, dimension: str | None = None) -> Self:
        """Return another multiple with another offset, if floats hold these."""
        if scale == 0.0 or not math.isfinite(scale) or not math.isfinite(offset):
            raise ParameterError(
                f"parameter '{self.name}' would stand as {scale} * {self.name} + {offset}, which "
                f"floats cannot hold; give numbers nearer to 1"
            )
        return self.shaped(scale, offset, self.offset_dimension if dimension is None else dimension)

    def _refuse(self, done: str, other: Any = None) -> NoReturn:
        if isinstance(other, (complex, np.complexfloating)):
            raise ParameterError(
                f"{self.called} cannot be {done}; for an index n + ik of which either is "
                f"a parameter, write op.Material(n, k), and for any other complex number one "
                f"parameter that is given it whole"
            )
        raise ParameterError(
            f"{self.called} cannot be {done}: it may stand as a multiple with an offset, "
            f"such as 2 * {self.spoken} + 0.1, and as nothing else; compute other values in NumPy "
            f"and give them as the parameter, or write an element of your own"
        )

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Do what NumPy's own numbers ask for in arithmetic, and refuse any other function."""
        operation = _OF_NUMPY.get(ufunc) if method == "__call__" and not options else None
        if operation is None:
            self._refuse(f"given to numpy.{ufunc.__name__}")
        return operation(*inputs)


def _named(other: Any) -> str:
    if isinstance(other, Affine):
        return other.called
    return "a value of JAX" if is_jax(other) else shown(other)


def _as_object(one: Any) -> Any:
    """Return an object as an array of it, which NumPy compares as Python does."""
    if not isinstance(one, Affine):
        return one
    array = np.empty((), object)
    array[()] = one
    return array


def _reflected(name: str) -> Callable[[Any, Any], Any]:
    """Return an operation that asks whichever of two is not NumPy's own."""

    def operation(first: Any, second: Any) -> Any:
        if isinstance(first, Affine):
            return getattr(first, f"__{name}__")(second)
        return getattr(second, f"__r{name}__")(first)

    return operation


def _refused(done: str) -> Callable[..., NoReturn]:
    def method(self: AffineArithmetic, *_: Any) -> NoReturn:
        self._refuse(done)

    return method


_OF_NUMPY: dict[Any, Callable[..., Any]] = {
    np.add: _reflected("add"),
    np.subtract: _reflected("sub"),
    np.multiply: _reflected("mul"),
    np.true_divide: _reflected("truediv"),
    np.negative: lambda one: -one,
    np.positive: lambda one: one,
    np.equal: lambda *both: np.equal(*map(_as_object, both)),
    np.not_equal: lambda *both: np.not_equal(*map(_as_object, both)),
}

_REFUSED = (
    "rtruediv matmul rmatmul floordiv rfloordiv mod rmod divmod rdivmod abs round trunc floor"
)
for _name in (_REFUSED + " ceil lt le gt ge float int complex").split():
    setattr(AffineArithmetic, f"__{_name}__", _refused(f"given to {_name}()"))
for _name in ("__pow__", "__rpow__"):
    setattr(AffineArithmetic, _name, _refused("raised to a power"))
