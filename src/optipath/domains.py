"""Domains: which values a quantity of an element may take.

The annotated types below say it where the fields of an element are declared:
``angle: Angle = 0.0``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from optipath.errors import ValueFault, did_you_mean
from optipath.frozen import array_of
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
        ``"angle"``, ``"length"``, or ``""``.
    minimum, maximum : float
        The limits, in radians or metres where there is a dimension.
    tail : tuple of int
        The axes behind the batch: ``(4,)`` for a Stokes vector.
    """

    name: str
    dimension: str = ""
    minimum: float = -np.inf
    maximum: float = np.inf
    tail: tuple[int, ...] = ()

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
        return format_quantity(value, USUAL_UNITS[self.dimension])

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
        return replace(value, unit=USUAL_UNITS[domain.dimension])
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


_N = Domain("index of refraction", minimum=0.0)
_K = Domain("extinction coefficient", minimum=0.0)
_NO_K = Domain("extinction coefficient of the medium that light comes from", minimum=0.0, maximum=0)
REAL = Domain("number")

ANGLE = Domain("angle", "angle")
Angle: TypeAlias = Annotated[Quantity, ANGLE]
INCIDENCE = Domain("angle of incidence", "angle", minimum=0.0, maximum=np.pi / 2)
Incidence: TypeAlias = Annotated[Quantity, INCIDENCE]
Fraction: TypeAlias = Annotated[Quantity, Domain("fraction", minimum=0.0, maximum=1.0)]
NonNegative: TypeAlias = Annotated[Quantity, Domain("number", minimum=0.0)]
Real: TypeAlias = Annotated[Quantity, REAL]
Index: TypeAlias = Annotated[Quantity | Material, IndexDomain("index of refraction")]
OutsideIndex: TypeAlias = Annotated[
    Quantity | Material, OutsideDomain("index of refraction", minimum=np.finfo(float).tiny)
]
StokesState: TypeAlias = Annotated[Quantity, StokesDomain("Stokes vector", tail=(4,))]
MuellerMatrix: TypeAlias = Annotated[Quantity, Domain("Mueller matrix", tail=(4, 4))]
READINGS = ("stokes", "linear", "intensity")
Reads: TypeAlias = Annotated[str, Choice("reading", words=READINGS)]
