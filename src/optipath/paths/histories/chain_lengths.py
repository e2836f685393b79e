"""How many vertices each chain of a batch has, and where whole numbers of chains are none."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.shapes import first_place

if TYPE_CHECKING:
    import numpy.typing as npt

    Whole = npt.NDArray[np.int64]


def lengths_given(lengths: Any, count: int) -> Whole:
    """Return how many vertices each chain has.

    Shape: lengths (...).

    Examples
    --------
    >>> lengths_given([1, 3], 3)
    array([1, 3])
    """
    numbers = whole_numbers("lengths", lengths)
    bad = ~((numbers >= 1) & (numbers <= count) & (numbers == np.rint(numbers)))
    if np.any(bad):
        raise ValueFault(
            f"lengths is {number_of(numbers, bad)}{first_place(bad)}; give how many vertices each "
            f"chain has, 1 .. {count}"
        )
    return numbers.astype(np.int64)


def whole_numbers(what: str, given: Any) -> npt.NDArray[Any]:
    """Return real numbers, which are to be whole ones."""
    numbers = as_given(what, given)
    if numbers.dtype.kind not in "iuf":
        raise ValueFault(f"{what} must be whole numbers, not {shown(given)}")
    return numbers


def number_of(numbers: npt.NDArray[Any], bad: npt.NDArray[np.bool_]) -> str:
    """Return the first number that is bad, as sentences have it.

    Examples
    --------
    >>> number_of(np.array([1.0, 2.5]), np.array([False, True]))
    '2.5'
    """
    return f"{numbers[bad].ravel()[0]:.12g}"


def has_ended(lengths: Whole, count: int) -> npt.NDArray[np.bool_]:
    """Return which vertices are behind the end of their chain.

    Shapes: lengths (...); returns (..., count).

    Examples
    --------
    >>> has_ended(np.array([1, 2]), 2).tolist()
    [[False, True], [False, False]]
    """
    found: npt.NDArray[np.bool_] = np.arange(count) >= lengths[..., np.newaxis]
    return found
