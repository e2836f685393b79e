"""The analytic model of rough surfaces whose facets reflect light once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.catalogue import REFLECTION
from optipath.kernels.facets.facet_scattering import FacetScattering
from optipath.light.mueller.matrix import Mueller
from optipath.surfaces.facets.facet_inputs import read_facets
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.kernel_values import kernel_values

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.materials import Material

_STABLE = REFLECTION.methods["stable"]


def single_scattering(
    index: npt.ArrayLike | Material,
    alpha: npt.ArrayLike,
    incoming: npt.ArrayLike,
    outgoing: npt.ArrayLike,
    *,
    outside: npt.ArrayLike | Material = 1.0,
    alpha_y: npt.ArrayLike | None = None,
    masking: str = "smith",
    wavelength: Any = None,
) -> Mueller:
    """Return the polarised BRDF of a rough surface whose facets reflect light once.

    The Mueller matrix of the facet halfway between the directions, times p / n_z^4 G / (4
    cos(theta_i) cos(theta_o)): p is Beckmann's density of slopes, n the facet's normal, and G the
    share of the facets that are seen along both directions, by Smith (R. L. Cook and K. E.
    Torrance, ACM Trans. Graphics 1, 7 (1982); M. Wang et al., Optics Express 25(19), 2017). It is
    per steradian; a factor cos(theta_o) is not in it, so that ``S_out cos(theta_o) dw`` is the
    share of the light that goes into dw. What facets reflect twice or let through is left out.

    Light comes in, and goes out, in frames with x perpendicular to the meridional plane, along
    (0, 0, 1) cross direction; of light along the normal x is (0, 1, 0).

    Parameters
    ----------
    index, outside : array_like, real or complex, or Material
        The indices n + ik below the surface and above it, where light does not fade. Index and
        roughness broadcast with the directions' leading axes.
    alpha : array_like
        The roughness along x, above 0: alpha^2 / 2 is the mean square slope along an axis.
    incoming, outgoing : array_like, shape (..., 3)
        Unit vectors along which light travels: down to the surface, whose normal is (0, 0, 1),
        and up from it.
    alpha_y : array_like, optional
        The roughness along y, where it is another.
    masking : {"smith", "separate", "none"}, optional
        Whether G is that of facets on one surface of heights, the product of what is seen along
        each direction, or 1.
    wavelength : float, str or array_like, optional
        In vacuum, in metres or with a unit, for a Material that depends on it.

    Returns
    -------
    Mueller
        In 1 / sr, of the broadcast shape. Where JAX traces indices or alphas, its matrix is
        JAX's, with its slopes.

    Raises
    ------
    SurfaceError
        With a sentence for each value that is not allowed.

    Examples
    --------
    >>> down, up = (0.6, 0.0, -0.8), (0.6, 0.0, 0.8)
    >>> brdf = single_scattering(1.5, 0.3, down, up)
    >>> print(brdf.matrix.round(4))
    [[ 0.0606  0.0359  0.      0.    ]
     [ 0.0359  0.0606  0.      0.    ]
     [ 0.      0.     -0.0489  0.    ]
     [ 0.      0.      0.     -0.0489]]
    >>> single_scattering(1.5, 0.3, down, [up, (0.0, 0.0, 1.0)]).polarizance.round(3)
    array([0.591, 0.143])
    """
    given = {"index": index, "outside": outside, "alpha": alpha}
    given |= {} if alpha_y is None else {"alpha_y": alpha_y}
    given |= {"incoming": incoming, "outgoing": outgoing}
    media, alphas, before, behind = read_facets(given, masking, wavelength)
    kernel, media = _STABLE.specialised(media, _vanishes)
    axes = (before.z, before.x, behind.z, behind.x)
    vectors = (part for axis in axes for part in np.moveaxis(axis, -1, 0))
    numbers = kernel_values(FacetScattering(kernel, masking), *alphas, *vectors, *media)
    matrix = namespace(numbers[0]).stack(numbers, axis=-1)
    return Mueller.of(matrix.reshape(*matrix.shape[:-1], 4, 4), before, behind)


def _vanishes(number: Any) -> bool:
    return not is_traced(number) and not np.any(number)
