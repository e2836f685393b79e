"""SumOfKinds: spectra of several kinds that add up, such as a lamp with lines."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.values.curves.wavelength_range import span_text
from optipath.values.spectra.spectrum_kind import EmissionLine, SpectrumKind

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence


class SumOfKinds(SpectrumKind):
    """The sum of spectra, known where all of them are."""

    _terms: tuple[SpectrumKind, ...]

    def __init__(self, terms: Sequence[SpectrumKind]) -> None:
        low = max(term.span[0] for term in terms)
        high = min(term.span[1] for term in terms)
        label = " + ".join(term.label for term in terms)
        if low > high:
            spans = [span_text(term.span) for term in terms if np.isfinite(term.span[1])]
            raise ValueFault(
                f"{label} are known from {' and from '.join(spans)}, which have no wavelength in "
                f"common; give outside=0.0 to those that are 0 elsewhere"
            )
        cures = [term.beyond for term in terms if np.isfinite(term.span[1])]
        vars(self).update(
            _terms=tuple(terms),
            label=label,
            span=(low, high),
            beyond=", and ".join(dict.fromkeys(cures)),
        )

    @property
    def terms(self) -> tuple[SpectrumKind, ...]:
        return self._terms

    @property
    def lines(self) -> tuple[EmissionLine, ...]:  # type: ignore[override]
        return tuple([line for term in self.terms for line in term.lines])

    @property
    def extent(self) -> tuple[float, float]:
        ends = [term.extent for term in self.terms]
        return min(low for low, _ in ends), max(high for _, high in ends)

    @property
    def breaks(self) -> np.ndarray[Any, Any]:
        return np.unique(np.concatenate([term.breaks for term in self.terms]))

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "sum", *[term.content for term in self.terms]

    def density(self, xp: Any, wavelength: Any) -> Any:
        return reduce(add, [term.density(xp, wavelength) for term in self.terms])

    def times(self, factor: float) -> SumOfKinds:
        return SumOfKinds([term.times(factor) for term in self.terms])
