"""What the numbers of a Stokes vector say of its ellipse, each angle in its own branch.

They are read off the vector over S0, so that light of any faintness will do. What light does not
have is NaN, as what is not known is: dark light has no degree of polarisation, unpolarised light no
ellipse, circular light no axis; nor has light of which the part in question is no more than noise.
Slopes that JAX takes are 0 there.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.carriers.structures import turn_linear
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.precision import coarser

if TYPE_CHECKING:
    from optipath.values.roundings import Array


def ratio(part: Any, whole: Any) -> Any:
    """Return a part over the whole: 0 where that is 0, and NaN where it is infinite.

    Examples
    --------
    >>> ratio(np.array([1.0, 1.0, 1.0]), np.array([4.0, 0.0, np.inf]))
    array([0.25, 0.  ,  nan])
    """
    xp, dark = namespace(whole), whole == 0.0
    # What is not physical may run over, into infinity.
    with np.errstate(over="ignore", invalid="ignore"):
        known = part / xp.where(dark, 1.0, xp.where(xp.isinf(whole), np.nan, whole))
    return xp.where(dark, 0.0, known)


def length(*components: Any) -> Any:
    """Return the length of a vector from its components, however small; at 0 its slope is 0.

    Examples
    --------
    >>> print(length(np.float64(3e-200), np.float64(4e-200)))
    5e-200
    """
    return reduce(_hypotenuse, components)


@np.errstate(over="ignore")
def _hypotenuse(a: Any, b: Any) -> Any:
    xp = namespace(a)
    there = (a != 0.0) | (b != 0.0)
    return xp.where(there, xp.hypot(xp.where(there, a, 1.0), xp.where(there, b, 0.0)), 0.0)


def norm(vector: Array) -> Array:
    """Return the length along the last axis, however small; at 0 its slope is 0."""
    return length(*(vector[..., i] for i in range(vector.shape[-1])))  # type: ignore[no-any-return]


def direction(y: Any, x: Any) -> Any:
    """Return the angle from x to y in (-pi, pi], whatever signs zeros have; 0 where both are 0.

    Units: the result in radians.

    Examples
    --------
    >>> print(direction(np.float64(-0.0), np.float64(-1.0)).round(4))
    3.1416
    """
    xp = namespace(y)
    there = (x != 0.0) | (y != 0.0)
    angle = xp.arctan2(xp.where(there, y, 0.0), xp.where(there, x, 1.0))
    return xp.where(angle <= -np.pi, -angle, angle)


def shares(stokes: Array) -> Array:
    """Return the Stokes vector over S0; 0 where that is 0.

    Shapes: stokes (..., 4); returns (..., 4).

    Examples
    --------
    >>> shares(np.array([2.0, 1.0, 0.0, 0.0]))
    array([1. , 0.5, 0. , 0. ])
    """
    return ratio(stokes, stokes[..., :1])  # type: ignore[no-any-return]


def polarised(stokes: Array) -> tuple[Array, Array, Array]:
    """Return S1, S2 and S3 over S0.

    Shapes: stokes (..., 4); returns (...).

    Examples
    --------
    >>> [part.item() for part in polarised(np.array([2.0, 1.0, 0.0, 0.5]))]
    [0.5, 0.0, 0.25]
    """
    stokes = shares(stokes)
    return stokes[..., 1], stokes[..., 2], stokes[..., 3]


def ellipse_of(numbers: Array, floor: Array) -> tuple[Array, Array, Array]:
    """Return the same, 0 where they are no more than noise: what has no sign has no angle.

    Shapes: numbers (..., 4); floor (...); returns (...).

    Examples
    --------
    >>> [part.item() for part in ellipse_of(np.array([2.0, 1.0, 1e-9, 0.5]), np.array(1e-8))]
    [0.5, 0.0, 0.25]
    """
    if is_traced(numbers):  # A slope is there also at 0.
        return polarised(numbers)
    seen = np.where(np.abs(numbers) < floor[..., np.newaxis], 0.0, shares(numbers))
    return seen[..., 1], seen[..., 2], seen[..., 3]


def minor_over_major(s1: Array, s2: Array, s3: Array) -> Array:
    """Return the minor axis over the major axis, S3 / (p + hypot(S1, S2)); 0 of no ellipse.

    Shapes: s1, s2, s3 (...); returns (...).

    Examples
    --------
    >>> print(minor_over_major(np.float64(0.3), np.float64(0.0), np.float64(-0.4)))
    -0.5
    """
    xp, linear = namespace(s1), length(s1, s2)
    # What is not physical may be infinite, and then is NaN here.
    with np.errstate(over="ignore", invalid="ignore"):
        axes = length(linear, s3) + linear
        return s3 / xp.where(axes == 0.0, 1.0, axes)  # type: ignore[no-any-return]


def where_there(value: Any, stokes: Array, floor: Array, *components: int) -> Array:
    """Return a value, NaN where light is dark, or has none of some components, for noise.

    Shapes: value (...); stokes (..., 4); floor (...); returns (...).

    Examples
    --------
    >>> print(where_there(0.5, np.array([1.0, 0.0, 0.0, 0.0]), np.array(1e-16), 1, 2))
    nan
    """
    there = stokes[..., 0] > floor
    if components:
        there = there & (length(*(stokes[..., i] for i in components)) > floor)
    found = namespace(stokes).where(there, value, np.nan)
    return namespace(found).asarray(found)  # type: ignore[no-any-return]


def turned_stokes(stokes: Array, turn: Any) -> Array:
    """Return Stokes vectors in a frame that is turned.

    Shapes: stokes (..., 4); returns (..., 4).

    Examples
    --------
    >>> from optipath.light.frames import Frame
    >>> quarter = Frame().turn_to(Frame().turned(np.pi / 4))
    >>> turned_stokes(np.array([1.0, 1.0, 0.0, 0.5]), quarter).round(12)
    array([ 1. ,  0. , -1. ,  0.5])
    """
    xp, (s0, s1, s2, s3) = namespace(stokes), (stokes[..., i] for i in range(4))
    with np.errstate(over="ignore", invalid="ignore"):
        parts = (s0, *turn_linear(turn, s1, s2), s3)
    turned = xp.stack(xp.broadcast_arrays(*parts), axis=-1)
    return turned.astype(coarser(turned, stokes), copy=False)  # type: ignore[no-any-return]
