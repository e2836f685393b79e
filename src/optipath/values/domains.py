"""Domain: which numbers a quantity may be; words, fractions, vectors, Stokes states."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar, NoReturn

import numpy as np
import numpy.typing as npt

from optipath.errors import ValueFault
from optipath.faults import Cure, Fault, did_you_mean, shown
from optipath.values.angles import TURN, CosSin, range_cure, refused
from optipath.values.arrays import as_argument, changed, first_place, numbers_for, read_only
from optipath.values.jax_values import is_traced, namespace
from optipath.values.parameters import Parameter
from optipath.values.precision import ENDLESS, doubles, held, rounding_of
from optipath.values.units import (
    USUAL_UNITS,
    dimension_of,
    format_quantity,
    parse_quantity,
    unit_of,
)

LEAST = float(np.finfo(float).tiny)
"""The least normal number: those above 0 that are less have too few digits."""


@dataclass(frozen=True)
class Domain:
    """Real numbers between two limits, both included. Units: minimum, maximum in radians."""

    complex_parts: ClassVar[tuple[str, ...]] = ()
    of_numbers: ClassVar[str] = "finite"
    masks = False  # Whether light of what is not allowed is NaN, and nothing is refused.
    shows_in_light = False  # Whether light of wrong arrays is not finite, and tells it itself.
    takes_materials = False  # Whether a `Material` may stand for the number.
    takes_parameters = True

    name: str
    dimension: str = ""
    minimum: float = -np.inf
    maximum: float = np.inf
    tail: tuple[int, ...] = ()
    own_unit: str = ""
    optional: bool = False  # Whether it may be None.
    besides: str = ""  # What is said besides of which values are allowed.

    @property
    def unit(self) -> str:
        """The unit in which values are written where nobody says another."""
        return self.own_unit or USUAL_UNITS[self.dimension]

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        """Return the value as an array (..., *tail), or say what is wrong with it."""
        if self.quickly_allows(value):
            return np.array(value)
        if is_traced(value):
            self._check_shape(owner, value.shape)
            return value  # type: ignore[no-any-return]
        value = self.read(owner, value)
        argument = as_argument(owner, value)
        array = doubles(argument, (self.minimum, self.maximum))
        if array.dtype.kind not in "fc":
            raise ValueFault(f"{owner} {self._no_number(value, array)}")
        self._check_shape(owner, array.shape)
        if np.any(bad := ~self.are_numbers(array)):
            result = f"{array[bad].ravel()[0]}{first_place(bad)}"
            raise ValueFault(f"{owner} is {result}; give a {self.of_numbers} {self.name}")
        self._check_numbers(owner, array, rounding_of(argument))
        return array

    def _no_number(self, value: Any, array: npt.NDArray[Any]) -> str:
        """Return why something is no number; what comes behind the name of its owner."""
        if isinstance(value, Parameter):
            return f"cannot be {value.called} here; give {self.described()}"
        entries = array.ravel().tolist() if array.dtype.kind == "O" else []
        if names := [entry.called for entry in entries if isinstance(entry, Parameter)]:
            whole = "one Parameter for the whole, and all numbers where the path is traced"
            such, cure = ", ".join(names[:3]), "op.Material(n, k)" if self.complex_parts else whole
            return f"cannot have numbers and parameters side by side, such as {such}; give {cure}"
        if isinstance(value, CosSin) and self.dimension == "angle":
            return (
                "cannot keep a cosine and a sine; give a Parameter here and these where the path "
                "is traced, or give the angle"
            )
        return f"must be {self.described()}, not {shown(value)}"

    def _check_shape(self, owner: str, shape: tuple[int, ...]) -> None:
        if self.tail and shape[-len(self.tail) :] != self.tail:
            wanted = ", ".join(map(str, ("...", *self.tail)))
            raise ValueFault(f"{owner} must have shape ({wanted}), not {shape}")

    def are_numbers(self, numbers: Any) -> Any:
        """Return which of an array are numbers at all: finite ones, by default."""
        return namespace(numbers).isfinite(numbers)

    def allows(self, numbers: Any) -> Any:
        """Return which numbers of an array are allowed, or for which paths; JAX's as well."""
        inside = self.are_numbers(numbers)
        if numbers.dtype.kind == "c":
            return inside & False
        low, high = held(numbers, (self.minimum, self.maximum))
        return inside & (numbers >= low) & (numbers <= high)

    @property
    def unphysical(self) -> Domain:
        """The domain of values as they are measured, or of what amplifies; mostly the same."""
        return self

    @property
    def takes_any(self) -> bool:
        """Whether any numbers are let in, which others look at."""
        return False

    def quickly_allows(self, value: Any) -> bool:
        """Tell, for the plain floats that long paths are made of, whether all is well."""
        inside = type(value) is float and self.minimum <= value <= self.maximum
        finite = inside and math.isfinite(value) and not self.tail
        # Of an angle beyond a whole turn one asks whether it is one of degrees.
        return finite and (self.dimension != "angle" or abs(value) <= TURN)

    def parse(self, text: str) -> Any:
        """Return the number that a text such as ``"30 deg"`` stands for."""
        return parse_quantity(text, self.dimension)

    def read(self, owner: str, value: Any) -> Any:
        """Return a value with numbers in place of texts."""
        return numbers_for(owner, value, self.parse)

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change."""
        return read_only(value, (self.minimum, self.maximum))

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of real numbers; wide open where they are limited in other ways too."""
        return self.minimum, self.maximum

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return the numbers that make up a value: their names, values and domains."""
        return [] if value is None and self.optional else [(name, value, self)]

    def described(self) -> str:
        """Say in words which values are allowed."""
        low, high = self._text(self.minimum), self._text(self.maximum)
        within = f" within {low} .. {high}"
        if np.isinf(self.minimum) and np.isfinite(self.maximum):
            within = f" of {high} or less"
        if np.isinf(self.maximum):
            within = f" of {low} or more" if np.isfinite(self.minimum) else ""
            within = " above 0" if 0.0 < self.minimum <= LEAST else within
        return f"a real {self.name}{within}{self.besides}"

    def _text(self, value: float) -> str:
        return format_quantity(value, self.unit)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        if array.dtype.kind == "c" and not self.complex_parts:
            raise ValueFault(f"{owner} is complex; give {self.described()}")
        if self.interval == ENDLESS:
            return
        bad = ~self.allows(array)
        if np.any(bad):
            text, hint = self.refused(array[bad].ravel()[0].item())
            cure = range_cure(self.described(), hint)
            raise ValueFault(Fault(f"{owner} is {text}{first_place(bad)}", cure))

    def refused(self, number: Any) -> tuple[str, str]:
        """Return a number that is not allowed as a text, and what was meant; mostly nothing."""
        if self.complex_parts:
            return str(number), ""
        return refused(number, self.unit, (self.minimum, self.maximum))


@dataclass(frozen=True)
class Within:
    """The range of a field of an element of one's own: ``Annotated[float, Within(0, 2)]``.

    Both ends are included. With `Real`, `Angle` and the like, ``Annotated[Angle, Within(0)]``, it
    narrows what these are; a plain number with a unit at an end is a quantity of that unit.

    Parameters
    ----------
    minimum, maximum : float or str, optional
        The ends: numbers in base units (radians, meters), or texts such as ``"30 deg"``; by
        default there is none.

    Raises
    ------
    ValueFault
        If an end is no number, or the first is above the second.

    Examples
    --------
    A field ``factor: Annotated[op.fields.Real, op.fields.Within(0, 1)]`` takes

    >>> Within(0, 1).narrowed(Domain("number")).described()
    'a real number within 0 .. 1'
    """

    minimum: float | str | None = None
    maximum: float | str | None = None

    def __post_init__(self) -> None:
        """Check both ends."""
        self.narrowed(Domain("number"))

    def narrowed(self, domain: Domain) -> Domain:
        """Return a domain of real numbers with this range."""
        ends = self.minimum, self.maximum
        unit = next((u for end in ends if isinstance(end, str) and (u := unit_of(end))), "")
        if unit and domain == Domain("number"):
            kind = dimension_of(unit)
            domain = replace(domain, name=kind, dimension=kind, own_unit=unit)
        allowed, own = domain.described(), domain.interval
        if domain.complex_parts or domain.tail or isinstance(domain, Choice):
            raise ValueFault(f"Within is for real numbers, not for {allowed}; take it out")
        given, endless = list(own), replace(domain, minimum=-np.inf, maximum=np.inf)
        for place, end in enumerate(ends):
            if end is not None:
                given[place] = n = one_number("an end of Within", end, endless)
                if domain.dimension == "angle" and not isinstance(end, str) and abs(n) > TURN:
                    raise ValueFault(f"an end of Within is {n:g} rad; write degrees as '{n:g} deg'")
        low, high = max(given[0], own[0]), min(given[1], own[1])
        if low > high:
            texts = " .. ".join(map(str, ends))
            raise ValueFault(f"Within {texts} has no number that is {allowed}; give others")
        return replace(domain, minimum=low, maximum=high)


def one_number(owner: str, value: Any, domain: Domain) -> float:
    """Return the number that a domain allows, which is one and no array."""
    array = domain.check(owner, value)
    if array.ndim:
        raise ValueFault(f"{owner} has shape {array.shape}; give one number")
    return float(array)


def in_unit_of(value: Any, domain: Domain) -> Any:
    """Return a value; a parameter without a unit gets the usual one of a domain."""
    if isinstance(value, Parameter) and not value.unit:
        return changed(value, unit=domain.unit)
    return value


@dataclass(frozen=True)
class Choice(Domain):
    """One word out of a few."""

    takes_parameters = False

    words: tuple[str, ...] = ()

    def quickly_allows(self, value: Any) -> bool:
        return type(value) is str and value in self.words

    def parse(self, text: str) -> Any:
        return text

    def check(self, owner: str, value: Any) -> Any:
        if isinstance(value, str) and value in self.words:
            return value
        raise ValueFault(f"{owner} is {shown(value)}{did_you_mean(value, self.words)}")

    def described(self) -> str:
        return f"one word of {', '.join(self.words)}"


@dataclass(frozen=True)
class YesNo(Choice):
    """True or False; ``true`` or ``false`` in files."""

    def quickly_allows(self, value: Any) -> bool:
        return value is True or value is False

    def kept(self, value: Any) -> Any:
        """Return a plain bool for one of NumPy's."""
        return bool(value) if isinstance(value, np.bool_) else value

    def described(self) -> str:
        return "True or False"

    def check(self, owner: str, value: Any) -> Any:
        if isinstance(value, (bool, np.bool_)):
            return bool(value)
        cure = Cure("give True or False", "give true or false")
        raise ValueFault(Fault(f"{owner} is {shown(value)}", cure))


class FractionDomain(Domain):
    """Real numbers of 0 to 1.

    >>> FractionDomain("fraction", minimum=0.0, maximum=1.0).refused(50.0)
    ('50', '; did you mean 0.5?')
    """

    def parse(self, text: str) -> Any:
        if text.rstrip().endswith("%"):
            raise ValueFault(f"'{text}' is in per cent; give a fraction, such as 0.5 for '50 %'")
        return super().parse(text)

    def refused(self, number: Any) -> tuple[str, str]:
        text, nothing = super().refused(number)
        return text, f"; did you mean {number / 100.0:g}?" if 2.0 <= number <= 100.0 else nothing


class ExtinctionDomain(Domain):
    """Ratios of what is wanted to what is not, beyond 1; infinite where nothing of that is left.

    >>> ExtinctionDomain("extinction ratio", minimum=1.001).parse("1000:1")
    1000.0
    """

    of_numbers: ClassVar[str] = "finite or infinite"

    def are_numbers(self, numbers: Any) -> Any:
        return ~namespace(numbers).isnan(numbers)


class WholeNumber(Domain):
    """Whole numbers, kept as such."""

    def quickly_allows(self, value: Any) -> bool:
        return type(value) is int

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change."""
        stored = super().kept(value)
        return int(stored) if isinstance(stored, float) and stored.is_integer() else stored


@dataclass(frozen=True)
class Refused(Domain):
    """No value at all."""

    why: str = ""

    def quickly_allows(self, value: Any) -> bool:
        return False

    def check(self, owner: str, value: Any) -> NoReturn:
        raise ValueFault(f"{owner} {self.why}")


_ROUNDING = 1e-12
_GATHERED = 16.0
"""How many roundings light of less than double precision may have gathered."""
_LEAST, _MOST = 1e-280, 1e300
_SINGLE_ROUNDING = 1e-6
"""How far the size of an amplitude may be above 1: numbers of single precision are rounded so."""


class AmplitudeDomain(Domain):
    """Complex numbers of a size of 1 or less, but for the rounding of single precision."""

    complex_parts = ("re", "im")

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of both parts."""
        return -1.0 - _SINGLE_ROUNDING, 1.0 + _SINGLE_ROUNDING

    def quickly_allows(self, value: Any) -> bool:
        return type(value) is float and -1.0 <= value <= 1.0

    def described(self) -> str:
        return f"a real or complex {self.name} of a size of 1 or less"

    def allows(self, numbers: Any) -> Any:
        xp = namespace(numbers)
        # Cut off, so that squares of what is far too much do not overflow.
        parts = (xp.minimum(abs(part), 2.0) for part in (numbers.real, numbers.imag))
        return xp.hypot(*parts) <= 1.0 + _SINGLE_ROUNDING


@dataclass(frozen=True)
class PhysicalDomain(Domain):
    """Numbers that are possible together, beyond the rounding of their precision; or any."""

    physical: bool = True

    @property
    def unphysical(self) -> Domain:
        """The domain of what is measured, and of amplifiers."""
        return replace(self, physical=False)

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change, in the precision by which it is judged."""
        return read_only(value, widened=False)


_CURE = Cure.of(
    "give S1^2 + S2^2 + S3^2 <= S0^2, or {} for what is measured as it is".format,
    "physical=False",
    "physical = false",
)


@dataclass(frozen=True)
class StokesDomain(PhysicalDomain):
    """Stokes vectors that light can have; none at all is unpolarised light."""

    def allows(self, numbers: Any) -> Any:
        finite = super().allows(numbers).all(axis=-1)
        lit = finite & (numbers[..., 0] >= 0.0)
        return lit & can_be_light(numbers, rounding_of(numbers)) if self.physical else lit

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        super()._check_numbers(owner, array, rounding)
        negative = array[..., 0] < 0.0
        if np.any(negative):
            value = array[..., 0][negative].ravel()[0]
            raise ValueFault(f"{owner} has the negative intensity {value}; give S0 >= 0")
        if self.physical and not surely_light(array):
            bad = ~can_be_light(array, rounding)
            if np.any(bad):
                state = array[bad].reshape(-1, 4)[0].tolist()
                raise ValueFault(Fault(f"{owner} is {state}, polarised by more than 100 %", _CURE))


def surely_light(stokes: npt.NDArray[Any]) -> bool:
    """Tell quickly, and never wrongly, whether all are light, polarised by 100 % at most."""
    with np.errstate(all="ignore"):
        squares = np.einsum("...i,...i->...", stokes, stokes)
        most = (2.0 + _ROUNDING) * stokes[..., 0] ** 2
        # Beyond, squares have lost digits.
        sure = (squares <= most) & (most < _MOST) & (most > _LEAST)
        return bool(np.all(sure & (stokes[..., 0] > 0.0)))


def can_be_light(stokes: Any, rounding: float) -> Any:
    """Return which Stokes vectors (..., 4) are polarized by 100 % at most."""
    xp = namespace(stokes)
    dark = stokes[..., :1] == 0.0
    shares = abs(stokes[..., 1:]) / xp.where(dark, 1.0, stokes[..., :1])
    # Cut off, so that squares of what is far too much do not overflow.
    polarised = xp.linalg.norm(xp.minimum(shares, 2.0), axis=-1)
    most = 1.0 + max(_ROUNDING, _GATHERED * rounding)
    return xp.where(dark[..., 0], xp.max(shares, axis=-1) == 0.0, polarised <= most)
