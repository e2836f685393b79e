"""Elementary functions that every engine does alike, to the last bit.

Libraries differ in the last bit of sines and exponentials, and so do products that are added
rounded once or twice. Sums, products, quotients and roots are rounded alike by all, and of these
alone the functions are made here.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.numbers.arc_tangent import arc_tangent
from optipath.kernels.numbers.exponential import exponential
from optipath.kernels.numbers.primitives import NUMPY, Primitives, is_below_rounding
from optipath.kernels.numbers.trigonometry import DIGITS, any_quadrant

if TYPE_CHECKING:
    from collections.abc import Callable

_OF_PLAIN_NUMBERS = "where", "sqrt", "absolute", "maximum", "minimum", "ldexp", "two_product"


def reproducible(
    xp: Primitives, dtype: str, small_enough: Callable[[Any], Any] | None = None
) -> Primitives:
    """Return primitives whose elementary functions are made of the others."""
    in_precision: dict[str, Any]
    in_precision = {name: _in_precision(getattr(xp, name), dtype) for name in _OF_PLAIN_NUMBERS}
    xp = replace(xp, below_rounding=is_below_rounding, **in_precision)
    digits, where = DIGITS[dtype], xp.where
    polynomials = any_quadrant(xp, digits)

    def in_size(angle: Any) -> Any:
        return abs(angle) <= digits.most

    small = small_enough or in_size

    def circular(place: int, plain: Callable[..., Any]) -> Callable[[Any], Any]:
        def value(angle: Any) -> Any:
            if np.iscomplexobj(angle):
                return plain(angle)
            known = small(angle)
            if np.all(known):
                return polynomials(angle)[place]
            near = polynomials(where(known, angle, 0.0))[place]
            return where(known, near, _where_large(plain, angle, np.logical_not(known)))

        return value

    exp = exponential(xp, dtype)
    return replace(
        xp,
        sin=circular(0, np.sin),
        cos=circular(1, np.cos),
        exp=lambda x: np.exp(x) if np.iscomplexobj(x) else exp(x),
        atan2=arc_tangent(xp),
    )


@cache
def reproducible_numpy(dtype: str) -> Primitives:
    """Return primitives of NumPy whose elementary functions every engine does alike.

    Examples
    --------
    >>> reproducible_numpy("float64").sin(np.array([0.5, 1e6]))
    array([ 0.47942554, -0.3499935 ])
    """
    return reproducible(NUMPY, dtype)


def _where_large(plain: Callable[..., Any], angles: Any, large: Any) -> Any:
    """Return a function of some angles in a row, as which NumPy does each alike, else 0."""
    numbers = np.asarray(angles)
    found = np.zeros_like(numbers)
    found[large] = plain(numbers[large].astype(np.float64))
    return found


def _in_precision(function: Callable[..., Any], dtype: str) -> Callable[..., Any]:
    """Return a function that takes plain numbers in the precision of a plan."""
    if dtype == "float64":
        return function
    kind = np.dtype(dtype).type
    return lambda *numbers: function(*[kind(n) if type(n) is float else n for n in numbers])
