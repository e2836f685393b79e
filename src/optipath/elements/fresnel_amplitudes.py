"""Fresnel's amplitudes by themselves: what becomes of the fields along s and along p."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.elements.single_boundary import (
    arriving_cosine,
    given_cosine_and_sine,
    given_index,
    parts_of,
)
from optipath.kernels.fresnel.single_amplitudes import single_amplitudes
from optipath.values.arrays.kernel_values import kernel_values
from optipath.values.arrays.shapes import check_broadcast

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from optipath.values.materials import Material


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
        Of the angle of incidence. Both are taken, so that grazing and normal incidence keep
        their digits.
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
    ValueFault
        If a value is not allowed, or light arrives at a right angle out of a medium that absorbs.
    ShapeError
        If the values do not broadcast.

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
    m, front = given_index("index", index), given_index("outside", outside, lit=True)
    c, s = given_cosine_and_sine(cos_incidence, sin_incidence)
    check_broadcast({"index": m.shape, "incidence": c.shape, "outside": front.shape})
    n1, k1 = parts_of(front)
    numbers = kernel_values(
        single_amplitudes, n1, k1, *parts_of(m), arriving_cosine(c, k1), s + 0.0
    )
    pairs = zip(numbers[::2], numbers[1::2], strict=True)
    return FresnelAmplitudes(*(_complex(re, im) for re, im in pairs))


def _complex(re: Any, im: Any) -> Any:
    return re + 1j * im
