"""BlackBody: thermal radiation by Planck's law."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.spectra.grid_bins import NANOMETRES
from optipath.values.spectra.spectrum_kind import SpectrumKind

if TYPE_CHECKING:
    from collections.abc import Hashable

_PLANCK, _SPEED, _BOLTZMANN = 6.62607015e-34, 299792458.0, 1.380649e-23
"""Exact by the definitions of the SI (BIPM, The International System of Units, 2019)."""
_FIRST = 2.0 * _PLANCK * _SPEED**2
_SECOND = _PLANCK * _SPEED / _BOLTZMANN
_AROUND_PEAK = np.geomspace(0.05, 2000.0, 24)


class BlackBody(SpectrumKind):
    """Spectral radiance of a black body, in W/(m2 sr nm).

    2 h c^2 / L^5 / (exp(h c / (L k T)) - 1) for a wavelength L (M. Planck, Ann. Phys. 309, 553
    (1901)), times a factor.
    """

    temperature: float
    factor: float

    def __init__(self, temperature: float, factor: float = 1.0) -> None:
        label = f"the black body of {temperature:g} K"
        vars(self).update(label=label, temperature=temperature, factor=factor)

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return 2.897771955e-3 / self.temperature * _AROUND_PEAK

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "black body", self.temperature, self.factor

    @property
    def integral(self) -> float:
        # By Stefan and Boltzmann, per steradian.
        of_unit = 2.0 * math.pi**4 * _BOLTZMANN**4 / (15.0 * _PLANCK**3 * _SPEED**2)
        return self.factor * of_unit * self.temperature**4

    def density(self, xp: Any, wavelength: Any) -> Any:
        exponent = _SECOND / (wavelength * self.temperature)
        # 1 / (exp(x) - 1), which overflows nowhere.
        occupation = xp.exp(-exponent) / -xp.expm1(-exponent)
        return (self.factor * _FIRST / NANOMETRES) * (occupation / wavelength**5)

    def times(self, factor: float) -> BlackBody:
        return BlackBody(self.temperature, factor * self.factor)
