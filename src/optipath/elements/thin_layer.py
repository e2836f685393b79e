"""ThinLayer: a layer in which light would interfere, whose intensities are added all the same."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import CoherenceWarning
from optipath.values.agreement import Agreement
from optipath.values.calls_up import calls_up
from optipath.values.operands import NOTHING

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from optipath.values.resolved import Resolved

_WAVELENGTHS = 10.0
"""Up to how many wavelengths a layer is a thin film, whose light interferes."""


@dataclass(frozen=True, eq=False)
class ThinLayer(Agreement):
    """A layer is longer than about ten wavelengths in it, or else it is warned of.

    The operands are n of the layer, its length, and the wavelength in vacuum.
    """

    layer: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        del xp
        n, length, wavelength = numbers
        return ~(n * length < _WAVELENGTHS * wavelength)

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del numbers, varying
        return (
            f"{self.layer} is thinner than ten wavelengths, where light interferes, and a "
            f"LayerStack adds intensities; give the r_s and r_p of a film to a Mirror"
        )

    def fault(self, given: Mapping[str, Resolved] = NOTHING) -> str:
        """Warn of a thin layer, which is no fault."""
        if super().fault(given):
            warnings.warn(self.sentence(), CoherenceWarning, stacklevel=calls_up())
        return ""

    def inside(self, given: Mapping[str, Resolved]) -> Any:
        """Return that any layer is allowed."""
        del given
        return True
