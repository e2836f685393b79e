"""Decompositions of Mueller matrices: reciprocity, polar parts, Cloude's coherency matrix.

S.-Y. Lu and R. A. Chipman, J. Opt. Soc. Am. A 13, 1106 (1996). With d the direction of the
diattenuation vector, D its length, P the polarizance vector and m the lower right 3x3 part,
all over M00, M = M_depolarizer M_retarder M_diattenuator where

    M_diattenuator = M00 [[1, D d'], [D d, a 1 + (1 - a) d d']],  a = sqrt(1 - D^2),
    M_depolarizer M_retarder = [[1, 0], [p, m']],  p = (P - m D d) / (1 - D^2),
    m' = m (1 - d d') / a + (m d - D P) d' / (1 - D^2) = m_depolarizer m_retarder,

the last by singular values. Sums and differences of p and m' d lose fewer digits. What does not
depolarise has the parts of its Jones matrix, which lose none where little is let through.

Of a Jones matrix T = c_0 s_0 + ... + c_3 s_3, with its phase such that its determinant
c_0^2 - c_1^2 - c_2^2 - c_3^2 is positive, the unitary part is, but for its
size, Re c_0 s_0 + i (Im c_1 s_1 + ...).

S. R. Cloude, Optik 75, 26 (1986); Proc. SPIE 1166, 177 (1989).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.faults import shown
from optipath.kernels.carriers.structures import FROM_MUELLER, TO_MUELLER
from optipath.light.polarization_state import norm
from optipath.values.jax_values import check_known, known
from optipath.values.precision import real_number, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.precision import Array


_MIRRORED = np.array([1, 1, -1, 1], np.int8)
_SIGNS = np.outer(_MIRRORED, _MIRRORED)
"""Those of Q M Q, entry by entry, for Q = diag(1, 1, -1, 1)."""


def reciprocal(matrix: Any) -> Any:
    """Return Q M^T Q, Q = diag(1, 1, -1, 1): M backwards, between mirrored frames (x, -y, -z).

    De Hoop, Appl. Sci. Res. B 8, 135 (1960); Sekera, J. Opt. Soc. Am. 56, 1732 (1966).

    >>> matrix = np.arange(16.0).reshape(4, 4)
    >>> print(reciprocal(matrix)[2])
    [ -2.  -6.  10. -14.]
    >>> bool(np.all(reciprocal(reciprocal(matrix)) == matrix))
    True
    """
    # Adding 0 turns -0 into 0.
    return known(matrix).swapaxes(-1, -2) * _SIGNS + 0


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
    numbers, finite = finite_numbers(matrix)
    m00 = numbers[..., :1, :1]
    lit = np.abs(m00) > _DARK * np.abs(numbers).max(axis=(-1, -2), keepdims=True)
    whole = np.where(lit, m00, 1.0)
    unit = np.where(lit, numbers / whole, np.eye(4))
    polarizance = unit[..., 1:, 0]
    rounding = _rounding(matrix, whole[..., 0])
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
    a = root[..., np.newaxis]
    diattenuator = _bordered(D * d, D * d, a * _UNIT + (1.0 - a) * outer(d, d))
    depolarizer = _bordered(none, np.where(ideal | pure, 0.0, p), depolarizing)
    retarder = _bordered(none, none, turn)
    parts = depolarizer, retarder, m00 * diattenuator
    return tuple(np.where(finite, part, np.nan) for part in parts)  # type: ignore[return-value]


@np.errstate(over="ignore")
def _rounding(matrix: Any, m00: Array) -> Array:
    """Return what may be rounding in matrices over M00, shape (..., 1).

    Rounding of the parts, which let 1 through at most, is larger against an M00 that they block.
    """
    least = max(_ROUNDING, 64.0 * rounding_of(matrix))
    return np.clip(least / np.abs(m00), least, max(least, _MOST))


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


def _bordered(row: Array, column: Array, lower: Array) -> Array:
    bordered = np.empty((*lower.shape[:-2], 4, 4))
    bordered[..., 0, 0] = 1.0
    bordered[..., 0, 1:], bordered[..., 1:, 0], bordered[..., 1:, 1:] = row, column, lower
    return bordered


def jones_parts(unit: Array, tolerance: Array) -> tuple[Array, Array, Array]:
    """Return which matrices over their M00 are pure, their sqrt(1 - D^2), and their rotations.

    Pure: one eigenvalue of the coherency. Shapes: returns pure (..., 1), root (..., 1), rotation
    (..., 3, 3).
    """
    coherency = gathered(unit)
    # Each column is (c_0, c_1, c_2, c_3) times the conjugate of one of them.
    powers = np.diagonal(coherency, axis1=-2, axis2=-1).real
    largest = np.argmax(powers, axis=-1)[..., np.newaxis]
    power = np.take_along_axis(powers, largest, axis=-1)
    c = np.take_along_axis(coherency, largest[..., np.newaxis], axis=-1)[..., 0] / np.sqrt(power)

    rest = coherency - c[..., :, np.newaxis] * c.conj()[..., np.newaxis, :]
    pure = np.abs(rest).max(axis=(-1, -2), initial=0.0)[..., np.newaxis] <= tolerance

    determinant = c[..., :1] ** 2 - np.sum(c[..., 1:] ** 2, axis=-1, keepdims=True)
    root = np.abs(determinant)
    phase = np.sqrt(np.where(root == 0.0, 1.0, determinant / np.where(root == 0.0, 1.0, root)))
    c = c * phase.conj()
    return pure, root, rotation(c[..., 0].real, c[..., 1:].imag)


_NOTHING = 2.0**-960


def least_turn(a: Array, b: Array) -> Array:
    """Return the rotations (..., 3, 3) by the least angle that turn unit vectors a into b."""
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
    """Return the rotations (..., 3, 3) of S1, S2, S3 by the unitary w s_0 + i (v_1 s_1 + ...)."""
    size = np.sqrt(w**2 + np.sum(v**2, axis=-1))[..., np.newaxis]
    w, v = (w[..., np.newaxis] / size)[..., np.newaxis], v / size
    across = 1.0 - 2.0 * np.sum(v**2, axis=-1)[..., np.newaxis, np.newaxis]
    crossed = np.cross(v[..., np.newaxis, :], _UNIT)
    return np.asarray(across * _UNIT + 2.0 * outer(v, v) + 2.0 * w * crossed)


def size_and_direction(vector: Array) -> tuple[Array, Array]:
    """Return lengths, shape (..., 1), and unit vectors; 0 and 0 for what has too few digits."""
    size = norm(vector)[..., np.newaxis]
    none = size < _NOTHING
    return np.where(none, 0.0, size), np.where(none, 0.0, vector / np.where(none, 1.0, size))


def outer(a: Array, b: Array) -> Array:
    """Return the products (..., 3, 3) of each component with each."""
    return np.asarray(a[..., :, np.newaxis] * b[..., np.newaxis, :])


def turn_of(retarder: Any) -> tuple[Array, Array]:
    """Return the axis and the angle in [0, pi] of rotations, by the largest of four columns.

    Each column is the unit quaternion (cos R/2, sin R/2 times the axis) times one of its parts.
    """
    r = np.asarray(retarder)[..., 1:, 1:]
    xx, yy, zz = r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]
    x, y, z = (r[..., i, j] - r[..., j, i] for i, j in ((2, 1), (0, 2), (1, 0)))
    xy, xz, yz = (r[..., i, j] + r[..., j, i] for i, j in ((0, 1), (0, 2), (1, 2)))
    columns = stacked(
        [
            [1 + xx + yy + zz, x, y, z],
            [x, 1 + xx - yy - zz, xy, xz],
            [y, xy, 1 - xx + yy - zz, yz],
            [z, xz, yz, 1 - xx - yy + zz],
        ]
    )
    largest = np.argmax(np.diagonal(columns, axis1=-2, axis2=-1), axis=-1)
    column = np.take_along_axis(columns, largest[..., np.newaxis, np.newaxis], axis=-2)[..., 0, :]
    column = np.where(column[..., :1] < 0.0, -column, column)
    sine = norm(column[..., 1:])
    axis = column[..., 1:] / np.where(sine == 0.0, 1.0, sine)[..., np.newaxis]
    return axis, np.asarray(2.0 * np.arctan2(sine, column[..., 0]))


def finite_numbers(matrix: Any) -> tuple[Array, Array]:
    """Return matrices as doubles, 0 where an entry is not finite, and which are (..., 1, 1)."""
    check_known("what a Mueller matrix is made of (by its coherency, or Lu and Chipman)", matrix)
    numbers = np.asarray(matrix, np.float64)
    finite = np.isfinite(numbers).all(axis=(-1, -2), keepdims=True)
    return np.where(finite, numbers, 0.0), finite


# Of double precision.
_TOLERANCE = 1e-9


def coherency(matrix: Array) -> Array:
    """Return the coherency matrices, shape (..., 4, 4), complex; NaN all over where an entry is."""
    numbers, finite = finite_numbers(matrix)
    return np.where(finite, gathered(numbers), complex(np.nan, np.nan))


def eigenvalues(matrix: Array) -> Array:
    """Return the eigenvalues of the coherency matrices, shape (..., 4), the largest first."""
    numbers, finite = finite_numbers(matrix)
    result = np.linalg.eigvalsh(gathered(numbers))[..., ::-1]
    return np.where(finite[..., 0], result, np.nan)


def is_physical(matrix: Array, tolerance: float | None = None) -> Array:
    """Tell where no eigenvalue is below minus the tolerance times the largest; NaN is not."""
    check_known("the tolerance of is_physical", tolerance)
    number = tolerance_for(matrix) if tolerance is None else real_number(tolerance)
    if number is None or number < 0.0:
        raise ValueFault(
            f"the tolerance of is_physical is {shown(tolerance)}; give a number >= 0, or none"
        )
    return np.asarray(lack(matrix) <= number)


def lack(matrix: Array) -> Array:
    """Return by which share of the largest eigenvalue the least one is below 0; NaN or inf."""
    values = eigenvalues(matrix)
    largest, below = values[..., 0], np.maximum(-values[..., 3], 0.0)
    share = below / np.where(largest > 0.0, largest, 1.0)
    return np.asarray(np.where((below > 0.0) & (largest <= 0.0), np.inf, share))


def tolerance_for(matrix: Array) -> float:
    """Return what a matrix may lack, having been rounded in the precision of its numbers."""
    return tolerance_of(rounding_of(matrix))


def tolerance_of(rounding: float) -> float:
    """Return what a matrix may lack whose numbers have been rounded so, those near 1."""
    return max(_TOLERANCE, 100.0 * rounding)


def nearest_physical(matrix: Array) -> Array:
    """Return the matrices without what has negative eigenvalues."""
    numbers, finite = finite_numbers(matrix)
    values, vectors = np.linalg.eigh(gathered(numbers))
    stored = vectors * np.maximum(values, 0.0)[..., np.newaxis, :]
    positive = stored @ np.swapaxes(vectors.conj(), -1, -2)
    result = (positive.reshape(*numbers.shape[:-2], 16) @ TO_MUELLER).real
    return np.where(finite, result.reshape(numbers.shape), np.nan)


def gathered(parts: Array) -> Array:
    """Return the coherency matrices of matrices of finite entries."""
    flat = parts.reshape(*parts.shape[:-2], 16) @ FROM_MUELLER
    return np.asarray(flat.reshape(parts.shape))


def stacked(rows: Any) -> npt.NDArray[np.float64]:
    """Return rows of elementwise entries as one array of shape (..., 4, 4)."""
    entries = np.broadcast_arrays(*(entry for row in rows for entry in row))
    flat = np.stack(entries, axis=-1)
    return flat.reshape(*flat.shape[:-1], 4, 4)
