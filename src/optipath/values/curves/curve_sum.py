"""CurveSum: what numbers of several curves come to together, such as a birefringence."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.values.curves.curve import Curve

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence

    from optipath.values.domains.domain import Domain
    from optipath.values.resolved import Resolved


@dataclass(frozen=True, eq=False)
class CurveSum(Curve):
    """Numbers of curves, each times a number, and a number: n_e - n_o of a crystal."""

    terms: tuple[tuple[float, Curve, int], ...]
    constant: float = 0.0

    @cached_property
    def label(self) -> str:  # type: ignore[override]
        """What sentences call it: the sum as one writes it."""
        text = "".join([_written(*term) for term in self.terms]).removeprefix(" + ").strip()
        return f"{text}{f' {self.constant:+g}' * bool(self.constant)}"

    @property
    def span(self) -> tuple[float, float]:  # type: ignore[override]
        """The wavelengths at which all are known."""
        lows, highs = zip(*[curve.span for _, curve, _ in self.terms], strict=True)
        return max(lows), min(highs)

    @property
    def beyond(self) -> str:  # type: ignore[override]
        """What else to do, as the first curve has it that says so."""
        return next((curve.beyond for _, curve, _ in self.terms if curve.beyond), "")

    @property
    def takes_grid(self) -> bool:  # type: ignore[override]
        """Whether one of the curves does."""
        return any(curve.takes_grid for _, curve, _ in self.terms)

    @property
    def unit(self) -> str:  # type: ignore[override]
        """The unit of the first of them."""
        return self.terms[0][1].unit

    @property
    def content(self) -> tuple[Hashable, ...]:
        terms = [(factor, curve.digest, place) for factor, curve, place in self.terms]
        return self.label, tuple(terms), self.constant

    def arguments(self) -> list[tuple[str, Any, Domain]]:
        """Return the arguments of all curves, one after another."""
        return [argument for _, curve, _ in self.terms for argument in curve.arguments()]

    def misfits(self, arguments: Sequence[Any], given: Mapping[str, Resolved]) -> list[str]:
        own = self._own(arguments)
        return [*dict.fromkeys([f for curve, its in own for f in curve.misfits(its, given)])]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        total = self.constant
        for (factor, _, place), (curve, own) in zip(self.terms, self._own(arguments), strict=True):
            total = total + factor * curve.numbers(xp, wavelength, *own)[place]
        return (total,)

    def _own(self, arguments: Sequence[Any]) -> list[tuple[Curve, list[Any]]]:
        """Return each curve with its own arguments."""
        left, found = list(arguments), []
        for _, curve, _ in self.terms:
            count = len(curve.arguments())
            found.append((curve, left[:count]))
            left = left[count:]
        return found


def _written(factor: float, curve: Curve, place: int) -> str:
    several = len(curve.parts) > 1
    name = f"{curve.parts[place]} of {curve.label}" if several else curve.label
    sign = "-" if factor < 0.0 else "+"
    times = "" if abs(factor) == 1.0 else f"{abs(factor):g} * "
    return f" {sign} {times}{name}"
