"""What a Mueller matrix that does not depolarise does: the polar parts of its one Jones matrix.

With T = c_0 s_0 + ... + c_3 s_3, and its phase such that det T = c_0^2 - c_1^2 - c_2^2 - c_3^2
is positive, the unitary part of T is, but for its size, Re c_0 s_0 + i (Im c_1 s_1 + ...).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.light.mueller.cloude import gathered
from optipath.light.mueller.sphere_rotations import rotation

if TYPE_CHECKING:
    from optipath.values.roundings import Array


def jones_parts(unit: Array, tolerance: Array) -> tuple[Array, Array, Array]:
    """Return which matrices over their M00 are pure, their sqrt(1 - D^2), and their rotations.

    What is pure has but one eigenvalue in its coherency.

    Shapes: unit (..., 4, 4); tolerance (..., 1); returns pure (..., 1), root (..., 1), rotation
    (..., 3, 3).

    Examples
    --------
    >>> half_wave = np.diag([1.0, 1.0, -1.0, -1.0])
    >>> pure, root, rotation = jones_parts(half_wave, np.array([1e-14]))
    >>> print(pure, root, rotation.diagonal())
    [ True] [1.] [ 1. -1. -1.]
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
