"""What the numbers of a Stokes vector say of its ellipse, each angle in its own branch.

The vectors, of shape (..., 4), are those over S0, so that light of any faintness will do.
What is undefined is 0, there and in the slopes that JAX takes; what is not known is NaN.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.jax_values import namespace

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[Any]


def ratio(part: Any, whole: Any) -> Any:
    """Return a part over the whole: 0 where that is 0, and NaN where it is infinite.

    Parameters
    ----------
    part, whole : ndarray
        They broadcast together.

    Returns
    -------
    ndarray
        The quotient; its slope is 0 where the whole is 0.

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


def direction(y: Any, x: Any) -> Any:
    """Return the angle from x to y in (-pi, pi], whatever signs zeros have; 0 where both are 0.

    Parameters
    ----------
    y, x : ndarray
        They broadcast together.

    Returns
    -------
    ndarray
        The angle in radians; its slope is 0 where both are 0.

    Examples
    --------
    >>> print(direction(np.float64(-0.0), np.float64(-1.0)).round(4))
    3.1416
    """
    xp = namespace(y)
    there = (x != 0.0) | (y != 0.0)
    angle = xp.arctan2(xp.where(there, y, 0.0), xp.where(there, x, 1.0))
    return xp.where(angle <= -np.pi, -angle, angle)


def degree(stokes: Array) -> Array:
    """Return the degree of polarisation, the length of (S1, S2, S3) over S0."""
    return _array(length(stokes[..., 1], stokes[..., 2], stokes[..., 3]))


def linear_degree(stokes: Array) -> Array:
    """Return the degree of linear polarisation, hypot(S1, S2) over S0."""
    return _array(length(stokes[..., 1], stokes[..., 2]))


def major_axis(stokes: Array) -> Array:
    """Return the angle of the ellipse's major axis from x towards y, in (-pi/2, pi/2]."""
    return _array(0.5 * direction(stokes[..., 2], stokes[..., 1]))


def ellipticity(stokes: Array) -> Array:
    """Return the signed ratio of the ellipse's axes, with all the digits that S3 has.

    tan(asin(S3 / p) / 2) is S3 / (p + hypot(S1, S2)), p the length of (S1, S2, S3).

    Examples
    --------
    >>> print(ellipticity(np.array([1.0, 0.6, 0.0, 0.8])))
    0.5
    """
    xp, (_, s1, s2, s3) = namespace(stokes), _components(stokes)
    linear = length(s1, s2)
    # What is not physical may be infinite, and then is NaN here.
    with np.errstate(over="ignore", invalid="ignore"):
        axes = length(linear, s3) + linear
        return _array(s3 / xp.where(axes == 0.0, 1.0, axes))


def ellipticity_angle(stokes: Array) -> Array:
    """Return the arctangent of the ellipticity, in [-pi/4, pi/4]."""
    _, s1, s2, s3 = _components(stokes)
    return _array(0.5 * direction(s3, length(s1, s2)))


def handedness(stokes: Array) -> Array:
    """Return the sign of S3 as an integer, 0 also where S3 is not known."""
    s3 = stokes[..., 3]
    return _array((s3 > 0.0).astype(int) - (s3 < 0.0).astype(int))


def amplitude_angle(stokes: Array) -> Array:
    """Return psi of the polarised part, tan psi = abs(Ey) / abs(Ex), in [0, pi/2]."""
    _, s1, s2, s3 = _components(stokes)
    return _array(0.5 * direction(length(s2, s3), s1))


def phase_difference(stokes: Array) -> Array:
    """Return Delta of the polarised part in ellipsometry's exp(+i w t), in (-pi, pi]."""
    _, _, s2, s3 = _components(stokes)
    return _array(direction(-s3, s2))


def _components(stokes: Array) -> tuple[Array, Array, Array, Array]:
    return stokes[..., 0], stokes[..., 1], stokes[..., 2], stokes[..., 3]


def _array(value: Any) -> Array:
    return namespace(value).asarray(value)  # type: ignore[no-any-return]
