"""EvenSpectrum: the same at each wavelength."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.values.spectra.spectrum_kind import SpectrumKind

if TYPE_CHECKING:
    from collections.abc import Hashable


class EvenSpectrum(SpectrumKind):
    """One density at each wavelength."""

    value: float

    def __init__(self, value: float) -> None:
        vars(self).update(label=f"the constant spectrum of {value:g}", value=value)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "even", self.value

    def density(self, xp: Any, wavelength: Any) -> Any:
        return xp.full_like(wavelength, self.value)

    def times(self, factor: float) -> EvenSpectrum:
        return EvenSpectrum(factor * self.value)
