"""DispersionFormula: n by one of the numbered formulas of refractiveindex.info."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault, listed
from optipath.kernels.dispersion.database_formulas import DATABASE_FORMULAS, coefficients_fit
from optipath.values.cures import argument, cure
from optipath.values.curves.curve import Curve

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence


class DispersionFormula(Curve):
    """The index of refraction by a formula, within the wavelengths for which it was found.

    Units: coefficients in micrometres; known_span in metres.

    Examples
    --------
    >>> silica = [0, 0.6961663, 0.0684043, 0.4079426, 0.1162414, 0.8974794, 9.896161]
    >>> n = DispersionFormula("silica", 1, silica, (0.21e-6, 6.7e-6)).evaluated(589.3e-9)[0]
    >>> round(float(n), 5)
    1.4584
    """

    parts = ("n",)
    unreal = "the formula has n^2 below 0, or a resonance"
    formula: int
    coefficients: tuple[float, ...]
    known_span: tuple[float, float]
    extrapolate: str

    def __init__(
        self,
        label: str,
        formula: int,
        coefficients: Sequence[float],
        known_span: tuple[float, float],
        *,
        extrapolate: str = "",
    ) -> None:
        if formula not in DATABASE_FORMULAS:
            numbers = listed([str(number) for number in DATABASE_FORMULAS])
            raise ValueFault(f"{label} is by formula {formula}; there are the formulas {numbers}")
        if not coefficients_fit(formula, len(coefficients)):
            raise ValueFault(
                f"{label} has {len(coefficients)} coefficients, which formula {formula} cannot have"
            )
        vars(self).update(
            label=label,
            formula=formula,
            coefficients=tuple(coefficients),
            known_span=known_span,
            extrapolate=extrapolate,
            span=(0.0, float("inf")) if extrapolate else known_span,
            beyond=nearest_asked_for(),
        )

    @property
    def content(self) -> tuple[Hashable, ...]:
        return (self.label, self.formula, self.coefficients, self.known_span, self.extrapolate)

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        del arguments
        inside = xp.clip(wavelength, *self.known_span) if self.extrapolate else wavelength
        found = DATABASE_FORMULAS[self.formula](xp, inside * 1e6, self.coefficients)
        return (xp.broadcast_to(found, xp.shape(wavelength)),)


def nearest_asked_for() -> str:
    """Return the one way to leave the range of a formula, as a cure."""
    asked = cure("ask for extrapolate='nearest'", 'ask for extrapolate = "nearest"')
    return asked if argument("extrapolate") else "name another page"
