"""FadingLayer: a layer that absorbs is so thick that no light gains on its way through it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.fresnel.attenuation import attenuation
from optipath.kernels.fresnel.inhomogeneous import inhomogeneous_boundary
from optipath.kernels.fresnel.interference import interference
from optipath.kernels.numbers.primitives import of_module
from optipath.values.agreement import Agreement, text_of

if TYPE_CHECKING:
    from collections.abc import Collection

_ROUNDING = 1e-9
"""By how much light may gain, as a share of it: what is next to lossless may have no length."""


@dataclass(frozen=True, eq=False)
class FadingLayer(Agreement):
    """Of light that starts through a layer, no more leaves the face that it meets: e (R + T) <= 1.

    e is what of the intensity is left behind the layer, R and T are those of either face, lit from
    within, of s and of p. In a medium that absorbs, R + T is not 1: next to a surface plasmon, or
    behind total reflection, it is far more, by the interference of the two waves at the face. As
    each layer then keeps some light, none comes out of a stack that did not go in.

    With t = Im g / Re g of the wave along the normal, R + T is at most (t + sqrt(1 + t^2))^2, so
    that a length of wavelength / (2 pi Re g) is enough whatever the media beside are, as asinh(t)
    is at most t.

    The operands are n and k of the medium in front of the layer, of the layer, and of the medium
    behind, the length, the wavelength, the index of the medium in which the incidence is measured,
    and the incidence.
    """

    layer: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        k, length, wavelength = numbers[3], *numbers[6:8]
        if xp is np:
            goes_on, _ = self._wave(*numbers)
            enough = (2.0 * math.pi * length * goes_on >= wavelength) | (k == 0.0)
            # Most are far thicker, and nobody need look at their faces.
            if np.all(enough):
                return enough
        left, lost = self._passing(xp, *numbers)
        kept = [lost + left * share for share in self._beside(xp, *numbers)]
        gains = [share < -_ROUNDING for share in kept]
        return ~((k > 0.0) & (gains[0] | gains[1] | gains[2] | gains[3]))

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying
        *_, n, k, _, _, length, wavelength, _, _ = numbers
        more = -min(float(share) for share in self._beside(np, *numbers))
        fades = float(self._wave(*numbers)[1])
        least = math.log1p(more) * wavelength / (4.0 * math.pi * fades)
        _, _, of_n, of_k, _, _, of_length, of_wavelength, *_ = self.operands
        return (
            f"light would gain in '{self.layer}', of n = {text_of(of_n, n)} and k = "
            f"{text_of(of_k, k)}, at a length of {text_of(of_length, length * 1e9, ' nm')} and a "
            f"wavelength of {text_of(of_wavelength, wavelength * 1e9, ' nm')}: at a face of it "
            f"R + T is above 1 by {more:.4g}, by interference, so that intensities of waves do not "
            f"add up in so thin a layer; give a length of at least {1.001 * least * 1e9:.6g} nm, "
            f"or leave the layer out"
        )

    @staticmethod
    def _passing(xp: Any, *numbers: Any) -> tuple[Any, Any]:
        """Return what of light is left behind the layer, and what is not."""
        *_, n, k, _, _, length, wavelength, n0, angle = numbers
        with np.errstate(all="ignore"):
            left, lost = attenuation(of_module(xp))(
                n, k, length, wavelength, n0, xp.cos(angle), xp.sin(angle)
            )
        return left, lost

    @staticmethod
    def _beside(xp: Any, *numbers: Any) -> tuple[Any, ...]:
        """Return 1 - R - T of s and of p, lit from within, at the face above and at that below."""
        (*above, n, k), below = numbers[:4], numbers[4:6]
        n0, angle = numbers[8:]
        given = n0, xp.cos(angle), xp.sin(angle)
        beside = interference(of_module(xp))
        with np.errstate(all="ignore"):
            return *beside(*above, n, k, *given)[2:], *beside(n, k, *below, *given)[:2]

    @staticmethod
    def _wave(*numbers: Any) -> tuple[Any, Any]:
        """Return the real and the imaginary part of g."""
        *_, n, k, _, _, _, _, n0, angle = numbers
        with np.errstate(all="ignore"):
            given = n, k, n, k, n0, np.cos(angle), np.sin(angle)
            at = inhomogeneous_boundary(of_module(np))(*given)
            return at.p / at.n1 * n, at.fades / at.n1 * n
