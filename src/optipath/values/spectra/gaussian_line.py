"""GaussianLine: power around a peak, such as that of a light-emitting diode."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.displayed import displayed
from optipath.values.spectra.grid_bins import NANOMETRES
from optipath.values.spectra.spectrum_kind import SpectrumKind

if TYPE_CHECKING:
    from collections.abc import Hashable

_FOUR_LOG_2 = 4.0 * math.log(2.0)


class GaussianLine(SpectrumKind):
    """A Gaussian along the wavelength, by its full width at half maximum.

    The simplest of the shapes that stand for a diode; its integral over all wavelengths is the
    power.

    Units: peak, width in metres.
    """

    peak: float
    width: float
    power: float

    def __init__(self, peak: float, width: float, power: float) -> None:
        label = f"the diode at {displayed(peak, 'nm')}"
        vars(self).update(label=label, peak=peak, width=width, power=power)

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return self.peak + self.width * np.linspace(-6.0, 6.0, 13)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "gaussian", self.peak, self.width, self.power

    @property
    def integral(self) -> float:
        # All but what a very wide one has below 0.
        return 0.5 * self.power * math.erfc(-math.sqrt(_FOUR_LOG_2) * self.peak / self.width)

    def density(self, xp: Any, wavelength: Any) -> Any:
        area = self.width * NANOMETRES * math.sqrt(math.pi / _FOUR_LOG_2)
        away = (wavelength - self.peak) / self.width
        return self.power / area * xp.exp(-_FOUR_LOG_2 * away * away)

    def times(self, factor: float) -> GaussianLine:
        return GaussianLine(self.peak, self.width, factor * self.power)
