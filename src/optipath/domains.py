"""Domains: which values a quantity of an element may take.

The annotated types below say it where the fields of an element are declared:
``angle: Angle = 0.0``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, TypeAlias

import numpy as np
import numpy.typing as npt

from optipath.errors import ValueFault, did_you_mean
from optipath.frozen import array_of, frozen
from optipath.jax_values import is_traced
from optipath.materials import Material
from optipath.parameters import Parameter
from optipath.units import USUAL_UNITS, format_quantity

_ROUNDING = 1e-12

Quantity: TypeAlias = npt.ArrayLike | Parameter
"""A number, an array over paths, or a parameter that will give either."""


@dataclass(frozen=True)
class Domain:
    """Real numbers between two limits, both included.

    Attributes
    ----------
    name : str
        What error messages call the quantity.
    dimension : str
        ``"angle"``, ``"length"``, ``"inverse length"``, ``"angle per length"``, or ``""``.
    minimum, maximum : float
        The limits, in radians and metres where there is a dimension.
    tail : tuple of int
        The axes behind the batch: ``(4,)`` for a Stokes vector.
    own_unit : str
        The unit that is usual here, where it is not the usual one of the dimension.
    complex_parts : tuple of str
        What files call the two parts of a complex number; none where numbers are real.
    """

    complex_parts: ClassVar[tuple[str, ...]] = ()

    name: str
    dimension: str = ""
    minimum: float = -np.inf
    maximum: float = np.inf
    tail: tuple[int, ...] = ()
    own_unit: str = ""

    @property
    def unit(self) -> str:
        """The unit in which values are written where nobody says another."""
        return self.own_unit or USUAL_UNITS[self.dimension]

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        """Return the value as an array of numbers, or say what is wrong with it.

        Raises
        ------
        ValueFault
            Naming the owner, the value, and what is asked for.
        """
        if self.quickly_allows(value) or is_traced(value):
            return value if is_traced(value) else np.array(value)
        try:
            array = array_of(value)
        except ValueError:
            raise ValueFault(f"{owner} has rows of unequal lengths; make it one shape") from None
        if array.dtype.kind in "iu":
            array = array.astype(np.float64)
        if array.dtype.kind not in "fc":
            raise ValueFault(f"{owner} must be {self.described()}, not {value!r}")
        if self.tail and array.shape[-len(self.tail) :] != self.tail:
            wanted = ", ".join(map(str, ("...", *self.tail)))
            raise ValueFault(f"{owner} must have shape ({wanted}), not {array.shape}")
        if not np.all(np.isfinite(array)):
            found = array[~np.isfinite(array)].ravel()[0]
            raise ValueFault(f"{owner} is {found}; give a finite {self.name}")
        self._check_numbers(owner, array)
        return array

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        """Say what is wrong with a parameter standing here, whatever its value; mostly nothing.

        Raises
        ------
        ValueFault
            Naming the owner and the parameter.
        """

    @property
    def shows_in_light(self) -> bool:
        """Whether no light is finite where an array of the right shape is not allowed.

        Formulas look at their light anyway, so that nobody needs to look at the array first.
        """
        return False

    def quickly_allows(self, value: Any) -> bool:
        """Tell, for the plain floats that long paths are made of, whether all is well."""
        inside = type(value) is float and self.minimum <= value <= self.maximum
        return inside and math.isfinite(value) and not self.tail

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change."""
        return frozen(value)

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of real numbers; wide open where they are limited in other ways too."""
        return self.minimum, self.maximum

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return the numbers that make up a value: their names, values and domains."""
        return [(name, value, self)]

    def described(self) -> str:
        """Say in words which values are allowed."""
        low, high = self._text(self.minimum), self._text(self.maximum)
        if np.isinf(self.minimum) and np.isinf(self.maximum):
            return f"a real {self.name}"
        if np.isinf(self.maximum):
            return f"a real {self.name} of {low} or more"
        return f"a real {self.name} within {low} .. {high}"

    def _text(self, value: float) -> str:
        return format_quantity(value, self.unit)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any]) -> None:
        if array.dtype.kind == "c":
            raise ValueFault(f"{owner} is complex; give {self.described()}")
        if np.isinf(self.minimum) and np.isinf(self.maximum):
            return
        bad = (array < self.minimum) | (array > self.maximum)
        if np.any(bad):
            value = self._text(float(array[bad].ravel()[0]))
            raise ValueFault(f"{owner} is {value}; give {self.described()}")


class IndexDomain(Domain):
    """Complex numbers n + ik with n and k not negative."""

    complex_parts = ("n", "k")

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of n and of k."""
        return 0.0, math.inf

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return n and k of a material, or the value itself."""
        if not isinstance(value, Material):
            return super().parts(name, value)
        return [(f"{name}.n", value.n, _N), (f"{name}.k", value.k, _K)]

    def quickly_allows(self, value: Any) -> bool:
        """Tell, for plain floats, whether all is well."""
        return type(value) is float and 0.0 <= value < math.inf

    def described(self) -> str:
        """Say in words which values are allowed."""
        return "an index of refraction n + ik with n and k not negative"

    def _check_numbers(self, owner: str, array: npt.NDArray[Any]) -> None:
        bad = (array.real < 0.0) | (array.imag < 0.0)
        if np.any(bad):
            value = array[bad].ravel()[0]
            cure = " (the field is exp(-iwt): k > 0 absorbs)" if value.imag < 0.0 else ""
            raise ValueFault(f"{owner} is {value}; give {self.described()}{cure}")


class AmplitudeDomain(Domain):
    """Complex numbers of a size of 1 or less."""

    complex_parts = ("re", "im")

    @property
    def interval(self) -> tuple[float, float]:
        """The limits of both parts."""
        return -1.0 - _ROUNDING, 1.0 + _ROUNDING

    def quickly_allows(self, value: Any) -> bool:
        """Tell, for plain floats, whether all is well."""
        return type(value) is float and -1.0 <= value <= 1.0

    def described(self) -> str:
        """Say in words which values are allowed."""
        return f"a real or complex {self.name} of a size of 1 or less"

    def _check_numbers(self, owner: str, array: npt.NDArray[Any]) -> None:
        # Cut off, so that squares of what is far too much do not overflow.
        parts = (np.minimum(np.abs(part), 2.0) for part in (array.real, array.imag))
        bad = np.hypot(*parts) > 1.0 + _ROUNDING
        if np.any(bad):
            raise ValueFault(f"{owner} is {array[bad].ravel()[0]}; give {self.described()}")


class OutsideDomain(Domain):
    """Positive real numbers: the medium that light comes from does not absorb."""

    def described(self) -> str:
        """Say in words which values are allowed."""
        return "a real index of refraction above 0, since light comes from there"

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return n and k of a material, or the value itself."""
        if not isinstance(value, Material):
            return super().parts(name, value)
        return [(f"{name}.n", value.n, self), (f"{name}.k", value.k, _NO_K)]


class OptionalOutside(OutsideDomain):
    """The same, or none."""

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return n and k of a material, or the value itself, if there is one."""
        return [] if value is None else super().parts(name, value)


class LitBehind(OutsideDomain):
    """Indices of a medium behind a boundary from which light comes as well."""

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return n and k of a material, or the value itself."""
        if not isinstance(value, Material):
            return [(name, value, self)]
        return [(f"{name}.n", value.n, self), (f"{name}.k", value.k, _NO_K_BEHIND)]

    def described(self) -> str:
        """Say in words which values are allowed."""
        return (
            "a real index of refraction above 0, since light comes from there too (by port "
            "'back'), and let a Medium absorb between"
        )

    def _check_numbers(self, owner: str, array: npt.NDArray[Any]) -> None:
        # A complex number without an imaginary part will do.
        real = array.real if array.dtype.kind == "c" and not np.any(array.imag) else array
        super()._check_numbers(owner, real)


class InnerDomain(OutsideDomain):
    """Indices of the layers of a stack, between which light goes to and fro."""

    def described(self) -> str:
        """Say in words which values are allowed."""
        return (
            "a real index of refraction above 0; what a layer absorbs depends on how thick it is: "
            "link Interfaces with a Medium between"
        )


class IndicesDomain(Domain):
    """Indices of the media of a stack, the front medium first and the substrate last."""

    def kept(self, value: Any) -> Any:
        """Return the indices one by one, since each may be an array of its own."""
        if not isinstance(value, (list, tuple, np.ndarray)):
            return value
        return tuple(_plain_index(frozen(index)) for index in value)

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return the numbers of each index, with what it may be."""
        if not isinstance(value, tuple) or len(value) < 2:
            return [(name, value, self)]
        domains = [OUTSIDE, *[INNER] * (len(value) - 2), INDEX]
        return [
            part
            for place, (index, domain) in enumerate(zip(value, domains, strict=True))
            for part in domain.parts(f"{name}[{place}]", index)
        ]

    def check(self, owner: str, value: Any) -> Any:
        """Refuse what is no list of two or more.

        Raises
        ------
        ValueFault
            Always, since good lists are checked by their parts.
        """
        raise ValueFault(
            f"{owner} is {value!r}; give a list of two indices or more, the medium in front first "
            f"and the substrate last"
        )


def _plain_index(index: Any) -> Any:
    """Return an index that came out of an array with others as the real number that it is."""
    return index.real if isinstance(index, complex) and index.imag == 0.0 else index


class StokesDomain(Domain):
    """Stokes vectors that light can have; none at all is unpolarised light."""

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return the vector, if there is one."""
        return [] if value is None else super().parts(name, value)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any]) -> None:
        super()._check_numbers(owner, array)
        negative = array[..., 0] < 0.0
        if np.any(negative):
            value = array[..., 0][negative].ravel()[0]
            raise ValueFault(f"{owner} has the negative intensity {value}; give S0 >= 0")
        dark = array[..., :1] == 0.0
        shares = np.abs(array[..., 1:]) / np.where(dark, 1.0, array[..., :1])
        # Cut off, so that squares of what is far too much do not overflow.
        polarised = np.linalg.norm(np.minimum(shares, 2.0), axis=-1)
        bad = polarised > np.where(dark[..., 0], 0.0, 1.0 + _ROUNDING)
        if np.any(bad):
            state = array[bad].reshape(-1, 4)[0].tolist()
            raise ValueFault(
                f"{owner} is {state}, polarised by more than 100 %; give S1^2 + S2^2 + S3^2 <= S0^2"
            )


def in_unit_of(value: Any, domain: Domain) -> Any:
    """Return a value; a parameter without a unit gets the usual one of a domain.

    Examples
    --------
    >>> in_unit_of(Parameter("theta"), Domain("angle", "angle")).unit
    'deg'
    """
    if isinstance(value, Parameter) and not value.unit:
        return replace(value, unit=domain.unit)
    return value


@dataclass(frozen=True)
class Choice(Domain):
    """One word out of a few."""

    words: tuple[str, ...] = ()

    def check(self, owner: str, value: Any) -> Any:
        """Return the word, or say which ones there are.

        Raises
        ------
        ValueFault
            If the value is none of the words.
        """
        if isinstance(value, str) and value in self.words:
            return value
        raise ValueFault(f"{owner} is {value!r}{did_you_mean(str(value), self.words)}")

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        """Refuse it.

        Raises
        ------
        ValueFault
            Always.
        """
        del parameter
        raise ValueFault(f"{owner} cannot be a parameter; choose one word when building")


_N = Domain("index of refraction", minimum=0.0)
_K = Domain("extinction coefficient", minimum=0.0)
_NO_K = Domain("extinction coefficient of the medium that light comes from", minimum=0.0, maximum=0)
_NO_K_BEHIND = Domain(
    "extinction coefficient, since light comes from there too (by port 'back')",
    minimum=0.0,
    maximum=0.0,
)
REAL = Domain("number")

ANGLE = Domain("angle", "angle")
Angle: TypeAlias = Annotated[Quantity, ANGLE]
INCIDENCE = Domain("angle of incidence", "angle", minimum=0.0, maximum=np.pi / 2)
Incidence: TypeAlias = Annotated[Quantity, INCIDENCE]
Fraction: TypeAlias = Annotated[Quantity, Domain("fraction", minimum=0.0, maximum=1.0)]
NonNegative: TypeAlias = Annotated[Quantity, Domain("number", minimum=0.0)]
Real: TypeAlias = Annotated[Quantity, REAL]
INDEX = IndexDomain("index of refraction")
Index: TypeAlias = Annotated[Quantity | Material, INDEX]
OUTSIDE = OutsideDomain("index of refraction", minimum=np.finfo(float).tiny)
OutsideIndex: TypeAlias = Annotated[Quantity | Material, OUTSIDE]
INNER = InnerDomain("index of refraction", minimum=np.finfo(float).tiny)
INDICES = IndicesDomain("indices of refraction")
Indices: TypeAlias = Annotated[Sequence[Quantity | Material], INDICES]
LIT_BEHIND = LitBehind("index of refraction", minimum=np.finfo(float).tiny)
OptionalIndex: TypeAlias = Annotated[
    Quantity | Material, OptionalOutside("index of refraction", minimum=np.finfo(float).tiny)
]
AMPLITUDE = AmplitudeDomain("amplitude")
Amplitude: TypeAlias = Annotated[Quantity, AMPLITUDE]
Length: TypeAlias = Annotated[Quantity, Domain("length", "length", minimum=0.0, own_unit="mm")]
Absorption: TypeAlias = Annotated[
    Quantity, Domain("absorption coefficient", "inverse length", minimum=0.0)
]
AnglePerLength: TypeAlias = Annotated[Quantity, Domain("angle per length", "angle per length")]
StokesState: TypeAlias = Annotated[Quantity, StokesDomain("Stokes vector", tail=(4,))]
MuellerMatrix: TypeAlias = Annotated[Quantity, Domain("Mueller matrix", tail=(4, 4))]
READINGS = ("stokes", "linear", "intensity")
Reads: TypeAlias = Annotated[str, Choice("reading", words=READINGS)]
