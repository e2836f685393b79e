"""Dispersion formulas: Sellmeier, Cauchy, oscillators, and those of refractiveindex.info."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np

from optipath.errors import ValueFault
from optipath.faults import listed, shown
from optipath.kernels.dispersion import (
    DATABASE_FORMULAS,
    cauchy_index,
    coefficients_fit,
    drude_lorentz_permittivity,
    index_of_permittivity,
    index_of_square,
    sellmeier_square,
    tauc_lorentz_permittivity,
)
from optipath.values.agreement import Agreement, first_faults, text_of
from optipath.values.curve import Curve
from optipath.values.domains import Domain
from optipath.values.jax_values import is_traced
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.use import Use
from optipath.values.wavelength import HC, LONGEST_FIRST, WAVELENGTH, too_long

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence

    from optipath.values.parameters import Resolved


EVERYWHERE = (0.0, np.inf)
MICROMETRES = 1e6
"""How many there are in a metre: the unit of published coefficients."""


REAL = Domain("coefficient")
POSITIVE = Domain("coefficient", minimum=5e-324)
NOT_NEGATIVE = Domain("coefficient", minimum=0.0)

Coefficient: TypeAlias = tuple[str, Any, Domain]


@dataclass(frozen=True, eq=False, repr=False)
class FormulaCurve(Curve):
    """Numbers by a published formula, whose coefficients are numbers or parameters."""

    beyond = "take another formula"
    rows: ClassVar[tuple[str, ...]] = ()
    """The fields that are rows, of as many coefficients each."""
    label: str
    span: Any = field(default=EVERYWHERE, kw_only=True)

    def __post_init__(self) -> None:
        rows = {n: several(f"{n} of {self.label}", getattr(self, n)) for n in self.rows}
        if len(set(map(len, rows.values()))) > 1:
            counts = listed([f"{len(row)} of {name}" for name, row in rows.items()])
            raise ValueFault(f"{self.label} has {counts}; give as many of each")
        vars(self).update(rows)
        faults: list[str] = []
        for name, value, domain in self.arguments():
            with ValueFault.collecting(faults):
                if isinstance(value, Parameter):
                    Use(f"{name} of {self.label}", value, domain).check()
                elif domain.check(f"{name} of {self.label}", value).ndim:
                    what = f"{name} of {self.label} is {shown(value)}"
                    raise ValueFault(f"{what}; give one number, or a Parameter for several")
        with ValueFault.collecting(faults):
            vars(self).update(span=read_span(f"span of {self.label}", self.span))
        ValueFault.raise_for(faults)
        own = {each.name for each in fields(self)} - {"label", "span", "unit"}
        vars(self).update({name: _as_floats(getattr(self, name)) for name in own})

    @abstractmethod
    def arguments(self) -> list[Coefficient]:
        """Return its coefficients, in the order of `numbers`: names, values, what they may be."""

    @property
    def content(self) -> tuple[Hashable, ...]:
        # Equal ones say the same of their parameters, which share a name.
        keys = [(name, Operand(value).key()) for name, value, _ in self.arguments()]
        return (self.label, self.span, *keys)


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


def several(name: str, values: Any) -> tuple[Any, ...]:
    """Return a row of coefficients as a tuple.

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


def coefficients(name: str, row: Sequence[Any], domain: Domain = REAL) -> list[Coefficient]:
    """Return a row of coefficients, each with its name and domain."""
    return [(f"{name}[{place}]", value, domain) for place, value in enumerate(row)]


@dataclass(frozen=True, eq=False, repr=False)
class Sellmeier(FormulaCurve):
    """n^2 = offset + the sum of B w^2 / (w^2 - C), with w in micrometres and C in their squares.

    >>> from optipath.values.curve_value import curve_values
    >>> float(curve_values(Sellmeier("x", [1.25], [0.0]), 5e-7)[0])
    1.5
    """

    parts = ("n",)
    unreal = "its formula has n^2 below 0 there, or a resonance"
    b: Any
    c: Any = None
    resonances: Any = None
    offset: Any = 1.0

    def __post_init__(self) -> None:
        if (self.c is None) == (self.resonances is None):
            raise ValueFault(
                f"{self.label} needs c, in square micrometres, or resonances, in micrometres; give "
                f"one of the two"
            )
        vars(self).update(rows=("b", "resonances" if self.c is None else "c"))
        super().__post_init__()

    def arguments(self) -> list[Coefficient]:
        poles = coefficients("c", self.c or ())
        poles += coefficients("resonances", self.resonances or (), NOT_NEGATIVE)
        return [("offset", self.offset, REAL), *coefficients("b", self.b), *poles]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        square = sellmeier_square(xp, wavelength * MICROMETRES, *self.terms(arguments))
        return (index_of_square(xp, square),)

    def terms(self, arguments: Sequence[Any]) -> tuple[Any, Sequence[Any], Sequence[Any]]:
        """Return the offset, the strengths, and the poles in square micrometres."""
        offset, *rest = arguments
        strengths, poles = rest[: len(self.b)], rest[len(self.b) :]
        return offset, strengths, [p * p for p in poles] if self.c is None else poles


@dataclass(frozen=True, eq=False, repr=False)
class Cauchy(FormulaCurve):
    """n = A + B / w^2 + C / w^4 + ..., with w in micrometres.

    >>> from optipath.values.curve_value import curve_values
    >>> float(curve_values(Cauchy("x", [1.5, 0.004]), 5e-7)[0])
    1.516
    """

    parts = ("n",)
    rows = ("coefficients",)
    coefficients: Any

    def arguments(self) -> list[Coefficient]:
        return coefficients("coefficients", self.coefficients)

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        return (cauchy_index(xp, wavelength * MICROMETRES, arguments),)


class Oscillators(FormulaCurve):
    """n and k of electrons that absorb, each with coefficients of its own; energies in eV."""

    parts = ("n", "k")
    each: Mapping[str, Domain]
    """The coefficients of an oscillator."""
    oscillators: Any
    background: Any
    unreal = "its coefficients give no permittivity that is a number"

    def __post_init__(self) -> None:
        rows: Any = list(self.oscillators) if np.iterable(self.oscillators) else [()]
        if not all(hasattr(row, "__len__") and np.ndim(row) for row in rows):
            rows = [()]
        if any(len(row) != len(self.each) for row in rows):
            raise ValueFault(
                f"oscillators of {self.label}: give a row of {len(self.each)} numbers for each, "
                f"[({', '.join(self.each)}), ...]"
            )
        vars(self).update(oscillators=tuple([several("an oscillator", row) for row in rows]))
        super().__post_init__()

    def arguments(self) -> list[Coefficient]:
        return [
            ("background", self.background, REAL),
            *[
                (f"oscillators[{place}] {name}", value, domain)
                for place, row in enumerate(self.oscillators)
                for value, (name, domain) in zip(row, self.each.items(), strict=True)
            ],
        ]

    def rows_of(self, numbers: Sequence[Any]) -> list[Sequence[Any]]:
        """Return the numbers of each oscillator, of those behind all others."""
        count = len(self.each)
        behind = numbers[len(numbers) - count * len(self.oscillators) :]
        return [behind[at : at + count] for at in range(0, len(behind), count)]


@dataclass(frozen=True, eq=False)
class DrudeLorentz(Oscillators):
    """Electrons that are free, and bound ones.

    >>> from optipath.values.curve_value import curve_values
    >>> n, k = curve_values(DrudeLorentz("a metal", 9.0, 0.02), 1e-6)
    >>> round(float(n), 4), round(float(k), 4)
    (0.0591, 7.1891)
    """

    each = {"strength": NOT_NEGATIVE, "energy": NOT_NEGATIVE, "damping": POSITIVE}  # noqa: RUF012
    plasma: Any
    damping: Any
    strength: Any = 1.0
    oscillators: Any = ()
    background: Any = 1.0

    def arguments(self) -> list[Coefficient]:
        background, *bound = super().arguments()
        free = [(name, getattr(self, name), NOT_NEGATIVE) for name in _FREE]
        return [background, *free, *bound]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        background, plasma, strength, damping, *_ = arguments
        bound, free = self.rows_of(arguments), (strength, damping)
        result = drude_lorentz_permittivity(HC / wavelength, background, plasma, free, bound)
        return index_of_permittivity(xp, *result)


_FREE = ("plasma", "strength", "damping")


@dataclass(frozen=True, eq=False)
class TaucLorentz(Oscillators):
    """Oscillators above a gap, of amorphous films.

    >>> from optipath.values.curve_value import curve_values
    >>> silicon = TaucLorentz("silicon", [(122.0, 3.45, 2.54, 1.2)], background=1.15)
    >>> n, k = curve_values(silicon, 500e-9)
    >>> round(float(n), 4), round(float(k), 4)
    (4.4573, 1.0883)
    """

    each = {  # noqa: RUF012
        "amplitude": NOT_NEGATIVE,
        "energy": POSITIVE,
        "broadening": POSITIVE,
        "gap": NOT_NEGATIVE,
    }

    oscillators: Any
    background: Any = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.oscillators:
            raise ValueFault(
                f"{self.label} has no oscillators; give one or more, or n as a number for what is "
                f"the same at all wavelengths"
            )
        limits = self._limits([value for _, value, _ in self.arguments()])
        ValueFault.raise_for(first_faults([law for law in limits if not law.is_open]))

    def misfits(self, arguments: Sequence[Any], given: Mapping[str, Resolved]) -> list[str]:
        return first_faults(self._limits(arguments), given)

    def _limits(self, arguments: Sequence[Any]) -> list[BroadeningLimit]:
        return [
            BroadeningLimit(
                (Operand(energy), Operand(broadening)), f"oscillators[{place}] of {self.label}"
            )
            for place, (_, energy, broadening, _) in enumerate(self.rows_of(arguments))
        ]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        real, energy = arguments[0], HC / wavelength
        imaginary = 0.0 * energy
        for row in self.rows_of(arguments):
            more, absorbed = tauc_lorentz_permittivity(xp, energy, *row)
            real, imaginary = real + more, imaginary + absorbed
        return index_of_permittivity(xp, real, imaginary)


@dataclass(frozen=True, eq=False)
class BroadeningLimit(Agreement):
    """C < 2 E0 of energy and broadening, so that alpha of Jellison and Modine (1996) is real."""

    owner: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        energy, broadening = numbers
        return ~(broadening >= 2.0 * energy)

    def sentence(self, *numbers: float) -> str:
        energy, broadening = [text_of(*each) for each in zip(self.operands, numbers, strict=True)]
        return (
            f"{self.owner} has the broadening {broadening} and the energy {energy}; the formula "
            f"holds for a broadening below twice the energy, which is {2.0 * numbers[0]:.12g}"
        )


@dataclass(frozen=True, eq=False, repr=False)
class DispersionFormula(Curve):
    """The index of refraction by a formula of refractiveindex.info. Units: known_span in metres.

    >>> silica = (0, 0.6961663, 0.0684043, 0.4079426, 0.1162414, 0.8974794, 9.896161)
    >>> n = DispersionFormula("silica", 1, silica, (0.21e-6, 6.7e-6)).evaluated(589.3e-9)[0]
    >>> round(float(n), 5)
    1.4584
    """

    parts = ("n",)
    unreal = "the formula has n^2 below 0, or a resonance"
    label: str
    formula: int
    coefficients: tuple[float, ...]
    known_span: tuple[float, float]
    extrapolate: str = ""

    def __post_init__(self) -> None:
        count = len(self.coefficients)
        if self.formula not in DATABASE_FORMULAS or not coefficients_fit(self.formula, count):
            numbers = listed([str(number) for number in DATABASE_FORMULAS])
            raise ValueFault(
                f"{self.label} has {count} coefficients, which formula {self.formula} cannot have; "
                f"there are the formulas {numbers}"
            )
        span = EVERYWHERE if self.extrapolate else self.known_span
        vars(self).update(span=span, beyond=NEAREST_REQUESTED)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return (self.label, self.formula, self.coefficients, self.known_span, self.extrapolate)

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        inside = xp.clip(wavelength, *self.known_span) if self.extrapolate else wavelength
        result = DATABASE_FORMULAS[self.formula](xp, inside * MICROMETRES, self.coefficients)
        return (xp.broadcast_to(result, xp.shape(wavelength)),)


NEAREST_REQUESTED = 'ask for extrapolate="nearest"'
"""The one way to leave the range of a formula."""
