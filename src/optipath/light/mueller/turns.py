"""Vectors of three components, such as (S1, S2, S3), and the rotations that turn them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.mueller.figures import norm

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[Any]

_ROUNDING = 2.0**-46
_NOTHING = 2.0**-960
_UNIT = np.eye(3)


def least_turn(a: Array, b: Array) -> Array:
    """Return the rotations by the least angle that turn unit vectors a into b.

    Parameters
    ----------
    a, b : ndarray, shape (..., 3)
        Unit vectors.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        The rotation matrices; for opposite vectors, one of the half turns.

    Examples
    --------
    >>> least_turn(np.array([1.0, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0])).diagonal()
    array([-1., -1.,  1.])
    """
    normal = np.cross(a, b)
    sine = norm(normal)[..., np.newaxis]
    least = _UNIT[np.argmin(np.abs(a), axis=-1)]
    axis = np.where(sine > _ROUNDING, normal, np.cross(a, least))
    # Of vectors all but opposite the product is rounding, not all of it across a.
    _, axis = size_and_direction(axis - a * np.sum(a * axis, axis=-1, keepdims=True))
    cosine = np.sum(a * b, axis=-1, keepdims=True)[..., np.newaxis]
    crossed = np.cross(axis[..., np.newaxis, :], _UNIT)
    # Row i of `crossed` is axis x e_i, and so minus row i of the matrix of (axis x).
    return np.asarray(
        cosine * _UNIT + (1.0 - cosine) * outer(axis, axis) - sine[..., np.newaxis] * crossed
    )


def rotation(w: Array, v: Array) -> Array:
    """Return what the unitary matrices w s_0 + i (v_1 s_1 + ...), of any size, do to S1, S2, S3.

    Parameters
    ----------
    w : ndarray, shape (...)
        The real coefficient of s_0.
    v : ndarray, shape (..., 3)
        Those of i s_1, i s_2 and i s_3.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Rotation matrices.

    Examples
    --------
    >>> rotation(np.array(0.0), np.array([3.0, 0.0, 0.0])).diagonal()
    array([ 1., -1., -1.])
    """
    size = np.sqrt(w**2 + np.sum(v**2, axis=-1))[..., np.newaxis]
    w, v = (w[..., np.newaxis] / size)[..., np.newaxis], v / size
    across = 1.0 - 2.0 * np.sum(v**2, axis=-1)[..., np.newaxis, np.newaxis]
    crossed = np.cross(v[..., np.newaxis, :], _UNIT)
    return np.asarray(across * _UNIT + 2.0 * outer(v, v) + 2.0 * w * crossed)


def size_and_direction(vector: Array) -> tuple[Array, Array]:
    """Return lengths, shape (..., 1), and unit vectors; 0 and 0 for what has too few digits.

    Examples
    --------
    >>> size_and_direction(np.array([0.0, 3.0, 4.0]))
    (array([5.]), array([0. , 0.6, 0.8]))
    """
    size = norm(vector)[..., np.newaxis]
    none = size < _NOTHING
    return np.where(none, 0.0, size), np.where(none, 0.0, vector / np.where(none, 1.0, size))


def outer(a: Array, b: Array) -> Array:
    """Return the products of each component with each.

    Parameters
    ----------
    a, b : ndarray, shape (..., 3)
        The vectors.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Rows of a, columns of b.

    Examples
    --------
    >>> outer(np.array([1.0, 2.0]), np.array([3.0, 4.0])).tolist()
    [[3.0, 4.0], [6.0, 8.0]]
    """
    return np.asarray(a[..., :, np.newaxis] * b[..., np.newaxis, :])
