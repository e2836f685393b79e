"""BirefringenceCurve: n_e - n_o by two formulas of Sellmeier, with all its digits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.dispersion.sellmeier import index_of_square, sellmeier_square
from optipath.values.curves.coefficients import MICROMETRES
from optipath.values.curves.curve import Curve

if TYPE_CHECKING:
    from collections.abc import Hashable

    from optipath.values.curves.sellmeier_curve import Sellmeier
    from optipath.values.domains.domain import Domain


@dataclass(frozen=True, eq=False)
class BirefringenceCurve(Curve):
    """n_e - n_o, by the differences of the coefficients of two formulas of as many terms.

    The two indices share their first digits; subtracted, they lose these, and the retardance of a
    thick plate would be wrong by as much. With a and b for the extraordinary and the ordinary
    ray, each pair of terms differs by w^2 ((B_a - B_b) (w^2 - C_b) + B_b (C_a - C_b)) /
    ((w^2 - C_a) (w^2 - C_b)), and the squares of the indices by the sum of these.
    """

    label: str
    extraordinary: Sellmeier
    ordinary: Sellmeier

    @property
    def span(self) -> tuple[float, float]:  # type: ignore[override]
        """The wavelengths at which both are known."""
        rays = self.extraordinary.span, self.ordinary.span
        return max(low for low, _ in rays), min(high for _, high in rays)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return self.label, self.extraordinary.digest, self.ordinary.digest

    def arguments(self) -> list[tuple[str, Any, Domain]]:
        """Return the coefficients of the one, and then of the other."""
        return [*self.extraordinary.arguments(), *self.ordinary.arguments()]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        half = len(self.extraordinary.arguments())
        one, b, c = self.extraordinary.terms(arguments[:half])
        other, b0, c0 = self.ordinary.terms(arguments[half:])
        micrometres = wavelength * MICROMETRES
        square = micrometres * micrometres
        total = one - other + 0.0 * square
        for *strengths, pole, pole0 in zip(b, b0, c, c0, strict=True):
            ahead, ahead0 = square - pole, square - pole0
            at_resonance = (ahead == 0.0) | (ahead0 == 0.0)
            over = (strengths[0] - strengths[1]) * ahead0 + strengths[1] * (pole - pole0)
            term = square * over / xp.where(at_resonance, 1.0, ahead * ahead0)
            total = total + xp.where(at_resonance, xp.nan, term)
        indices = [
            index_of_square(xp, sellmeier_square(xp, micrometres, *terms))
            for terms in ((one, b, c), (other, b0, c0))
        ]
        return (total / (indices[0] + indices[1]),)
