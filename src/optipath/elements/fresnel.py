"""Fresnel reflection, transmission and refraction of one boundary, as functions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import ValueFault
from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.catalog import REFLECTION, TRANSMISSION
from optipath.kernels.fresnel import boundary
from optipath.kernels.fresnel.boundary import phase_index, refraction
from optipath.kernels.fresnel.textbook import single_amplitudes
from optipath.kernels.primitives import NUMPY
from optipath.kernels.trigonometry import cosine, sine
from optipath.materials.index_domains import INDEX, LIT_INDEX
from optipath.materials.quantities import INCIDENCE
from optipath.values.angles import CosSin, is_angle, within_right_angle
from optipath.values.arrays import as_argument, check_broadcast, first_place
from optipath.values.domains import Domain
from optipath.values.jax_values import check_known, is_traced, namespace
from optipath.values.operands import kernel_values
from optipath.values.precision import precision

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.kernels.catalog import Method
    from optipath.kernels.kernel import KernelFamily
    from optipath.kernels.primitives import KernelFunction, Primitives
    from optipath.materials.material import Material
    from optipath.values.precision import Precision


class FresnelEntries(NamedTuple):
    """The entries of ``[[A, B, 0, 0], [B, A, 0, 0], [0, 0, C, S], [0, 0, -S, C]]``.

    Attributes
    ----------
    A, B : ndarray
        Half of the sum and of the difference of the powers along s and along p.
    C, S : ndarray
        What the field along s and that along p have in common: in phase, and a quarter apart.
    """

    A: npt.NDArray[Any]
    B: npt.NDArray[Any]
    C: npt.NDArray[Any]
    S: npt.NDArray[Any]


def fresnel_reflection(
    index: npt.ArrayLike,
    cos_incidence: npt.ArrayLike,
    sin_incidence: npt.ArrayLike,
    method: Method = "stable",
    dtype: Precision = "float64",
) -> FresnelEntries:
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
    FresnelEntries
        A tuple of four, of the broadcast shape.

    Raises
    ------
    ValueFault, ShapeError, ComposerError
        If a value is not allowed, values do not broadcast, or there is no such method or precision.

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
    method: Method = "stable",
    dtype: Precision = "float64",
) -> FresnelEntries:
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
    FresnelEntries
        A tuple of four, of the broadcast shape.

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
    family: KernelFamily, index: Any, cos: Any, sin: Any, method: str, dtype: Precision
) -> FresnelEntries:
    kernel, kind = family.by_method(method), precision(dtype)
    for value in (index, cos, sin):
        check_known("Fresnel's equations of a Mueller matrix", value)
    m = INDEX.check("index", index)
    c, s = plain_cosine_and_sine(cos, sin)
    shapes = {"index": m.shape, "cos_incidence": c.shape, "sin_incidence": s.shape}
    shape = check_broadcast(shapes)
    # Adding 0 turns -0 into 0.
    arguments = (np.ones(()), *(part + 0.0 for part in (m.real, m.imag, c, s)))
    with np.errstate(all="ignore"):
        values = [np.asarray(number, kind) for number in arguments]
        kernel, left = kernel.specialised(values, lambda number: not np.any(number))
        numbers = kernel.made_for(NUMPY)(*left)
        (A, B, _, _), _, (_, _, C, S), _ = BLOCK.rows(NUMPY, numbers)
    return FresnelEntries(*[np.broadcast_to(n, shape).astype(kind) for n in (A, B, C, S)])


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
    ValueFault, ShapeError, ParameterError
        If a value is not allowed, light arrives at a right angle out of a medium that absorbs,
        values do not broadcast, or JAX traces one.

    Examples
    --------
    >>> print(np.degrees(refraction_angle(1.5, np.radians(40.0))).round(6))
    25.373994
    """
    for value in (index, incidence, outside):
        check_known("refraction_angle", value)
    numbers = _media_and_angle(index, outside, incidence_argument(incidence))
    n1, k1, n, k, cos, sin = np.broadcast_arrays(*numbers)
    with np.errstate(all="ignore"):
        c, s = refraction(NUMPY)(*phase_index(NUMPY)(n1, k1, cos, sin), n, k, cos, sin)
    return np.asarray(np.arctan2(s, c))


class FresnelAmplitudes(NamedTuple):
    """What becomes of a field of amplitude 1 at a boundary.

    Attributes
    ----------
    r_s, r_p : ndarray of complex
        Reflected along s and along p.
    t_s, t_p : ndarray of complex
        Let through, just behind the boundary.
    """

    r_s: npt.NDArray[np.complex128]
    r_p: npt.NDArray[np.complex128]
    t_s: npt.NDArray[np.complex128]
    t_p: npt.NDArray[np.complex128]


def fresnel_amplitudes(
    index: npt.ArrayLike | Material,
    cos_incidence: npt.ArrayLike,
    sin_incidence: npt.ArrayLike,
    outside: npt.ArrayLike | Material = 1.0,
) -> FresnelAmplitudes:
    """Return the complex amplitudes (r_s, r_p, t_s, t_p) of a boundary.

    Each is the electric field over that which arrives, of fields exp(-i w t): along s, which is
    the same before and behind, and along p = z cross s of each wave, so that r_p = -r_s at normal
    incidence. In a wave that fades, p is a complex vector of square 1, and t_p is n1 / m2 times
    the ratio of the magnetic fields. ``|r|**2`` is what is reflected, ``r_s * conj(r_p)`` the
    C + iS of `fresnel_reflection`, and what is let through is ``|t_s|**2 Re(g2) / Re(g1)`` and
    ``|t_p|**2 Re(m2 conj(g2 / m2)) / Re(m1 conj(g1 / m1))``, with g = sqrt(m^2 - y^2) along the
    normal. Phases are those of the fields at the boundary; a field of positive phase lags (S. J.
    Byrnes, arXiv:1603.02720, equations 6 and 21 to 23; Born & Wolf, Principles of Optics, sec.
    1.5.2 and 14.2).

    Parameters
    ----------
    index : array_like, real or complex, or Material
        The index n + ik of the medium behind, n and k not negative.
    cos_incidence, sin_incidence : array_like
        As for `fresnel_reflection`.
    outside : array_like or Material, optional
        The index n + ik of the medium in front, n above 0. Where it absorbs, the incidence is
        the real angle of the planes of constant phase, as `Interface` takes it.

    Returns
    -------
    FresnelAmplitudes
        A tuple of four, of the broadcast shape. Where JAX traces a value they are JAX's, with
        their slopes.

    Raises
    ------
    ValueFault, ShapeError
        As `refraction_angle` does.

    Examples
    --------
    >>> import numpy as np
    >>> r_s, r_p, t_s, t_p = fresnel_amplitudes(1.5, 0.8, 0.6)
    >>> print(r_s.real.round(6), r_p.real.round(6), t_s.real.round(6), t_p.real.round(6))
    -0.264291 0.133939 0.735709 0.75596
    >>> gold = fresnel_amplitudes(0.608 + 2.12j, 0.8, 0.6)
    >>> print(np.degrees(np.angle(gold.r_s)).round(3), np.degrees(np.angle(gold.r_p)).round(3))
    -142.201 59.497
    """
    angle = plain_cosine_and_sine(cos_incidence, sin_incidence)
    numbers = kernel_values(single_amplitudes, *_media_and_angle(index, outside, angle))
    pairs = zip(numbers[::2], numbers[1::2], strict=True)
    r_s, r_p, t_s, t_p = (re + 1j * im for re, im in pairs)
    return FresnelAmplitudes(r_s, r_p, t_s, t_p)


class EffectiveIndex(NamedTuple):
    """The index of an absorbing medium at an angle.

    Attributes
    ----------
    n : ndarray
        By which Snell's law holds for the real angle: planes of constant phase travel on with
        the speed of light over n, along the real direction.
    k : ndarray
        How the field fades along the normal, by exp(-2 pi k depth / wavelength).
    """

    n: npt.NDArray[np.float64]
    k: npt.NDArray[np.float64]


def effective_index(
    index: npt.ArrayLike | Material,
    incidence: npt.ArrayLike | CosSin,
    outside: npt.ArrayLike | Material = 1.0,
) -> EffectiveIndex:
    """Return (n', k') of the inhomogeneous wave that light is behind a boundary.

    Behind the boundary planes of constant phase travel on at the real angle of refraction theta'
    (`refraction_angle`), with n' sin(theta') = n1 sin(incidence); planes of constant amplitude are
    parallel to the boundary. n'^2 - k'^2 = n^2 - k^2 and n' k' cos(theta') = n k (Born & Wolf,
    Principles of Optics, sec. 14.2; P. E. Ciddor, Am. J. Phys. 44, 786 (1976)). At normal
    incidence they are n and k. Without absorption n' is n, and behind total reflection
    n1 sin(incidence), with k' of the field that fades.

    Parameters
    ----------
    index : array_like, real or complex, or Material
        The index n + ik of the medium behind, n and k not negative.
    incidence, outside
        As `refraction_angle` takes them; `outside` may be a Material as well.

    Returns
    -------
    EffectiveIndex
        A tuple of two, of the broadcast shape. Where JAX traces a value they are JAX's, with
        their slopes.

    Raises
    ------
    ValueFault, ShapeError
        As `refraction_angle` does.

    Examples
    --------
    >>> gold = effective_index(0.608 + 2.12j, "60 deg")
    >>> print(gold.n.round(6), gold.k.round(6))
    1.034329 2.279161
    """
    numbers = _media_and_angle(index, outside, incidence_argument(incidence))
    return EffectiveIndex(*kernel_values(boundary.effective_index, *numbers))


COSINE = Domain("cosine or sine", minimum=0.0, maximum=1.0)
_APART, _GRAZING = 1e-6, 2.0**-60


def _media_and_angle(index: Any, outside: Any, angle: tuple[Any, Any]) -> tuple[Any, ...]:
    """Return n1, k1, n, k, cos and sin, each allowed, none -0; NaN where JAX traces others.

    At a right angle, media must not absorb: the wave along the face grows without limit next to it.
    """
    m, front = number_within(INDEX, "index", index), number_within(LIT_INDEX, "outside", outside)
    c, s = angle
    check_broadcast({"index": m.shape, "incidence": c.shape, "outside": front.shape})
    n1, k1, n, k = (part for each in (front, m) for part in parts_of(each))
    none = (k1 > 0.0) & (c <= _GRAZING)
    if is_traced(none):
        c = namespace(none).where(none, np.nan, c)
    elif np.any(none):
        raise ValueFault(
            f"incidence{first_place(none)} is a right angle out of a medium that absorbs, where "
            f"there is no such wave; give a smaller one, or an outside without k"
        )
    return n1, k1, n, k, c, s + 0.0


def number_within(domain: Domain, name: str, value: Any) -> Any:
    """Return a value that a domain allows; NaN where it does not and JAX traces the value."""
    numbers = domain.check(name, value)
    if not is_traced(numbers):
        return numbers
    return namespace(numbers).where(domain.allows(numbers), numbers, np.nan)


def plain_cosine_and_sine(cos: Any, sin: Any) -> tuple[Any, Any]:
    """Return the cosine and the sine of an incidence; NaN where JAX traces what is no angle."""
    several = {"cos_incidence": cos, "sin_incidence": sin}
    cos, sin = (
        value if is_traced(value) else as_argument(name, COSINE.read(name, value))
        for name, value in several.items()
    )
    check_broadcast({"cos_incidence": cos.shape, "sin_incidence": sin.shape})
    traced = is_traced(cos) or is_traced(sin)
    c = number_within(COSINE, "cos_incidence", cos if traced else within_right_angle(cos, sin))
    s = number_within(COSINE, "sin_incidence", sin)
    if traced:
        xp = namespace(c if is_traced(c) else s)
        belong = xp.abs(xp.square(c) + xp.square(s) - 1.0) <= _APART
        return xp.where(belong, c, xp.nan), s
    if not is_angle(cos, sin):
        raise ValueFault("cos_incidence and sin_incidence belong to no angle: c^2 + s^2 is not 1")
    return c, s


def incidence_argument(value: Any) -> tuple[Any, Any]:
    """Return the cosine and the sine of an incidence that is given as an angle, or a `CosSin`."""
    if isinstance(value, CosSin):
        return plain_cosine_and_sine(value.cos, value.sin)
    angle = number_within(INCIDENCE, "incidence", value)
    check_broadcast({"incidence": angle.shape})
    cos, sin = kernel_values(_cosine_and_sine, angle)
    return cos, sin


def parts_of(index: Any) -> tuple[Any, Any]:
    """Return n and k of indices, of which neither is -0."""
    if index.dtype.kind != "c":
        return index, np.zeros(())
    return index.real + 0.0, index.imag + 0.0


def _cosine_and_sine(xp: Primitives) -> KernelFunction:
    of_cos, of_sin = cosine(xp), sine(xp)
    return lambda angle: (of_cos(angle), of_sin(angle))
