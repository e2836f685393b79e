"""Underflow: which light is too faint for floats, and which may have lost digits on its way."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.precision import Array


UNDERFLOW = 2.0**60
"""How many times the smallest normal number light must be, lest what underflows is seen in it."""


@np.errstate(under="ignore", over="ignore")
def unscaled(stokes: Array, exponent: Any) -> Array:
    """Return vectors (..., 4) times two to a power; 0 where none is a normal number any more.

    >>> unscaled(np.array([[0.5, 0.25, 0, 0], [0.5, 0.25, 0, 0]]), np.array([1, -1080]))
    array([[1. , 0.5, 0. , 0. ],
           [0. , 0. , 0. , 0. ]])
    """
    result = np.asarray(np.ldexp(stokes, np.asarray(exponent)[..., np.newaxis]))
    # Components that are not read are NaN, as is light that cannot be, which is not dark.
    result[np.fmax.reduce(np.abs(result), axis=-1) < np.finfo(result.dtype).tiny] = 0.0
    return result


def underflows(intensity: Array) -> npt.NDArray[np.bool_]:
    """Tell where light is so weak that what underflows on the way may be seen in it.

    >>> underflows(np.array([1e-300, 1.0]))
    array([ True, False])
    """
    return np.asarray(intensity < np.finfo(intensity.dtype).tiny * UNDERFLOW)
