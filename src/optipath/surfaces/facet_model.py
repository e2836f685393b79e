"""Facet model: analytic single scattering by rough surfaces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.fresnel import number_within, parts_of
from optipath.errors import SurfaceError
from optipath.faults import unknown
from optipath.kernels.catalog import REFLECTION
from optipath.kernels.facets import MASKINGS, facet_scattering
from optipath.kernels.primitives import Made
from optipath.light.frame import Frame, vectors
from optipath.light.mueller import Mueller
from optipath.materials.index_domains import INDEX, OUTSIDE
from optipath.materials.material import Material
from optipath.paths.files.schema import Faults
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.hemisphere.sensor import pixel_points
from optipath.surfaces.sample import depends_on_wavelength
from optipath.values.arrays import check_broadcast, first_place
from optipath.values.domains import Domain
from optipath.values.jax_values import check_known, is_traced, namespace
from optipath.values.operands import kernel_values
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.kernels.facets import Masking
    from optipath.surfaces.hemisphere.beam import SensedBeam
    from optipath.surfaces.sample import Sample
    from optipath.values.precision import Numbers


def single_scattering(
    index: npt.ArrayLike | Material,
    alpha: npt.ArrayLike,
    incoming: npt.ArrayLike,
    outgoing: npt.ArrayLike,
    *,
    outside: npt.ArrayLike | Material = 1.0,
    alpha_y: npt.ArrayLike | None = None,
    masking: Masking = "smith",
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
    arguments = {"index": index, "outside": outside, "alpha": alpha}
    arguments |= {} if alpha_y is None else {"alpha_y": alpha_y}
    faults = Faults(unknown("masking", masking, MASKINGS))
    if wavelength is not None and not any(map(depends_on_wavelength, (index, outside))):
        faults.append("wavelength is given, but no medium depends on it; leave it out")
    numbers: dict[str, Any] = {
        name: faults.attempt("", _number, name, arguments[name], wavelength)
        for name in _DOMAINS
        if name in arguments
    }
    before: Any = faults.attempt("", frame_along, "incoming", incoming, up=False)
    behind: Any = faults.attempt("", frame_along, "outgoing", outgoing, up=True)
    if not faults:
        shaped = numbers | {"incoming": before.z[..., 0], "outgoing": behind.z[..., 0]}
        faults.attempt("", check_broadcast, {name: each.shape for name, each in shaped.items()})
    SurfaceError.raise_for(faults)
    alphas = numbers["alpha"], numbers.get("alpha_y", numbers["alpha"])
    media: tuple[Any, ...] = numbers["outside"], *parts_of(numbers["index"])
    kernel, media = REFLECTION.methods["stable"].specialised(media, _vanishes)
    axes = (before.z, before.x, behind.z, behind.x)
    vectors = (part for axis in axes for part in np.moveaxis(axis, -1, 0))
    entries = kernel_values(Made(facet_scattering, kernel, masking), *alphas, *vectors, *media)
    matrix = namespace(entries[0]).stack(entries, axis=-1)
    return Mueller.of(matrix.reshape(*matrix.shape[:-1], 4, 4), before, behind)


def _vanishes(number: Any) -> bool:
    return not is_traced(number) and not np.any(number)


_ALPHA = Domain("alpha above 0", minimum=1e-12, maximum=1e6)
_DOMAINS = {"outside": OUTSIDE, "index": INDEX, "alpha": _ALPHA, "alpha_y": _ALPHA}


def _number(name: str, value: Any, wavelength: Any) -> Any:
    """Return a number, or what JAX traces; an index at the wavelength."""
    if depends_on_wavelength(value):
        if wavelength is None:
            raise SurfaceError(f"{name} depends on the wavelength; give one, wavelength='550 nm'")
        value = value.at(wavelength)
    parts = (value.n, value.k) if isinstance(value, Material) else (value,)
    if open_ones := [part for part in parts if isinstance(part, Parameter)]:
        raise SurfaceError(
            f"{name} follows from the parameter '{open_ones[0].name}', and the model takes "
            f"numbers; give them, one or an array"
        )
    return number_within(_DOMAINS[name], name, value)


_UNIT = 1e-8
_LAST_DIGITS = 2.0**-50
_LEVEL = 2.0**-52
"""The z of a direction that is along the surface, to rounding."""


def frame_along(name: str, direction: npt.ArrayLike, *, up: bool) -> Frame:
    """Return the frame of light that comes down to a surface, or goes up from it.

    Its x is along (0, 0, 1) cross direction (..., 3); along the normal it is (0, 1, 0).
    """
    check_known(name, direction)
    argument, rounding = vectors(name, direction)
    length = np.linalg.norm(argument, axis=-1)
    if np.any(bad := np.abs(length - 1.0) > max(_UNIT, 2.0 * rounding)):
        raise SurfaceError(
            f"{name}{first_place(bad)} is no unit vector; divide it by its length, "
            f"v / np.linalg.norm(v, axis=-1, keepdims=True)"
        )
    # What is one to the last digits keeps them, by which directions next to each other differ.
    z = argument / np.where(np.abs(length - 1.0) > _LAST_DIGITS, length, 1.0)[..., np.newaxis]
    height = z[..., 2] if up else -z[..., 2]
    if np.any(bad := height < max(rounding, _LEVEL)):
        way, sign = ("up from", "above") if up else ("down to", "below")
        raise SurfaceError(
            f"{name}{first_place(bad)} has z = {z[..., 2][bad].flat[0]:.6g}; it is the direction "
            f"in which light travels {way} the surface, so give a z {sign} 0"
        )
    size = np.hypot(z[..., 0], z[..., 1])[..., np.newaxis]
    level = np.stack([-z[..., 1], z[..., 0], np.zeros(z.shape[:-1])], axis=-1)
    # Adding 0 turns -0 into 0.
    x = np.where(size == 0.0, (0.0, 1.0, 0.0), level / np.where(size == 0.0, 1.0, size)) + 0.0
    return Frame.trusted(x, np.cross(z, x), z, rounding)


def alpha_of(sample: Sample) -> tuple[float, float] | None:
    """Return alpha of the topmost surface along x and y; None where it has none above 0."""
    rough = sample.layers[0].roughness
    alpha = rough.alpha if isinstance(rough, HeightField) else rough
    return alpha if alpha and alpha != (0.0, 0.0) else None


def reflected_once(
    seen: SensedBeam, alpha: tuple[float, float], masking: str, points: int
) -> Numbers:
    """Return Mueller matrices, (rows, columns, wavelengths, 4, 4)."""
    beam, indices = seen.beam, seen.beam.indices
    below: Any = np.array(indices.inner[:1]) if indices.inner else np.ravel(indices.base)
    comes = Mueller(np.eye(4), beam.frame, beam.frame)
    lights = indices.n.size
    total = np.zeros((*(2 * [seen.sensor.pixels]), lights, 4, 4))
    model: dict[str, Any] = {"outside": indices.outside, "alpha_y": alpha[1], "masking": masking}
    for directions, areas in pixel_points(seen.sensor, points):
        outgoing = directions[:, :, np.newaxis]
        result = single_scattering(below, alpha[0], beam.frame.z, outgoing, **model)
        weight = (areas * directions[..., 2])[..., np.newaxis, np.newaxis, np.newaxis]
        total += (result @ comes).matrix * weight
    return total
