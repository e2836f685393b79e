"""Sampled: densities at samples of the wavelength, and straight lines between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.values.arrays.shapes import first_place
from optipath.values.curves.tabulated import Tabulated
from optipath.values.curves.wavelength_range import is_within
from optipath.values.spectra.spectral_values import value_outside
from optipath.values.spectra.spectrum_kind import SpectrumKind

if TYPE_CHECKING:
    from collections.abc import Hashable

OUTSIDE = "give outside=0.0 where the spectrum is made, if nothing is there"
HELD = ("nearest", "linear")
"""What a spectrum may be beyond its samples, besides 0: the last one, or the straight line on."""


class Sampled(SpectrumKind):
    """Densities at samples, linear between them.

    Shapes: wavelengths (n,); values (n,). Units: wavelengths in metres.
    """

    wavelengths: np.ndarray[Any, Any]
    values: np.ndarray[Any, Any]
    outside: float | str | None

    def __init__(
        self, wavelengths: Any, values: Any, outside: Any = None, label: str = "a sampled spectrum"
    ) -> None:
        held = outside if isinstance(outside, str) and outside in HELD else ""
        table = Tabulated(label, ("value",), wavelengths, [values], extrapolate=held)
        (columns,) = table.columns
        if np.any(bad := columns < 0.0):
            raise ValueFault(
                f"value of {label} is {columns[bad][0]:g}{first_place(bad)}; give numbers of 0 or "
                f"more, such as np.maximum(values, 0.0) of what is measured with noise"
            )
        vars(self).update(
            label=label,
            wavelengths=table.wavelengths,
            values=columns,
            outside=held or value_outside(label, outside),
            beyond=f"{OUTSIDE}, or outside='nearest' or 'linear'",
            _table=table,
        )

    _table: Tabulated

    @property
    def span(self) -> tuple[float, float]:  # type: ignore[override]
        return self.extent if self.outside is None else (0.0, np.inf)

    @property
    def extent(self) -> tuple[float, float]:
        return (0.0, np.inf) if self.outside in HELD else self._table.known_span

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return self.wavelengths

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "sampled", *self._table.content, self.outside

    def density(self, xp: Any, wavelength: Any) -> Any:
        (found,) = self._table.numbers(xp, xp.clip(wavelength, *self.extent))
        if self.outside in HELD:
            return xp.maximum(found, 0.0)  # Where a straight line goes on there is no less power.
        return xp.where(is_within(wavelength, self.extent), found, 0.0)

    def times(self, factor: float) -> Sampled:
        return self.with_values(factor * self.values)

    def with_values(self, values: Any) -> Sampled:
        """Return the spectrum of other values at the same wavelengths."""
        return Sampled(self.wavelengths, values, self.outside, self.label)
