"""What the analytic facet model is given: read, or refused in a sentence each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.elements.single_boundary import number_within, parts_of
from optipath.errors import SurfaceError, ValueFault, unknown
from optipath.kernels.facets.smith_masking import MASKINGS
from optipath.paths.format.faults import Faults
from optipath.surfaces.facets.directions import frame_along
from optipath.surfaces.samples.sample_media import depends_on_wavelength
from optipath.values.arrays.shapes import check_broadcast, first_place
from optipath.values.domains.domain import Domain
from optipath.values.domains.indices import INDEX, OUTSIDE
from optipath.values.materials import Material
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.light.frames import Frame


class PositiveAlpha(Domain):
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
                f"{owner} is {array[bad].flat[0]:g}{first_place(bad)}; give one above 0, or for a "
                f"flat surface, whose slopes have no density, take an Interface"
            )
        super()._check_numbers(owner, array, rounding)


ALPHA = PositiveAlpha("alpha", minimum=1e-12, maximum=1e6)
_DOMAINS = {"outside": OUTSIDE, "index": INDEX, "alpha": ALPHA, "alpha_y": ALPHA}


class FacetInputs(NamedTuple):
    """What the model is computed of."""

    media: tuple[Any, Any, Any]
    alphas: tuple[Any, Any]
    before: Frame
    behind: Frame


def read_facets(given: Mapping[str, Any], masking: str, wavelength: Any) -> FacetInputs:
    """Return what is given as numbers.

    Examples
    --------
    >>> up = {"incoming": (0, 0, -1), "outgoing": (0, 0, 1)}
    >>> given = {"index": 0.5 + 2j, "outside": 1.0, "alpha": 0.3} | up
    >>> list(map(float, read_facets(given, "smith", None).media))
    [1.0, 0.5, 2.0]
    """
    faults = Faults(unknown("masking", masking, MASKINGS))
    if wavelength is not None and not any(map(depends_on_wavelength, given.values())):
        faults.append("wavelength is given, but no medium depends on it; leave it out")
    numbers: dict[str, Any] = {
        name: faults.attempt("", _number, name, given[name], wavelength)
        for name in _DOMAINS
        if name in given
    }
    before: Any = faults.attempt("", frame_along, "incoming", given["incoming"], up=False)
    behind: Any = faults.attempt("", frame_along, "outgoing", given["outgoing"], up=True)
    if not faults:
        shaped = numbers | {"incoming": before.z[..., 0], "outgoing": behind.z[..., 0]}
        shapes = {name: value.shape for name, value in shaped.items()}
        faults.attempt("", check_broadcast, shapes)
    if faults:
        raise SurfaceError(*faults)
    alphas = numbers["alpha"], numbers.get("alpha_y", numbers["alpha"])
    return FacetInputs((numbers["outside"], *parts_of(numbers["index"])), alphas, before, behind)


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
