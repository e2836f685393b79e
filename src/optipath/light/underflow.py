"""Numbers beyond the range of floats: a mantissa, and the integer exponent of its power of two."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ShapeError, shown
from optipath.values.arrays import as_argument, same
from optipath.values.jax_values import check_known

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.precision import Array


UNDERFLOW = 2.0**60
"""How many times the smallest normal number light must be, lest what underflows is seen in it."""

_LARGEST = 2.0**40


@np.errstate(under="ignore", over="ignore")
def times_two_to(parts: Array, power: Any) -> Array:
    """Return vectors (..., n) times two to a power.

    >>> times_two_to(np.array([1.0, 0.0, 0.0, 0.5]), -1)
    array([0.5 , 0.  , 0.  , 0.25])
    """
    return np.asarray(np.ldexp(parts, np.asarray(power)[..., np.newaxis]))


def normalise_exponent(parts: Array, exponent: Any) -> tuple[Array, Array]:
    """Return vectors (..., n) with their largest parts near 1, exactly, and their exponent.

    >>> normalise_exponent(np.array([6.0, 0.0, 0.0, 3.0]), 0)
    (array([0.75 , 0.   , 0.   , 0.375]), array(3))
    """
    largest = np.max(np.where(np.isnan(parts), 0.0, np.abs(parts)), axis=-1)
    shift = np.frexp(largest)[1].astype(np.int64)
    return times_two_to(parts, -shift), np.asarray(exponent + shift)


def folded(stokes: Array, exponent: Any) -> tuple[Array, Array]:
    """Return the same light (..., 4) without an exponent wherever floats can hold it.

    >>> folded(np.array([[0.5, 0, 0, 0], [0.5, 0, 0, 0]]), np.array([1, -5000]))[1]
    array([    0, -5000])
    """
    plain = times_two_to(stokes, exponent)
    beyond = underflows(plain[..., 0]) & (stokes[..., 0] > 0.0)
    beyond |= np.isinf(plain[..., 0]) & np.isfinite(stokes[..., 0])
    return np.where(beyond[..., np.newaxis], stokes, plain), np.where(beyond, exponent, 0)


def rounded_to(dtype: Any, stokes: Array, exponent: Any) -> tuple[Array, Array]:
    """Return the same light (..., 4) in a precision, whatever range that has.

    >>> rounded_to(np.dtype("f4"), np.array([1e-300, 0.0, 0.0, 0.0]), 0)[1]
    array(-996)
    """
    if stokes.dtype == dtype:
        return stokes, exponent
    stokes, exponent = normalise_exponent(stokes, exponent)
    return folded(stokes.astype(dtype), exponent)


def unscaled(stokes: Array, exponent: Any) -> Array:
    """Return vectors (..., 4) times two to a power; 0 where none is a normal number any more.

    >>> unscaled(np.array([[0.5, 0.25, 0, 0], [0.5, 0.25, 0, 0]]), np.array([1, -1080]))
    array([[1. , 0.5, 0. , 0. ],
           [0. , 0. , 0. , 0. ]])
    """
    result = times_two_to(stokes, exponent)
    # Components that are not read are NaN, as is light that cannot be, which is not dark.
    result[np.fmax.reduce(np.abs(result), axis=-1) < np.finfo(result.dtype).tiny] = 0.0
    return result


def underflows(intensity: Array) -> npt.NDArray[np.bool_]:
    """Tell where light is so weak that what underflows on the way may be seen in it.

    >>> underflows(np.array([1e-300, 1.0]))
    array([ True, False])
    """
    return np.asarray(intensity < np.finfo(intensity.dtype).tiny * UNDERFLOW)


def exponent_argument(argument: Any) -> Array:
    """Return the exponent that somebody gives for light, of integers.

    >>> exponent_argument([-5, 0])
    array([-5,  0])
    """
    check_known("the exponent of a light", argument)
    exponent = as_argument("the exponent of a light", argument, ShapeError)
    if exponent.dtype.kind not in "iu" or np.any(np.abs(exponent.astype(float)) > _LARGEST):
        raise ShapeError(
            "the exponent of a light must be an integer within -2^40 .. 2^40, not "
            f"{shown(argument)}"
        )
    return exponent


def same_numbers(one: tuple[Any, Array], two: tuple[Any, Array]) -> bool:
    """Tell whether two mantissas with their exponents are the same lights.

    >>> faint = np.array([0.5, 0.0, 0.0, 0.0])
    >>> same_numbers((faint, np.array(1)), (2.0 * faint, np.array(0)))
    True
    """
    mine, theirs = (
        pair if same(one[1], two[1]) else normalise_exponent(*pair) for pair in (one, two)
    )
    # What a detector does not read is equal to itself.
    numbers = np.array_equal(mine[0], theirs[0], equal_nan=True)
    return numbers and same(mine[1], theirs[1])
