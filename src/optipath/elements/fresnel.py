"""Fresnel reflection and transmission by themselves, for those who need no path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.single_boundary import (
    given_cosine_and_sine,
    given_incidence,
    given_index,
    parts_of,
)
from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.catalogue import REFLECTION, TRANSMISSION
from optipath.kernels.fresnel.inhomogeneous import phase_index
from optipath.kernels.fresnel.refraction import refraction
from optipath.kernels.numbers.primitives import NUMPY
from optipath.values.arrays.jax_values import check_known
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.domains.indices import INDEX
from optipath.values.precision import precision

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.kernels.carriers.kernel import KernelFamily
    from optipath.values.angles import CosSin


def fresnel_reflection(
    index: npt.ArrayLike,
    cos_incidence: npt.ArrayLike,
    sin_incidence: npt.ArrayLike,
    method: str = "stable",
    dtype: npt.DTypeLike = "float64",
) -> tuple[npt.NDArray[Any], ...]:
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
    method : {"stable", "compensated", "amplitude", "textbook"}, optional
        How Fresnel's equations are computed.
    dtype : {"float64", "float32", "longdouble"}, optional
        The precision of the computation and of the result, or what NumPy takes for it.

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
        If there is no such method or precision.

    Examples
    --------
    >>> A, B, C, S = fresnel_reflection(1.5, 1.0, 0.0)
    >>> float(A.round(12)), float(B), float(S)
    (0.04, 0.0, 0.0)
    """
    return _fresnel(REFLECTION, index, cos_incidence, sin_incidence, method, dtype)


def fresnel_transmission(
    index: npt.ArrayLike,
    cos_incidence: npt.ArrayLike,
    sin_incidence: npt.ArrayLike,
    method: str = "stable",
    dtype: npt.DTypeLike = "float64",
) -> tuple[npt.NDArray[Any], ...]:
    """Return (A, B, C, S) of the Mueller matrix of the power that a boundary lets through.

    The matrix has the form that `fresnel_reflection` gives; ``A + B`` and ``A - B`` are
    1 less what is reflected, ``C = sqrt((A + B)(A - B))`` and ``S = 0``, and all four are 0
    in total reflection. Behind the boundary of a medium that absorbs, C and S have the
    phase between t_s and t_p of the field just there. It is power that is carried: a radiance
    is multiplied by (n2 / n1)^2 besides (Nicodemus, Am. J. Phys. 31, 368 (1963)).

    Parameters
    ----------
    index, cos_incidence, sin_incidence, method, dtype
        As for `fresnel_reflection`.

    Returns
    -------
    tuple of four ndarray
        Of the broadcast shape.

    Raises
    ------
    ValueFault, ShapeError, ComposerError
        As `fresnel_reflection` does.

    Examples
    --------
    >>> A, B, C, S = fresnel_transmission(1.5, 1.0, 0.0)
    >>> float(A), float(B), float(C), float(S)
    (0.96, 0.0, 0.96, 0.0)
    """
    return _fresnel(TRANSMISSION, index, cos_incidence, sin_incidence, method, dtype)


def _fresnel(
    family: KernelFamily, index: Any, cos: Any, sin: Any, method: str, dtype: npt.DTypeLike
) -> tuple[npt.NDArray[Any], ...]:
    kernel, kind = family.by_method(method), precision(dtype)
    for value in (index, cos, sin):
        check_known("Fresnel's equations of a Mueller matrix", value)
    m = INDEX.check("index", index)
    c, s = given_cosine_and_sine(cos, sin)
    shapes = {"index": m.shape, "cos_incidence": c.shape, "sin_incidence": s.shape}
    shape = check_broadcast(shapes)
    # Adding 0 turns -0 into 0.
    given = (np.ones(()), *(part + 0.0 for part in (m.real, m.imag, c, s)))
    with np.errstate(all="ignore"):
        kernel, left = kernel.specialised([np.asarray(x, kind) for x in given], _vanishes)
        numbers = kernel.made_for(NUMPY)(*left)
        (A, B, _, _), _, (_, _, C, S), _ = BLOCK.rows(NUMPY, numbers)
    return tuple(np.broadcast_to(number, shape).astype(kind) for number in (A, B, C, S))


def _vanishes(number: npt.NDArray[Any]) -> bool:
    return not np.any(number)


def refraction_angle(
    index: npt.ArrayLike, incidence: npt.ArrayLike | CosSin, outside: npt.ArrayLike = 1.0
) -> npt.NDArray[np.float64]:
    """Return the angle at which light travels on behind a boundary, by Snell's law.

    Behind a medium that absorbs, the real angle: that of planes of constant phase (Born &
    Wolf, Principles of Optics, sec. 14.2). Where all is reflected, light creeps along the
    boundary, and the angle is a right one.

    Parameters
    ----------
    index : array_like, real or complex
        The index n + ik of the medium behind.
    incidence : array_like
        The angle of incidence in radians, 0 to pi/2, or a `CosSin`.
    outside : array_like, optional
        The index n + ik of the medium in front, n above 0. Where it absorbs, the incidence is the
        real angle, too, between faces that are parallel.

    Returns
    -------
    ndarray
        In radians, of the broadcast shape.

    Raises
    ------
    ValueFault
        If a value is not allowed.
    ShapeError
        If the values do not broadcast.
    ParameterError
        If JAX traces one.

    Examples
    --------
    >>> print(np.degrees(refraction_angle(1.5, np.radians(40.0))).round(6))
    25.373994
    """
    for value in (index, incidence, outside):
        check_known("refraction_angle", value)
    m, front = given_index("index", index), given_index("outside", outside, lit=True)
    cos, sin = given_incidence(incidence)
    check_broadcast({"index": m.shape, "incidence": cos.shape, "outside": front.shape})
    n1, k1, n, k, cos, sin = np.broadcast_arrays(*parts_of(front), *parts_of(m), cos, sin)
    with np.errstate(all="ignore"):
        c, s = refraction(NUMPY)(*phase_index(NUMPY)(n1, k1, cos, sin), n, k, cos, sin)
    return np.asarray(np.arctan2(s, c))
