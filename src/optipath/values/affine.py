"""Affine: a multiple of what is not known yet, plus a number."""

from __future__ import annotations

import math
import operator
from contextlib import suppress
from numbers import Real
from typing import TYPE_CHECKING, Any, NoReturn, Self

import numpy as np

from optipath.errors import ParameterError, UnitError, ValueFault, shown
from optipath.values.arrays import changed
from optipath.values.jax_values import is_jax
from optipath.values.precision import ENDLESS, affine
from optipath.values.units import (
    USUAL_UNITS,
    dimension_of,
    format_quantity,
    parse_quantity,
    with_article,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable


_PURE = "pure number"
_OF_NUMPY: dict[Any, Callable[..., Any]] = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.true_divide: operator.truediv,
    np.negative: operator.neg,
    np.positive: operator.pos,
}


class Affine:
    """``scale * value + offset`` of a named value that is given later; other arithmetic is refused.

    >>> from optipath.values.parameters import Parameter
    >>> (90 - 2 * Parameter("d")).formula
    '-2 * d + 90'
    """

    name: str
    unit: str
    default: Any
    scale: float
    offset: float
    offset_dimension: str

    @property
    def is_signed(self) -> bool:
        """Whether it stands for the value itself or its negative."""
        return self.offset == 0.0 and self.scale in (1.0, -1.0)

    @property
    def is_negative(self) -> bool:
        """Whether it stands for the negative of the value."""
        return self.offset == 0.0 and self.scale == -1.0

    @property
    def quantity(self) -> Hashable:
        """What is told apart where it stands: by the name, or a multiple with an offset."""
        return self.name if self.is_signed else (self.name, self.scale, self.offset)

    @property
    def formula(self) -> str:
        """What it stands for, as people write it: ``d``, ``-d`` or ``2 * d + 10 deg``."""
        return self.formula_of(self.name)

    def formula_of(self, name: str) -> str:
        """Return what it stands for, the value being called by a name."""
        if self.scale in (1.0, -1.0):
            multiple = f"{'-' * (self.scale < 0.0)}{name}"
        else:
            multiple = f"{format_quantity(self.scale, '')} * {name}"
        if not self.offset:
            return multiple
        sign = "-" if self.offset < 0.0 else "+"
        return f"{multiple} {sign} {format_quantity(abs(self.offset), self.unit)}"

    @property
    def spoken(self) -> str:
        """What formulas in sentences call the value."""
        return self.name

    @property
    def called(self) -> str:
        """What sentences call the value."""
        return f"parameter '{self.name}'"

    @property
    def plain_numbers(self) -> Any:
        """What it is known to be, of which degrees are told from radians; None for nothing."""
        return self.default

    def alone(self) -> Self:
        """Return the value itself."""
        is_alone = self.scale == 1.0 and not self.offset and not self.offset_dimension
        return self if is_alone else self.shaped(1.0, 0.0)

    def like(self, other: Affine) -> Self:
        """Return what stands for this value as another does for its own."""
        return self.shaped(other.scale, other.offset, other.offset_dimension)

    def shaped(self, scale: float, offset: float, offset_dimension: str = "") -> Self:
        """Return a multiple of the value plus an offset.

        Parameters
        ----------
        scale, offset : float
            In radians and metres.
        offset_dimension : str, optional
            What the offset was given as.

        Returns
        -------
        Affine
        """
        return changed(self, scale=scale, offset=offset, offset_dimension=offset_dimension)

    def placed(self, numbers: Any, limits: tuple[float, float] = ENDLESS) -> Any:
        """Return what stands in its place, as `affine` does.

        Parameters
        ----------
        numbers : float or ndarray
            What the value is.
        limits : tuple of float, optional
            What the result must be within.

        Returns
        -------
        float or ndarray
        """
        return affine(self.scale, self.offset, numbers, limits)

    def span_of(self, low: float, high: float) -> tuple[float, float]:
        """Return the limits of what stands in its place.

        Parameters
        ----------
        low, high : float
            Those of the value.

        Returns
        -------
        tuple of float
        """
        ends = self.placed(low), self.placed(high)
        return min(ends), max(ends)

    def span_for(self, low: float, high: float) -> tuple[float, float]:
        """Return the limits of the value.

        Parameters
        ----------
        low, high : float
            Those of what stands in its place.

        Returns
        -------
        tuple of float
        """
        ends = (low - self.offset) / self.scale, (high - self.offset) / self.scale
        return min(ends), max(ends)

    def checked_shape(self) -> tuple[float, float, str]:
        """Return scale and offset as numbers, and the dimension that a text of it names."""
        dimension, argument = self.offset_dimension, self.offset
        if type(argument) is type(self.scale) is float and (self.scale, argument) == (1.0, 0.0):
            return self.scale, argument, dimension
        if isinstance(argument, str):
            argument, dimension = self._parsed(argument)
        scale, offset = real_number(self.scale), real_number(argument)
        if not scale or offset is None:
            raise ParameterError(
                f"parameter '{self.name}' can stand as scale * {self.name} + offset with finite "
                f"real numbers and a scale other than 0, not with scale {shown(self.scale)} and "
                f"offset {shown(self.offset)}"
            )
        return scale, offset, dimension

    def check_place(self, owner: str, domain: Any) -> None:
        """Check that a multiple with an offset can stand where it does.

        Parameters
        ----------
        owner : str
            The place, as sentences name it.
        domain : Domain
            What the values there may be.
        """
        dimension = self.offset_dimension
        if domain.tail and not self.is_signed:
            raise ValueFault(
                f"{owner} is {self.formula}, but takes several numbers that belong together; "
                f"compute them in NumPy and give them as the parameter '{self.name}'"
            )
        if dimension and dimension != (domain.dimension or _PURE):
            raise ValueFault(
                f"the offset of parameter '{self.name}' is {with_article(dimension)}, but {owner} "
                f"takes {domain.described()}; change its unit or where it is used"
            )

    def _parsed(self, text: str) -> tuple[Any, str]:
        """Return the number that a text with a unit is as an offset, and its dimension."""
        own = dimension_of(self.unit) or self.offset_dimension
        for dimension in [] if own else USUAL_UNITS:
            with suppress(UnitError):
                return parse_quantity(text, dimension), dimension or _PURE
        dimension = own.removeprefix(_PURE) if own else "angle"
        return parse_quantity(text, dimension), dimension or _PURE

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
            self._refuse(f"divided by {_named(other)}", other)
        return self._made(self.scale / divisor, self.offset / divisor)

    def __add__(self, other: Any) -> Self:
        return self._shifted(other, 1.0)

    def __sub__(self, other: Any) -> Self:
        return self._shifted(other, -1.0)

    def __rsub__(self, other: Any) -> Self:
        return (-self)._shifted(other, 1.0)

    __rmul__, __radd__ = __mul__, __add__

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Do arithmetic with a number of NumPy, and refuse any other function."""
        if ufunc in (np.equal, np.not_equal):
            return ufunc is np.not_equal
        numbers = [one if isinstance(one, Affine) else real_number(one) for one in inputs]
        if ufunc not in _OF_NUMPY or method != "__call__" or options or None in numbers:
            self._refuse(f"given to numpy.{ufunc.__name__}")
        return _OF_NUMPY[ufunc](*numbers)

    def _not_affine(self, *_: Any) -> NoReturn:
        self._refuse("used so")

    __pow__ = __rpow__ = __rtruediv__ = __mod__ = __abs__ = __float__ = _not_affine
    __lt__ = __le__ = __gt__ = __ge__ = _not_affine

    def _shifted(self, other: Any, sign: float) -> Self:
        number, dimension = other, self.offset_dimension
        if isinstance(other, str):
            number, dimension = self._parsed(other)
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


def real_number(number: Any) -> float | None:
    """Return a finite real number as a float; None for what is none.

    >>> real_number(2), real_number("2"), real_number(math.inf)
    (2.0, None, None)
    """
    if isinstance(number, np.ndarray) and not number.ndim and number.dtype.kind in "iuf":
        number = number[()]
    if not isinstance(number, Real) or isinstance(number, (bool, np.bool_, np.timedelta64)):
        return None
    try:
        result = float(number)
    except (OverflowError, ValueError):
        return None
    return result if math.isfinite(result) else None


def _named(other: Any) -> str:
    if isinstance(other, Affine):
        return other.called
    return "a value of JAX" if is_jax(other) else shown(other)
