"""DrudeRotation: optical rotation by wavelength, as resonances make it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault, shown
from optipath.values.affine import real_number
from optipath.values.curves.curve import Curve
from optipath.values.curves.formula_curve import EVERYWHERE, read_span
from optipath.values.units import dimension_of, parse_quantity

if TYPE_CHECKING:
    from collections.abc import Hashable

_MICROMETRES = 1e6


@dataclass(frozen=True, eq=False)
class DrudeRotation(Curve):
    """A constant and the sum of A / (w^2 - C), w in micrometres, times a unit; NaN at a resonance.

    Units: strengths, poles in square micrometres; span in metres.
    """

    label: str
    strengths: tuple[float, ...]
    poles: tuple[float, ...]
    constant: float = 0.0
    unit: str = "rad/m"
    span: tuple[float, float] = EVERYWHERE

    def __post_init__(self) -> None:
        faults = [
            f"{self.label} has the coefficient {shown(one)}; give finite real numbers"
            for one in (*self.strengths, *self.poles, self.constant)
            if real_number(one) is None
        ]
        if len(self.strengths) != len(self.poles):
            faults.append(
                f"{self.label} has {len(self.strengths)} strengths and {len(self.poles)} poles; "
                f"give one of each for each resonance"
            )
        if faults:
            raise ValueFault(*faults)
        vars(self).update(
            strengths=tuple(map(float, self.strengths)),
            poles=tuple(map(float, self.poles)),
            constant=float(self.constant),
            span=read_span(f"span of {self.label}", self.span),
            _size=parse_quantity(f"1 {self.unit}", dimension_of(self.unit)),
        )

    @property
    def content(self) -> tuple[Hashable, ...]:
        return self.label, self.unit, self.strengths, self.poles, self.constant, self.span

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        del arguments
        square = (wavelength * _MICROMETRES) ** 2
        total = self.constant + 0.0 * square
        for strength, pole in zip(self.strengths, self.poles, strict=True):
            away = square - pole
            at_resonance = away == 0.0
            term = strength / xp.where(at_resonance, 1.0, away)
            total = total + xp.where(at_resonance, xp.nan, term)
        return (vars(self)["_size"] * total,)
