"""The analytic model of rough surfaces whose facets reflect light once."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.single_boundary import number_within, parts_of
from optipath.errors import OptipathError, SurfaceError, ValueFault, unknown
from optipath.kernels.catalogue import REFLECTION
from optipath.kernels.facets.facet_scattering import FacetScattering
from optipath.kernels.facets.smith_masking import MASKINGS
from optipath.light.mueller.matrix import Mueller
from optipath.surfaces.directions import frame_along
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.kernel_values import kernel_values
from optipath.values.arrays.shapes import check_broadcast, first_place
from optipath.values.domains.domain import Domain
from optipath.values.domains.indices import INDEX, OUTSIDE
from optipath.values.materials import Material

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt


class _AlphaDomain(Domain):
    """The roughness of a surface that has a density of slopes."""

    def read(self, owner: str, value: Any) -> Any:
        if isinstance(value, (list, tuple)) and len(value) == 2:
            raise ValueFault(
                f"{owner} is {value}, which may be along x and y, or of two surfaces; give alpha= "
                f"and alpha_y= for the one, np.array({list(value)}) for the other"
            )
        return super().read(owner, value)

    def _check_numbers(self, owner: str, array: Any, rounding: float) -> None:
        if array.dtype.kind == "f" and np.any(bad := array <= 0.0):
            raise ValueFault(
                f"{owner} is {array[bad].flat[0]:g}{first_place(bad)}, and a flat surface has no "
                f"density of slopes; give an alpha above 0, or take an Interface"
            )
        super()._check_numbers(owner, array, rounding)


_ALPHA = _AlphaDomain("alpha", minimum=1e-12, maximum=1e12)
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
    faults = unknown("masking", masking, MASKINGS) + _unused(wavelength, index, outside)
    read = partial(_read, faults)
    n1 = read(_number_at, OUTSIDE, "outside", outside, wavelength)
    m = read(_number_at, INDEX, "index", index, wavelength)
    alpha_x = read(number_within, _ALPHA, "alpha", alpha)
    alpha_y = alpha_x if alpha_y is None else read(number_within, _ALPHA, "alpha_y", alpha_y)
    before = read(frame_along, "incoming", incoming, up=False)
    behind = read(frame_along, "outgoing", outgoing, up=True)
    if not faults:
        shapes = {"outside": n1, "index": m, "alpha": alpha_x, "alpha_y": alpha_y}
        shapes |= {"incoming": before.z[..., 0], "outgoing": behind.z[..., 0]}
        read(check_broadcast, {name: value.shape for name, value in shapes.items()})
    if faults:
        raise SurfaceError(*faults)
    axes = (before.z, before.x, behind.z, behind.x)
    vectors = (part for axis in axes for part in np.moveaxis(axis, -1, 0))
    kernel, media = _STABLE.specialised((n1, *parts_of(m)), _vanishes)
    factory = FacetScattering(kernel, masking)
    numbers = kernel_values(factory, alpha_x, alpha_y, *vectors, *media)
    matrix = namespace(numbers[0]).stack(numbers, axis=-1)
    return Mueller.of(matrix.reshape(*matrix.shape[:-1], 4, 4), before, behind)


def _read(faults: list[str], reader: Callable[..., Any], *given: Any, **named: Any) -> Any:
    """Return what a reader makes of what is given, or keep the faults that it finds."""
    try:
        return reader(*given, **named)
    except OptipathError as fault:
        faults.extend(fault.faults)
        return None


def _number_at(domain: Domain, name: str, index: Any, wavelength: Any) -> Any:
    if isinstance(index, Material) and wavelength is not None:
        index = index.at(wavelength)
    return number_within(domain, name, index)


def _unused(wavelength: Any, *indices: Any) -> list[str]:
    if wavelength is None or any(isinstance(index, Material) for index in indices):
        return []
    return ["wavelength is given, and no index is that of a Material; leave it out"]


def _vanishes(number: Any) -> bool:
    return not is_traced(number) and not np.any(number)
