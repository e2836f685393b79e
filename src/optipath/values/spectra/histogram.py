"""Histogram: power in bins, which is spread evenly over each of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.errors import ValueFault
from optipath.values.arrays.read_only import locked
from optipath.values.curves.wavelength_range import is_within
from optipath.values.spectra.grid_bins import NANOMETRES
from optipath.values.spectra.sampled import OUTSIDE
from optipath.values.spectra.spectral_values import rising_edges, several_numbers, value_outside
from optipath.values.spectra.spectrum_kind import SpectrumKind

if TYPE_CHECKING:
    from collections.abc import Hashable


class Histogram(SpectrumKind):
    """Power in bins; its density is the power of a bin by its width.

    Shapes: edges (n + 1,); powers (n,). Units: edges in metres.
    """

    is_pointwise: ClassVar[bool] = False
    edges: np.ndarray[Any, Any]
    powers: np.ndarray[Any, Any]
    outside: float | None

    def __init__(
        self, edges: Any, powers: Any, outside: Any = None, label: str = "a histogram"
    ) -> None:
        ends, turned = rising_edges(f"edges of {label}", edges)
        given = several_numbers(f"powers of {label}", powers)
        if given.shape != (ends.size - 1,):
            raise ValueFault(
                f"{label} has {ends.size} edges and powers of shape {given.shape}; give "
                f"{ends.size - 1} powers, one for each bin"
            )
        given = given[::-1].copy() if turned else given
        # Differences of neighbours are exact, before they are in nanometres.
        widths = np.diff(ends) * NANOMETRES
        vars(self).update(
            label=label,
            edges=locked(ends),
            powers=locked(given),
            outside=value_outside(label, outside),
            beyond=OUTSIDE,
            _densities=locked(given / widths),
        )

    _densities: np.ndarray[Any, Any]

    @property
    def span(self) -> tuple[float, float]:  # type: ignore[override]
        return self.extent if self.outside is None else (0.0, np.inf)

    @property
    def extent(self) -> tuple[float, float]:
        return float(self.edges[0]), float(self.edges[-1])

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return self.edges

    @property
    def content(self) -> tuple[Hashable, ...]:
        numbers = self.edges.tobytes(), self.powers.tobytes()
        return "histogram", self.label, *numbers, self.outside

    def density(self, xp: Any, wavelength: Any) -> Any:
        place = xp.searchsorted(xp.asarray(self.edges), wavelength, side="right") - 1
        # An edge is of the bin above it, but for the last one.
        found = xp.asarray(self._densities)[xp.clip(place, 0, self.powers.size - 1)]
        return xp.where(is_within(wavelength, self.extent), found, 0.0)

    def times(self, factor: float) -> Histogram:
        return Histogram(self.edges, factor * self.powers, self.outside, self.label)
