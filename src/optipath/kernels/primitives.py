"""Primitives: the elementwise functions of kernels in every engine, and numbers near 0."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import lru_cache, partial, reduce
from operator import add
from typing import Any, TypeAlias, TypeVar

import numpy as np

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Primitives:
    """The functions a kernel may call, which ``mueller_rows`` is given as ``xp``.

    All broadcast, over floats, arrays, JAX's values or symbols; `docs/own-elements.md` has a table.
    """

    where: Callable[[Any, Any, Any], Any]
    sqrt: Callable[[Any], Any]
    absolute: Callable[[Any], Any]
    maximum: Callable[[Any, Any], Any]
    minimum: Callable[[Any, Any], Any]
    sin: Callable[[Any], Any]
    cos: Callable[[Any], Any]
    exp: Callable[[Any], Any]
    atan2: Callable[[Any, Any], Any]
    scaling: Callable[[Any], Any]
    ldexp: Callable[[Any, Any], Any]
    two_product: Callable[[Any, Any], tuple[Any, Any]]
    below_rounding: Callable[[Any, Any], Any]
    fixed: Callable[[Any], Any]
    multiply_add: Callable[[Any, Any, Any], Any] = lambda a, b, c: a * b + c
    integer: Callable[[Any], Any] = int
    apart: Callable[[Any], Any] = lambda function: function
    within: float = 0.0


KernelFunction: TypeAlias = Callable[..., tuple[Any, ...]]
"""What a kernel is for some primitives: numbers in, numbers out."""

Factory: TypeAlias = Callable[[Primitives], KernelFunction]
"""What makes a kernel for any primitives."""


@lru_cache(4096)
def made(factory: Callable[[Primitives], T], primitives: Primitives) -> T:
    """Return what a factory makes of primitives, made once and kept."""
    return factory(primitives)


def is_below_rounding(larger: Any, number: Any) -> Any:
    """Tell whether a number is no more than the rounding of a larger one, its square of 1.

    A sine that is taken as 0 so takes no energy from cos^2 + sin^2.
    """
    return (larger + number == larger) & (1.0 + number * number == 1.0)


def _below_rounding_in_arrays(larger: Any, number: Any) -> Any:
    if np.result_type(larger) == np.longdouble:
        # Angles come as doubles, whatever they are computed with.
        return is_below_rounding(larger.astype(np.float64), number.astype(np.float64))
    return is_below_rounding(larger, number)


def product_rest(a: Any, b: Any) -> Any:
    """Return what the rounding of a b has lost, without a fused multiply-add."""
    return product_and_rest(a, b)[1]


def product_and_rest(a: Any, b: Any) -> tuple[Any, Any]:
    """Return a product and what its rounding has lost (Dekker, Numer. Math. 18, 1971)."""
    product = a * b
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    rest = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, rest


def _halves(a: Any) -> tuple[Any, Any]:
    kind = getattr(a, "dtype", None)
    high = (_PLAIN_SPLITTER if kind is None else _SPLITTERS[np.dtype(kind).char]) * a
    high = high - (high - a)
    return high, a - high


def _splitter(kind: str) -> Any:
    digits = np.finfo(kind).nmant + 1
    return np.dtype(kind).type(2) ** (digits - digits // 2) + np.dtype(kind).type(1)


_PLAIN_SPLITTER = 2.0**27 + 1.0
_SPLITTERS = {kind: _splitter(kind) for kind in "fdg"}


def _fused_two_product(a: float, b: float) -> tuple[float, float]:
    product = a * b
    return product, math.fma(a, b, -product)  # type: ignore[attr-defined,unused-ignore] # Python 3.13


def _primitives(xp: Any, **others: Any) -> Primitives:
    """Return primitives of a module's functions, but for those that are given."""
    own = {name: getattr(xp, name) for name in ("sqrt", "sin", "cos", "exp", "ldexp")}
    own |= {"scaling": lambda number: xp.frexp(number)[1], "two_product": product_and_rest}
    own |= {"below_rounding": is_below_rounding, "fixed": lambda value: value}
    return Primitives(**own | others)


def of_module(xp: Any) -> Primitives:
    """Return the primitives of a module with NumPy's functions, ``numpy`` or ``jax.numpy``."""
    names = "where", "absolute", "maximum", "minimum"
    others = {name: getattr(xp, name) for name in names} | {"atan2": xp.arctan2}
    return _primitives(xp, integer=lambda number: xp.asarray(number).astype(int), **others)


NUMPY = replace(of_module(np), below_rounding=_below_rounding_in_arrays)

FLOAT = _primitives(
    math,
    where=lambda condition, yes, no: yes if condition else no,
    absolute=abs,
    maximum=max,
    minimum=min,
    atan2=math.atan2,
    two_product=_fused_two_product if hasattr(math, "fma") else product_and_rest,
)


def _one_by_one(function: Callable[..., float], count: int) -> Callable[..., Any]:
    each = np.frompyfunc(function, count, 1)
    return lambda *numbers: np.asarray(each(*numbers), np.float64)


FLOAT_ARRAYS = replace(
    NUMPY,
    sin=_one_by_one(math.sin, 1),
    cos=_one_by_one(math.cos, 1),
    exp=_one_by_one(math.exp, 1),
    atan2=_one_by_one(math.atan2, 2),
)
"""`FLOAT` over arrays, with the same bits: libraries have sines of their own for arrays."""


class Made(partial[KernelFunction]):
    """A factory out of others, equal to one that is made of equal ones; plans pickle it."""

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Made):
            return NotImplemented
        mine, its = ((each.func, each.args, each.keywords) for each in (self, other))
        return mine == its

    def __hash__(self) -> int:
        return hash((self.func, self.args))


def with_zero(factory: Factory, place: int, xp: Primitives) -> KernelFunction:
    """Make a kernel without the argument at one place."""
    kernel = factory(xp)
    # Not a plain 0: its precision is that of the others.
    return lambda *argument: kernel(*argument[:place], 0.0 * argument[0], *argument[place:])


_SEVERAL = 64.0
"""How many roundings a negative intensity may come from."""


def products(*pairs: tuple[Any, Any]) -> Any:
    """Return the sum of products, without those that have a plain 0 for a factor."""
    terms = [a * b for a, b in pairs if not (_is_plain_zero(a) or _is_plain_zero(b))]
    return total(terms) if terms else 0.0 * pairs[0][0] * pairs[0][1]


def total(numbers: Iterable[Any]) -> Any:
    """Return a sum from left to right; Python's own has more digits of floats than of arrays."""
    return reduce(add, numbers)


def _is_plain_zero(number: Any) -> bool:
    return type(number) is float and number == 0.0


def not_below_rounding(xp: Primitives, weak: Any, size: Any) -> Any:
    """Return an intensity, 0 where it is negative by no more than the roundings of a size.

    Negative intensities by unphysical matrices of one's own stay.
    """
    return _taken_as_0(xp, (weak < 0.0) & vanishes(weak, _SEVERAL * size), weak)


def not_above_rounding(xp: Primitives, number: Any, size: Any) -> Any:
    """Return a number, 0 where it is no more than the roundings of a size."""
    return _taken_as_0(xp, vanishes(number, _SEVERAL * size), number)


def _taken_as_0(xp: Primitives, condition: Any, number: Any) -> Any:
    """Return a number, 0 where a condition holds; its slope stays."""
    if xp.within:
        return number - xp.where(condition, xp.fixed(number), 0.0)
    return xp.where(condition, 0.0, number)


def vanishes(number: Any, other: Any) -> Any:
    """Tell whether a number is no more than the rounding of another."""
    return other + number == other
