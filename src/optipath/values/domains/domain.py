"""Domain: which real numbers a quantity of an element may be."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from optipath.errors import ValueFault, shown
from optipath.values.angles import CosSin
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.read_only import changed, read_only
from optipath.values.arrays.shapes import first_place
from optipath.values.degrees import TURN, called
from optipath.values.parameters import Parameter
from optipath.values.roundings import as_doubles, doubles, held, rounding_of
from optipath.values.texts import numbers_for
from optipath.values.units import USUAL_UNITS, format_quantity, parse_quantity


@dataclass(frozen=True)
class Domain:
    """Real numbers between two limits, both included.

    Units: minimum, maximum in radians.
    """

    complex_parts: ClassVar[tuple[str, ...]] = ()
    of_numbers: ClassVar[str] = "finite"
    masks = False  # Whether light of what is not allowed is NaN, and nothing is refused.

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

        Shape: returns (..., *tail).
        """
        if self.quickly_allows(value):
            return np.array(value)
        if is_traced(value):
            self._check_shape(owner, value.shape)
            return value  # type: ignore[no-any-return]
        value = self.read(owner, value)
        given = as_given(owner, value)
        array = doubles(given, (self.minimum, self.maximum))
        if array.dtype.kind in "iu":
            array = array.astype(np.float64)
        if array.dtype.kind not in "fc":
            raise ValueFault(f"{owner} {self._no_number(value, array)}")
        self._check_shape(owner, array.shape)
        if np.any(bad := ~self.are_numbers(array)):
            found = f"{array[bad].ravel()[0]}{first_place(bad)}"
            raise ValueFault(f"{owner} is {found}; give a {self.of_numbers} {self.name}")
        self._check_numbers(owner, array, rounding_of(given))
        return array

    def _no_number(self, value: Any, array: npt.NDArray[Any]) -> str:
        """Return why something is no number; what comes behind the name of its owner."""
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
        """Return which numbers of an array are allowed, or for which paths; JAX's as well.

        Examples
        --------
        >>> Domain("share", minimum=0.0, maximum=1.0).allows(np.array([0.5, 2.0, np.nan]))
        array([ True, False, False])
        """
        inside = self.are_numbers(numbers)
        if numbers.dtype.kind == "c":
            return inside & False
        low, high = held(numbers, (self.minimum, self.maximum))
        return inside & (numbers >= low) & (numbers <= high)

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        """Say what is wrong with a parameter standing here, whatever its value; mostly nothing."""

    @property
    def unphysical(self) -> Domain:
        """The domain of values as they are measured, or of what amplifies; mostly the same."""
        return self

    @property
    def shows_in_light(self) -> bool:
        """Whether no light is finite where an array of the right shape is not allowed.

        Formulas look at their light anyway, so that nobody needs to look at the array first.
        """
        return False

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

    def doubt(self, owner: str, value: Any) -> str:
        """Ask what a value means that may be one or several; mostly nothing."""
        del owner, value
        return ""

    @property
    def takes_materials(self) -> bool:
        """Whether a `Material` may stand for the number."""
        return self.name == "index of refraction"

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change."""
        return read_only(value, (self.minimum, self.maximum))

    @property
    def takes_large_angles(self) -> bool:
        """Whether angles beyond a whole turn are allowed."""
        return self.dimension == "angle" and max(-self.minimum, self.maximum) > TURN

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

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        del rounding
        if array.dtype.kind == "c":
            raise ValueFault(f"{owner} is complex; give {self.described()}")
        if np.isinf(self.minimum) and np.isinf(self.maximum):
            return
        # Limits are doubles, and what rounds to one of them is inside.
        rounded = as_doubles(array)
        bad = ~self.allows(rounded)
        if np.any(bad):
            number = float(array[bad].ravel()[0])
            value, meant = self.called(number)
            raise ValueFault(
                f"{owner} is {value}{first_place(bad)}; give {self.described()}{meant}"
            )

    def called(self, number: float) -> tuple[str, str]:
        """Return how a number that is not allowed is called, and what it was meant to be."""
        limits = self.minimum, self.maximum
        return called(number, self._text(number), self.dimension, limits)


def in_unit_of(value: Any, domain: Domain) -> Any:
    """Return a value; a parameter without a unit gets the usual one of a domain.

    Examples
    --------
    >>> in_unit_of(Parameter("theta"), Domain("angle", "angle")).unit
    'deg'
    """
    if isinstance(value, Parameter) and not value.unit:
        return changed(value, unit=domain.unit)
    return value
