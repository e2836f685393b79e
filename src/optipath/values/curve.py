"""Curve: numbers that depend on the wavelength, and where they are known."""

from __future__ import annotations

import math
import sys
from abc import ABC, abstractmethod
from dataclasses import dataclass
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays import Unchanging
from optipath.values.jax_values import is_traced, known, namespace
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.units import format_quantity
from optipath.values.wavelength import WAVELENGTH, WavelengthDomain

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping, Sequence

    from optipath.values.domains import Domain
    from optipath.values.parameters import Resolved


class Curve(Unchanging, ABC):
    """Numbers by wavelength, elementwise, in vacuum and in metres.

    A subclass has names, a span in metres and values. Curves of the same content are equal.
    """

    parts: tuple[str, ...] = ("value",)
    label: str
    span: tuple[float, float] = (0.0, np.inf)
    beyond: str = ""
    takes_grid: bool = False
    is_checked: bool = False  # Whether its numbers are looked at where they are made.
    unit: str = ""
    unreal: str = ""

    @property
    @abstractmethod
    def content(self) -> tuple[Hashable, ...]:
        """All that its numbers are made of, the label included; texts, numbers and bytes."""

    def arguments(self) -> Sequence[tuple[str, Any, Domain]]:
        """Return what its numbers are made of besides the wavelength: name, value, what it may be.

        In the order of `numbers`; a value may be a `Parameter`.
        """
        return ()

    def misfits(self, arguments: Sequence[Any], given: Mapping[str, Resolved]) -> list[str]:
        """Say which of its arguments do not fit to each other, whatever the wavelength.

        Parameters
        ----------
        arguments : sequence of float or Parameter
            As `arguments` lists them, some of them bound since.
        given : mapping of str to Resolved
            The parameters among them.

        Returns
        -------
        list of str
            A sentence for each.
        """
        return []

    @abstractmethod
    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        """Return its numbers, one for each part, elementwise and without checks.

        Parameters
        ----------
        xp : module
            ``numpy`` or ``jax.numpy``, by whose functions slopes are found.
        wavelength : array_like
            In metres.
        *arguments : array_like
            As `arguments` lists them; they broadcast with the wavelength.

        Returns
        -------
        tuple of array_like
        """

    def evaluated(self, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        """Return its numbers as arrays of the broadcast shape of what is given.

        A wavelength comes to the same numbers by itself and among others.

        Parameters
        ----------
        wavelength : array_like
            In metres.
        *arguments : array_like
            As `arguments` lists them.

        Returns
        -------
        tuple of ndarray
        """
        raw_values = [known(number) for number in (wavelength, *arguments)]
        traced = [number for number in raw_values if is_traced(number)]
        if traced:
            return self.numbers(namespace(traced[0]), *raw_values)
        several = np.broadcast_arrays(*[np.asarray(number, np.float64) for number in raw_values])
        shape = several[0].shape
        along_one_axis = max(shape, default=1) == several[0].size
        # Functions of NumPy may do other things to arrays that are no row of numbers. What asks
        # for a grid is shown the axes that are too many.
        row = -1 if along_one_axis or not self.takes_grid else shape
        rows = [np.ascontiguousarray(number).reshape(row) for number in several]
        with np.errstate(all="ignore"):
            result = self.numbers(np, *rows)
        return tuple([np.broadcast_to(part, rows[0].shape).reshape(shape) for part in result])

    def unreal_of(self, place: int) -> str:
        """Return why the numbers of one of its parts may be none; see `unreal`."""
        return self.unreal

    def samples(self, place: int) -> Any:
        """Return the numbers that somebody gave for one of its parts; None where it has none."""

    def is_nowhere_0(self, place: int) -> bool:
        """Tell whether it is known that the numbers of one of its parts are above 0 throughout."""
        return False

    @property
    def digest(self) -> str:
        """Some letters that equal curves share, and others do not."""
        return blake2b(
            repr((type(self).__name__, self.content)).encode(), digest_size=8
        ).hexdigest()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Curve):
            return NotImplemented
        return type(self) is type(other) and self.content == other.content

    def __hash__(self) -> int:
        return hash(self.content)


class CurveSum(Curve):
    """Numbers of curves, each times a number, and a number: n_e - n_o of a crystal."""

    def __init__(self, terms: tuple[tuple[float, Curve, int], ...], constant: float = 0.0) -> None:
        curves = [curve for _, curve, _ in terms]
        lows, highs = zip(*[curve.span for curve in curves], strict=True)
        text = "".join([_written(*term) for term in terms]).removeprefix(" + ").strip()
        vars(self).update(
            terms=terms,
            constant=constant,
            label=f"{text}{f' {constant:+g}' * bool(constant)}",
            span=(max(lows), min(highs)),
            beyond=next((curve.beyond for curve in curves if curve.beyond), ""),
            takes_grid=any(curve.takes_grid for curve in curves),
            unit=curves[0].unit,
        )

    terms: tuple[tuple[float, Curve, int], ...]
    constant: float

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
        left, result = list(arguments), []
        for _, curve, _ in self.terms:
            count = len(curve.arguments())
            result.append((curve, left[:count]))
            left = left[count:]
        return result


def _written(factor: float, curve: Curve, place: int) -> str:
    several = len(curve.parts) > 1
    name = f"{curve.parts[place]} of {curve.label}" if several else curve.label
    sign = "-" if factor < 0.0 else "+"
    times = "" if abs(factor) == 1.0 else f"{abs(factor):g} * "
    return f" {sign} {times}{name}"


def marked_name(curve: Curve, place: int, depends_on: tuple[Any, ...]) -> str:
    """Return a name that nobody can give, and that equal values alone share."""
    keys = [Operand(one).key() for one in depends_on]
    known = [p.default for p in depends_on if isinstance(p, Parameter) and p.bound]
    # What JAX traces is equal to itself alone.
    bound = [id(number) if is_traced(number) else np.asarray(number).tobytes() for number in known]
    mark = blake2b(repr((curve.digest, keys, bound)).encode(), digest_size=8).hexdigest()
    return f"{curve.parts[place]} of {curve.label} [{mark}]"


_MOST_CHARACTERS = 12
"""How many characters an end of a range may have."""

_PICOMETRES = 1e12


_ROUNDING = 4.0 * sys.float_info.epsilon
"""How far beyond an end, as a share of it, a wavelength is that was meant to be the end."""


def is_within(wavelength: Any, span: tuple[float, float]) -> Any:
    """Tell which wavelengths are within a range, its ends and their rounding included."""
    low, high = span
    return (wavelength >= low * (1.0 - _ROUNDING)) & (wavelength <= high * (1.0 + _ROUNDING))


@dataclass(frozen=True)
class WavelengthRange(WavelengthDomain):
    """Wavelengths that a curve may be asked for."""

    label: str = ""
    beyond: str = ""

    @classmethod
    def of(cls, curve: Curve) -> WavelengthRange:
        """Return the range of a curve."""
        low, high = curve.span
        return cls("wavelength", "length", low, high, label=curve.label, beyond=curve.beyond)

    def allows(self, numbers: Any) -> Any:
        if numbers.dtype.kind == "c":
            return super().allows(numbers)
        return self.are_numbers(numbers) & is_within(numbers, self.interval)

    def described(self) -> str:
        """Say in words which values are allowed."""
        otherwise = f", or {self.beyond}" if self.beyond else ""
        known = span_text((self.minimum, self.maximum))
        return f"a wavelength within {known}, for which {self.label} is known{otherwise}"


def span_text(span: tuple[float, float]) -> str:
    """Return a range of wavelengths in nanometres.

    >>> span_text((1.88e-7, 1.937e-6)), span_text((0.0, np.inf))
    ('188 nm .. 1937 nm', 'any wavelength')
    >>> span_text((4.959367937328011e-07, 1e-6))
    '495.937 nm .. 1000 nm'
    """
    if span == (0.0, np.inf):
        return "any wavelength"
    return " .. ".join([_end(span[0], math.ceil), _end(span[1], math.floor)])


def _end(wavelength: float, inward: Callable[[float], int]) -> str:
    """Return an end of a range; one of many digits as a wavelength within the range."""
    text = format_quantity(wavelength, WAVELENGTH.unit)
    if len(text) <= _MOST_CHARACTERS or not math.isfinite(wavelength):
        return text
    return f"{inward(wavelength * _PICOMETRES) / 1e3:.10g} nm"
