"""The index that an absorbing medium has at an angle, by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from optipath.elements.single_boundary import (
    arriving_cosine,
    given_incidence,
    given_index,
    parts_of,
)
from optipath.kernels.fresnel import refraction
from optipath.values.arrays.kernel_values import kernel_values
from optipath.values.arrays.shapes import check_broadcast

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from optipath.values.angles import CosSin
    from optipath.values.materials import Material


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
    incidence : array_like or CosSin
        The angle of incidence in radians, 0 to pi/2.
    outside : array_like or Material, optional
        The index n + ik of the medium in front, n above 0. Where it absorbs, the incidence is
        the real angle, too, between faces that are parallel.

    Returns
    -------
    EffectiveIndex
        A tuple of two, of the broadcast shape. Where JAX traces a value they are JAX's, with
        their slopes.

    Raises
    ------
    ValueFault
        If a value is not allowed, or light arrives at a right angle out of a medium that absorbs.
    ShapeError
        If the values do not broadcast.

    Examples
    --------
    >>> gold = effective_index(0.608 + 2.12j, "60 deg")
    >>> print(gold.n.round(6), gold.k.round(6))
    1.034329 2.279161
    """
    m, front = given_index("index", index), given_index("outside", outside, lit=True)
    c, s = given_incidence(incidence)
    check_broadcast({"index": m.shape, "incidence": c.shape, "outside": front.shape})
    n1, k1 = parts_of(front)
    numbers = n1, k1, *parts_of(m), arriving_cosine(c, k1), s + 0.0
    return EffectiveIndex(*kernel_values(refraction.effective_index, *numbers))
