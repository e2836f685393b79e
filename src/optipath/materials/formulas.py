"""Dispersion formulas whose coefficients are numbers or parameters."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.errors import ValueFault, collecting, listed, shown
from optipath.kernels.dispersion import (
    DATABASE_FORMULAS,
    cauchy_index,
    coefficients_fit,
    index_of_square,
    sellmeier_square,
)
from optipath.values.curve import Curve
from optipath.values.domains import Domain
from optipath.values.jax_values import is_traced
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.precision import real_number
from optipath.values.units import dimension_of, parse_quantity
from optipath.values.use import Use
from optipath.values.wavelength import LONGEST_FIRST, WAVELENGTH, too_long

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence


EVERYWHERE = (0.0, np.inf)


class FormulaCurve(Curve):
    """n and k by a published formula. Units: span in metres."""

    parts: tuple[str, ...] = ("n", "k")

    def __init__(self, label: str, span: Any, **arguments: Any) -> None:
        vars(self).update(label=label, beyond="take another formula", **arguments)
        faults: list[str] = []
        for name, value, domain in self.arguments():
            with collecting(faults, ValueFault):
                _check(f"{name} of {label}", value, domain)
        with collecting(faults, ValueFault):
            vars(self).update(span=read_span(f"span of {label}", span))
        if faults:
            raise ValueFault(*faults)
        vars(self).update({name: _as_floats(value) for name, value in arguments.items()})

    @abstractmethod
    def arguments(self) -> list[Coefficient]:
        """Return its coefficients, in the order of `numbers`: names, values, what they may be."""

    @property
    def content(self) -> tuple[Hashable, ...]:
        # Equal ones say the same of their parameters, which share a name.
        keys = [(name, Operand(value).key()) for name, value, _ in self.arguments()]
        return (self.label, self.span, *keys)


def _check(owner: str, value: Any, domain: Domain) -> None:
    if isinstance(value, Parameter):
        Use(owner, value, domain).check()
        return
    if domain.check(owner, value).ndim:
        raise ValueFault(f"{owner} is {shown(value)}; give one number, or a Parameter for several")


def _as_floats(raw_value: Any) -> Any:
    """Return coefficients as floats, so that 2 and 2.0 make equal curves."""
    if isinstance(raw_value, tuple):
        return tuple(map(_as_floats, raw_value))
    is_open = raw_value is None or isinstance(raw_value, Parameter) or is_traced(raw_value)
    return raw_value if is_open else REAL.check("", raw_value).item() + 0.0


def read_span(owner: str, span: Any) -> tuple[float, float]:
    """Return the least and the largest wavelength that a formula holds for, in metres.

    >>> read_span("span of a glass", ("400 nm", "1 um"))
    (4e-07, 1e-06)
    """
    if isinstance(span, tuple) and span == EVERYWHERE:
        return EVERYWHERE
    ends = WAVELENGTH.check(owner, list(span) if isinstance(span, tuple) else span)
    if ends.shape != (2,) or not ends[0] < ends[1]:
        raise ValueFault(
            f"{owner} is {shown(span)}; give the least and the largest wavelength, such as "
            f'["400 nm", "700 nm"]'
        )
    if ends[0] > LONGEST_FIRST:
        raise ValueFault(f"the least wavelength of the {owner} is {too_long(float(ends[0]))}")
    return float(ends[0]), float(ends[1])


class Sellmeier(FormulaCurve):
    """n^2 = offset + the sum of B w^2 / (w^2 - C), with w in micrometres and C in their squares.

    >>> from optipath.values.curve_value import curve_values
    >>> float(curve_values(Sellmeier("x", [1.25], [0.0]), 5e-7)[0])
    1.5
    """

    b: tuple[Any, ...]
    c: tuple[Any, ...] | None
    resonances: tuple[Any, ...] | None
    offset: Any
    parts = ("n",)
    unreal = "its formula has n^2 below 0 there, or a resonance"

    def __init__(
        self,
        label: str,
        b: Any,
        c: Any = None,
        *,
        resonances: Any = None,
        offset: Any = 1.0,
        span: Any = EVERYWHERE,
    ) -> None:
        if (c is None) == (resonances is None):
            raise ValueFault(
                f"{label} needs c, in square micrometres, or resonances, in micrometres; give one "
                f"of the two"
            )
        b, c, resonances = [
            None if row is None else several(f"{name} of {label}", row)
            for name, row in (("b", b), ("c", c), ("resonances", resonances))
        ]
        if len(b) != len(poles := c or resonances or ()):
            other = "resonances" if c is None else "c"
            raise ValueFault(
                f"{label} has {len(b)} of b and {len(poles)} of {other}; give one for each"
            )
        super().__init__(label, span, b=b, c=c, resonances=resonances, offset=offset)

    def arguments(self) -> list[Coefficient]:
        name = "resonances" if self.c is None else "c"
        domain = NOT_NEGATIVE if self.c is None else REAL
        poles = self.c or self.resonances or ()
        return [
            ("offset", self.offset, REAL),
            *[(f"b[{place}]", value, REAL) for place, value in enumerate(self.b)],
            *[(f"{name}[{place}]", value, domain) for place, value in enumerate(poles)],
        ]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        square = sellmeier_square(xp, wavelength * MICROMETRES, *self.terms(arguments))
        return (index_of_square(xp, square),)

    def terms(self, arguments: Sequence[Any]) -> tuple[Any, Sequence[Any], Sequence[Any]]:
        """Return the offset, the strengths, and the poles in square micrometres."""
        offset, *rest = arguments
        strengths, poles = rest[: len(self.b)], rest[len(self.b) :]
        return offset, strengths, [p * p for p in poles] if self.c is None else poles


class Cauchy(FormulaCurve):
    """n = A + B / w^2 + C / w^4 + ..., with w in micrometres.

    >>> from optipath.values.curve_value import curve_values
    >>> float(curve_values(Cauchy("x", [1.5, 0.004]), 5e-7)[0])
    1.516
    """

    coefficients: tuple[Any, ...]
    parts = ("n",)

    def __init__(self, label: str, coefficients: Any, *, span: Any = EVERYWHERE) -> None:
        row = several(f"coefficients of {label}", coefficients)
        super().__init__(label, span, coefficients=row)

    def arguments(self) -> list[Coefficient]:
        names = [f"coefficients[{place}]" for place in range(len(self.coefficients))]
        return [(name, value, REAL) for name, value in zip(names, self.coefficients, strict=True)]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        return (cauchy_index(xp, wavelength * MICROMETRES, arguments),)


Coefficient: TypeAlias = tuple[str, Any, Domain]


class _AboveZero(Domain):
    """Real numbers that are not 0, either."""

    def described(self) -> str:
        return f"a real {self.name} above 0"


REAL = Domain("coefficient")
POSITIVE = _AboveZero("coefficient", minimum=5e-324)
NOT_NEGATIVE = Domain("coefficient", minimum=0.0)

MICROMETRES = 1e6
"""How many there are in a metre: the unit of published coefficients."""


def several(name: str, values: Any) -> tuple[Any, ...]:
    """Return coefficients as a tuple.

    >>> several("b", [1.0, 2])
    (1.0, 2)
    """
    raw_value = values.tolist() if isinstance(values, np.ndarray) else values
    is_one = isinstance(raw_value, (str, Parameter)) or not hasattr(raw_value, "__iter__")
    row = () if is_one else tuple(raw_value)
    if not row:
        raise ValueFault(
            f"{name} must be a row of one coefficient or more, such as [1.0], not {shown(values)}"
        )
    return row


def oscillators_of(label: str, rows: Any, names: tuple[str, ...]) -> tuple[tuple[Any, ...], ...]:
    """Return the coefficients of oscillators, so many of each.

    >>> oscillators_of("gold", [[0.02, 0.4]], ("strength", "energy"))
    ((0.02, 0.4),)
    """
    if not hasattr(rows, "__iter__") or not all(hasattr(row, "__len__") for row in rows):
        rows = [()]
    if any(len(row) != len(names) for row in rows):
        raise ValueFault(
            f"oscillators of {label}: give a row of {len(names)} numbers for each, "
            f"[({', '.join(names)}), ...]"
        )
    return tuple([several("an oscillator", row) for row in rows])


def coefficients_of(
    rows: tuple[tuple[Any, ...], ...], names: tuple[str, ...], domains: tuple[Domain, ...]
) -> list[Coefficient]:
    """Return the coefficients of oscillators one after another, each with its name and domain."""
    return [
        (f"oscillators[{place}] {name}", value, domain)
        for place, row in enumerate(rows)
        for name, value, domain in zip(names, row, domains, strict=True)
    ]


@dataclass(frozen=True, eq=False)
class DrudeRotation(Curve):
    """A constant and the sum of A / (w^2 - C), w in um, times a unit; NaN at a resonance."""

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
        square = (wavelength * MICROMETRES) ** 2
        total = self.constant + 0.0 * square
        for strength, pole in zip(self.strengths, self.poles, strict=True):
            away = square - pole
            at_resonance = away == 0.0
            term = strength / xp.where(at_resonance, 1.0, away)
            total = total + xp.where(at_resonance, xp.nan, term)
        return (vars(self)["_size"] * total,)


@dataclass(frozen=True, eq=False)
class BirefringenceCurve(Curve):
    """n_e - n_o, by the differences of the coefficients of two formulas of as many terms.

    Subtracted indices would lose digits. With a and b for the extraordinary and the ordinary ray,
    each pair of terms differs by w^2 ((B_a - B_b) (w^2 - C_b) + B_b (C_a - C_b)) / ((w^2 - C_a)
    (w^2 - C_b)), and the squares of the indices by the sum of these.
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


class DispersionFormula(Curve):
    """The index of refraction by a formula in micrometres, within its known span in metres.

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
            beyond=NEAREST_REQUESTED,
        )

    @property
    def content(self) -> tuple[Hashable, ...]:
        return (self.label, self.formula, self.coefficients, self.known_span, self.extrapolate)

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        del arguments
        inside = xp.clip(wavelength, *self.known_span) if self.extrapolate else wavelength
        result = DATABASE_FORMULAS[self.formula](xp, inside * 1e6, self.coefficients)
        return (xp.broadcast_to(result, xp.shape(wavelength)),)


NEAREST_REQUESTED = 'ask for extrapolate="nearest"'
"""The one way to leave the range of a formula."""
