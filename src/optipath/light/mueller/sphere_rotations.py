"""Vectors of three components, such as (S1, S2, S3), and the rotations that turn them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.polarization_state import norm

if TYPE_CHECKING:
    from optipath.values.roundings import Array

_ROUNDING = 2.0**-46
_NOTHING = 2.0**-960
_UNIT = np.eye(3)


def least_turn(a: Array, b: Array) -> Array:
    """Return the rotations by the least angle that turn unit vectors a into b.

    Shapes: a, b (..., 3); returns (..., 3, 3).

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

    Shapes: w (...); v (..., 3); returns (..., 3, 3).

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

    Shapes: a, b (..., 3); returns (..., 3, 3).

    Examples
    --------
    >>> outer(np.array([1.0, 2.0]), np.array([3.0, 4.0])).tolist()
    [[3.0, 4.0], [6.0, 8.0]]
    """
    return np.asarray(a[..., :, np.newaxis] * b[..., np.newaxis, :])


def turn_of(retarder: Any) -> tuple[Array, Array]:
    """Return the axis and the angle in [0, pi] of rotations, by the largest of four columns.

    Each column is the unit quaternion (cos R/2, sin R/2 times the axis) times one of its parts.
    """
    r = np.asarray(retarder)[..., 1:, 1:]
    xx, yy, zz = r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]
    x, y, z = (r[..., i, j] - r[..., j, i] for i, j in ((2, 1), (0, 2), (1, 0)))
    xy, xz, yz = (r[..., i, j] + r[..., j, i] for i, j in ((0, 1), (0, 2), (1, 2)))
    columns = np.stack(
        [
            np.stack([1 + xx + yy + zz, x, y, z], axis=-1),
            np.stack([x, 1 + xx - yy - zz, xy, xz], axis=-1),
            np.stack([y, xy, 1 - xx + yy - zz, yz], axis=-1),
            np.stack([z, xz, yz, 1 - xx - yy + zz], axis=-1),
        ],
        axis=-2,
    )
    largest = np.argmax(np.diagonal(columns, axis1=-2, axis2=-1), axis=-1)
    column = np.take_along_axis(columns, largest[..., np.newaxis, np.newaxis], axis=-2)[..., 0, :]
    column = np.where(column[..., :1] < 0.0, -column, column)
    sine = norm(column[..., 1:])
    axis = column[..., 1:] / np.where(sine == 0.0, 1.0, sine)[..., np.newaxis]
    return axis, np.asarray(2.0 * np.arctan2(sine, column[..., 0]))
