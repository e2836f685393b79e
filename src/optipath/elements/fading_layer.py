"""FadingLayer: a layer in which light hardly goes on along the normal must be thick enough."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.fresnel.attenuation import attenuation
from optipath.kernels.fresnel.inhomogeneous import inhomogeneous_boundary
from optipath.kernels.numbers.primitives import of_module
from optipath.values.agreement import Agreement

if TYPE_CHECKING:
    from collections.abc import Collection

_ROUNDING = 1e-9
"""By how much a wave may fade faster than it goes on, as a share of either."""


@dataclass(frozen=True, eq=False)
class FadingLayer(Agreement):
    """Of a wave that fades along the normal faster than it goes on, next to nothing is left.

    With g the wave along the normal and e what is left of the intensity behind the layer, either
    Im g is at most Re g, or 1 - e at least 2 e Im g / Re g: as much as the interference of the two
    waves at a face may carry. In thinner ones, behind total reflection or in films of metal, light
    would gain.

    The operands are n and k of the layer, its length, the wavelength, the index of the medium in
    which the incidence is measured, and the incidence.

    Attributes
    ----------
    layer : str
        The layer, as ``"node.indices[1]"``.
    """

    layer: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        goes_on, fades, left, lost = self._wave(xp, *numbers)
        thin = lost * goes_on < 2.0 * left * fades
        return ~((numbers[1] > 0.0) & (fades > (1.0 + _ROUNDING) * goes_on) & thin)

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying
        _, _, length, wavelength, *_ = numbers
        goes_on, fades, _, _ = (float(number) for number in self._wave(np, *numbers))
        least = math.log1p(2.0 * fades / goes_on) * wavelength / (4.0 * math.pi * fades)
        return (
            f"light fades along the normal faster than it goes on in '{self.layer}' (Im g = "
            f"{fades:.4g}, Re g = {goes_on:.4g}), which is {length * 1e9:.6g} nm thick: "
            f"intensities of waves do not add up in so thin a layer; give a length of at least "
            f"{1.001 * least * 1e9:.6g} nm, or leave the layer out"
        )

    def _wave(self, xp: Any, *numbers: Any) -> tuple[Any, ...]:
        """Return the real and the imaginary part of g, what is left of light, and what is not."""
        n, k, length, wavelength, n0, angle = numbers
        primitives = of_module(xp)
        given = n0, xp.cos(angle), xp.sin(angle)
        with np.errstate(all="ignore"):
            at = inhomogeneous_boundary(primitives)(n, k, n, k, *given)
            left, lost = attenuation(primitives)(n, k, length, wavelength, *given)
        return at.p / at.n1 * n, at.fades / at.n1 * n, left, lost
