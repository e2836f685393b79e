"""The polar decomposition of Mueller matrices, without a step that noise could break.

S.-Y. Lu and R. A. Chipman, J. Opt. Soc. Am. A 13, 1106 (1996). With d the direction of the
diattenuation vector, D its length, P the polarizance vector and m the lower right 3x3 part,
all over M00, M = M_depolarizer M_retarder M_diattenuator where

    M_diattenuator = M00 [[1, D d'], [D d, a 1 + (1 - a) d d']],  a = sqrt(1 - D^2),
    M_depolarizer M_retarder = [[1, 0], [p, m']],  p = (P - m D d) / (1 - D^2),
    m' = m (1 - d d') / a + (m d - D P) d' / (1 - D^2) = m_depolarizer m_retarder,

the last by singular values. Sums and differences of p and m' d lose fewer digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.mueller.figures import norm
from optipath.mueller.scaled import scaled, unscaled

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[Any]

# What a path of some elements may have gathered of rounding, against M00.
_ROUNDING = 2.0**-46
# No physical matrix has an entry above its M00; where one has, ratios must not run over.
_DARK = 2.0**-200
_NOTHING = 2.0**-960
_UNIT = np.eye(3)
_LAST = np.array([False, False, True])


def polar_parts(matrix: Any) -> tuple[Array, Array, Array]:
    """Return the depolarizer, the retarder and the diattenuator, of shape (..., 4, 4) each."""
    parts, power = scaled(matrix)
    m00 = parts[..., :1, :1]
    lit = np.abs(m00) > _DARK
    unit = np.where(lit, parts / np.where(lit, m00, 1.0), np.eye(4))
    polarizance, m = unit[..., 1:, 0], unit[..., 1:, 1:]

    size, d = _size_and_direction(unit[..., 0, 1:])
    ideal = size > 1.0 - _ROUNDING
    D = np.where(ideal, 1.0, size)
    diattenuator = _bordered(D * d, D * d, _diattenuation(D, d))

    gap = np.where(ideal, 1.0, 1.0 - D)
    image = _applied(m, d)
    half_sum, half_difference = (polarizance + image) / (1.0 + D), (polarizance - image) / gap
    p, along = 0.5 * (half_sum + half_difference), 0.5 * (half_sum - half_difference)
    across = (m - _outer(image, d)) / np.sqrt(gap * (1.0 + D))[..., np.newaxis]
    depolarizing, turn = _depolarizer_and_turn(across + _outer(along, d), _ROUNDING / gap)

    # Behind an ideal polariser the light has one state, whatever follows: the least will do.
    degree, seen = _size_and_direction(polarizance)
    least = least_turn(d, np.where(degree == 0.0, d, seen))
    turn = np.where(ideal[..., np.newaxis], least, turn)
    depolarizing = np.where(ideal[..., np.newaxis], degree[..., np.newaxis] * _UNIT, depolarizing)

    none = np.zeros_like(d)
    depolarizer = _bordered(none, np.where(ideal, 0.0, p), depolarizing)
    retarder = _bordered(none, none, turn)
    return (
        unscaled(matrix, depolarizer, 0),
        unscaled(matrix, retarder, 0),
        unscaled(matrix, m00 * diattenuator, power),
    )


def least_turn(a: Array, b: Array) -> Array:
    """Return the rotations by the least angle that turn unit vectors a into b, (..., 3, 3).

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
    _, axis = _size_and_direction(axis - a * np.sum(a * axis, axis=-1, keepdims=True))
    cosine = np.sum(a * b, axis=-1, keepdims=True)[..., np.newaxis]
    crossed = np.cross(axis[..., np.newaxis, :], _UNIT)
    # Row i of `crossed` is axis x e_i, and so minus row i of the matrix of (axis x).
    return np.asarray(
        cosine * _UNIT + (1.0 - cosine) * _outer(axis, axis) - sine[..., np.newaxis] * crossed
    )


def _depolarizer_and_turn(m: Array, rounding: Array) -> tuple[Array, Array]:
    """Return m_depolarizer, symmetric, and m_retarder, a rotation, whose product is m."""
    u, sizes, v = np.linalg.svd(m)
    sign = np.where(np.linalg.det(u @ v) < 0.0, -1.0, 1.0)[..., np.newaxis]
    # The paper gives a negative determinant to all three axes; if it is but rounding, to the last.
    signs = np.where((sizes[..., 2:] > rounding) | _LAST, sign, 1.0)
    turn = (u * signs[..., np.newaxis, :]) @ v
    # Not the rounding that D near 1 brings: with less than it has, the product would not hold.
    one, none = (sizes[..., place, np.newaxis, np.newaxis] <= _ROUNDING for place in (1, 0))
    turn = np.where(one, least_turn(v[..., 0, :], u[..., :, 0]), turn)
    depolarizing = (u * (signs * sizes)[..., np.newaxis, :]) @ np.swapaxes(u, -1, -2)
    return depolarizing, np.where(none, _UNIT, turn)


def _size_and_direction(vector: Array) -> tuple[Array, Array]:
    """Return lengths, shape (..., 1), and unit vectors; 0 and 0 for what has too few digits."""
    size = norm(vector)[..., np.newaxis]
    none = size < _NOTHING
    return np.where(none, 0.0, size), np.where(none, 0.0, vector / np.where(none, 1.0, size))


def _diattenuation(D: Array, d: Array) -> Array:
    a = np.sqrt((1.0 - D) * (1.0 + D))[..., np.newaxis]
    return np.asarray(a * _UNIT + (1.0 - a) * _outer(d, d))


def _bordered(row: Array, column: Array, lower: Array) -> Array:
    bordered = np.empty((*lower.shape[:-2], 4, 4))
    bordered[..., 0, 0] = 1.0
    bordered[..., 0, 1:], bordered[..., 1:, 0], bordered[..., 1:, 1:] = row, column, lower
    return bordered


def _outer(a: Array, b: Array) -> Array:
    return np.asarray(a[..., :, np.newaxis] * b[..., np.newaxis, :])


def _applied(matrix: Array, vector: Array) -> Array:
    return np.asarray((matrix @ vector[..., np.newaxis])[..., 0])
