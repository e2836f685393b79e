"""The polar decomposition of Mueller matrices, without a step that noise could break.

S.-Y. Lu and R. A. Chipman, J. Opt. Soc. Am. A 13, 1106 (1996). With d the direction of the
diattenuation vector, D its length, P the polarizance vector and m the lower right 3x3 part,
all over M00, M = M_depolarizer M_retarder M_diattenuator where

    M_diattenuator = M00 [[1, D d'], [D d, a 1 + (1 - a) d d']],  a = sqrt(1 - D^2),
    M_depolarizer M_retarder = [[1, 0], [p, m']],  p = (P - m D d) / (1 - D^2),
    m' = m (1 - d d') / a + (m d - D P) d' / (1 - D^2) = m_depolarizer m_retarder,

the last by singular values. Sums and differences of p and m' d lose fewer digits. What does not
depolarise has the parts of its Jones matrix, which lose none where little is let through.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.mueller.normalised import rounding_of, scaled, unscaled
from optipath.light.mueller.pure import jones_parts
from optipath.light.mueller.sphere_rotations import least_turn, outer, size_and_direction
from optipath.light.underflow import times_two_to

if TYPE_CHECKING:
    from optipath.values.roundings import Array

# What a path of some elements may have gathered of rounding, against what they let through.
_ROUNDING = 2.0**-46
# The most of it against M00, which may be small because of its unit.
_MOST = 2.0**-20
# No physical matrix has an entry above its M00; where one has, ratios must not run over.
_DARK = 2.0**-200
_UNIT = np.eye(3)
_LAST = np.array([False, False, True])


def polar_parts(matrix: Any) -> tuple[Array, Array, Array]:
    """Return the depolarizer, the retarder and the diattenuator, of shape (..., 4, 4) each."""
    parts, power = scaled(matrix)
    m00 = parts[..., :1, :1]
    lit = np.abs(m00) > _DARK
    unit = np.where(lit, parts / np.where(lit, m00, 1.0), np.eye(4))
    polarizance = unit[..., 1:, 0]
    rounding = _rounding(matrix, np.where(lit, m00, 1.0)[..., 0], power)
    pure, root, turn = jones_parts(unit, rounding)
    size, d = size_and_direction(unit[..., 0, 1:])
    ideal = np.where(pure, root <= rounding, _is_polariser(unit, size, rounding))
    D = np.where(ideal, 1.0, np.minimum(size, 1.0))
    root = np.where(ideal, 0.0, np.where(pure, root, np.sqrt((1.0 - D) * (1.0 + D))))
    p, depolarizing, turns = _behind_diattenuator(unit, D, d)
    turn = np.where(pure[..., np.newaxis], turn, turns)
    depolarizing = np.where(pure[..., np.newaxis], _UNIT, depolarizing)

    # Behind an ideal polariser the light has one state, whatever follows: the least will do.
    degree, seen = size_and_direction(polarizance)
    least = least_turn(d, np.where(degree == 0.0, d, seen))
    turn = np.where(ideal[..., np.newaxis], least, turn)
    one_state = (ideal & ~pure)[..., np.newaxis]
    depolarizing = np.where(one_state, degree[..., np.newaxis] * _UNIT, depolarizing)

    none = np.zeros_like(d)
    diattenuator = _bordered(D * d, D * d, _diattenuation(root, d))
    depolarizer = _bordered(none, np.where(ideal | pure, 0.0, p), depolarizing)
    retarder = _bordered(none, none, turn)
    return (
        unscaled(matrix, depolarizer, 0),
        unscaled(matrix, retarder, 0),
        unscaled(matrix, m00 * diattenuator, power),
    )


def _rounding(matrix: Any, m00: Array, power: Array) -> Array:
    """Return what may be rounding in matrices over M00, shape (..., 1).

    That of the parts, which let 1 through at most, is larger against an M00 that they block.
    """
    least = max(_ROUNDING, 64.0 * rounding_of(matrix))
    blocked = times_two_to(1.0 / np.abs(m00), -power)
    return np.clip(least * blocked, least, max(least, _MOST))


def _is_polariser(unit: Array, size: Array, rounding: Array) -> Array:
    """Tell where D is 1, or nothing but rounding depends on the state that comes in."""
    one_state = outer(unit[..., :, 0], unit[..., 0, :])
    rest = np.abs(unit - one_state).max(axis=(-1, -2), initial=0.0)[..., np.newaxis]
    return np.asarray((size > 1.0 - _ROUNDING) | ((size > 1.0 - rounding) & (rest <= rounding)))


def _behind_diattenuator(unit: Array, D: Array, d: Array) -> tuple[Array, Array, Array]:
    """Return p, m_depolarizer and m_retarder; numbers without a meaning where D is 1."""
    polarizance, m = unit[..., 1:, 0], unit[..., 1:, 1:]
    gap = np.where(D < 1.0, 1.0 - D, 1.0)
    image = (m @ d[..., np.newaxis])[..., 0]
    half_sum, half_difference = (polarizance + image) / (1.0 + D), (polarizance - image) / gap
    p, along = 0.5 * (half_sum + half_difference), 0.5 * (half_sum - half_difference)
    across = (m - outer(image, d)) / np.sqrt(gap * (1.0 + D))[..., np.newaxis]
    return p, *_depolarizer_and_turn(across + outer(along, d), _ROUNDING / gap)


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


def _diattenuation(root: Array, d: Array) -> Array:
    a = root[..., np.newaxis]
    return np.asarray(a * _UNIT + (1.0 - a) * outer(d, d))


def _bordered(row: Array, column: Array, lower: Array) -> Array:
    bordered = np.empty((*lower.shape[:-2], 4, 4))
    bordered[..., 0, 0] = 1.0
    bordered[..., 0, 1:], bordered[..., 1:, 0], bordered[..., 1:, 1:] = row, column, lower
    return bordered
