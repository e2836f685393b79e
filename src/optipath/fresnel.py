"""Fresnel reflection by itself, for those who need no path."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.domains import Domain, IndexDomain
from optipath.errors import ValueFault
from optipath.kernels import BLOCK, NUMPY, REFLECTION
from optipath.shapes import check_broadcast

if TYPE_CHECKING:
    import numpy.typing as npt

_INDEX = IndexDomain("index of refraction")
_COSINE = Domain("cosine or sine", minimum=0.0, maximum=1.0)


def fresnel_reflection(
    index: npt.ArrayLike,
    cos_incidence: npt.ArrayLike,
    sin_incidence: npt.ArrayLike,
    method: str = "stable",
) -> tuple[npt.NDArray[np.float64], ...]:
    """Return (A, B, C, S) of the Mueller matrix of a reflection.

    The matrix is ``[[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]`` in
    frames with x = s, with ``C + i S = r_s conj(r_p)`` and the field exp(-i w t).

    Parameters
    ----------
    index : array_like, real or complex
        The relative index m2 / m1 = n + ik, n and k not negative.
    cos_incidence, sin_incidence : array_like
        Of the angle of incidence. Both are taken, so that grazing and normal
        incidence keep their digits. They broadcast with the index.
    method : {"stable", "textbook"}, optional
        How Fresnel's equations are computed.

    Returns
    -------
    tuple of four ndarray
        Of the broadcast shape.

    Raises
    ------
    ValueFault
        If a value is not allowed.
    ShapeError
        If the values do not broadcast.
    ComposerError
        If there is no such method.

    Examples
    --------
    >>> A, B, C, S = fresnel_reflection(1.5, 1.0, 0.0)
    >>> float(A), float(B), float(S)
    (0.04, 0.0, 0.0)
    """
    m = _INDEX.check("index", index)
    c = _COSINE.check("cos_incidence", cos_incidence)
    s = _COSINE.check("sin_incidence", sin_incidence)
    shapes = {"index": m.shape, "cos_incidence": c.shape, "sin_incidence": s.shape}
    shape = check_broadcast(shapes)
    if np.any(np.abs(np.hypot(c, s) - 1.0) > 1e-6):
        raise ValueFault("cos_incidence and sin_incidence belong to no angle: c^2 + s^2 is not 1")
    reflect = REFLECTION.by_method(method).made_for(NUMPY)
    numbers = reflect(1.0, m.real, m.imag + 0.0, c, s)
    (A, B, _, _), _, (_, _, C, S), _ = BLOCK.rows(NUMPY, numbers)
    return tuple(np.broadcast_to(number, shape).copy() for number in (A, B, C, S))
