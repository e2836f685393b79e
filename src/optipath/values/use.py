"""Use: a value where it stands, and the check of what it may be there."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from operator import and_
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ValueFault
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.curves.computed_check import check_computed
from optipath.values.curves.curve_value import CurveValue
from optipath.values.degrees import is_of_an_angle, meant_in_degrees
from optipath.values.parameters import Parameter
from optipath.values.resolved import THERE
from optipath.values.units import dimension_of
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from optipath.values.domains.domain import Domain
    from optipath.values.resolved import Resolved


@dataclass(frozen=True, slots=True)
class Use:
    """A value where it stands."""

    owner: str
    value: Any
    domain: Domain
    checked: bool = False

    @property
    def is_open(self) -> bool:
        """Whether the value is a parameter that is given when the plan runs."""
        return isinstance(self.value, Parameter) and not self.value.bound

    def rests_on(self, names: Collection[str]) -> bool:
        """Tell whether the value is one of some parameters, or follows from one of them."""
        value = self.value
        arguments = value.arguments if isinstance(value, CurveValue) else ()
        return not {value.name, *[argument.name for argument in arguments]}.isdisjoint(names)

    def with_arguments(self) -> list[Use]:
        """Return the parameters that the value is computed of, where these stand, and itself."""
        value = self.value
        if not isinstance(value, CurveValue):
            return [self]
        return [*[Use(*place) for place in value.argument_places(self.owner)], self]

    @property
    def is_traced(self) -> bool:
        """Whether the value is known, but to JAX alone, which traces it."""
        value = self.value
        known = value.default if isinstance(value, Parameter) and value.bound else value
        return is_traced(known)

    def batch_shape(self, numbers: Any) -> tuple[int, ...]:
        """Return the shape of numbers for this place, the axes of one value left out."""
        if type(numbers) is float:
            return ()
        if is_traced(numbers):
            shape: tuple[int, ...] = numbers.shape
        else:
            try:
                shape = as_given("", numbers).shape
            except OptipathError:
                return ()  # What is no array is a fault of its own.
        return shape[: len(shape) - len(self.domain.tail)]

    def known_shape(self) -> tuple[int, ...]:
        """Return the batch shape of a value that is known."""
        value = self.value
        return self.batch_shape(value.default if isinstance(value, Parameter) else value)

    def inside(self, resolved: Mapping[str, Resolved]) -> Any:
        """Return for which paths a value that JAX traces is allowed; True for any other."""
        value: Any = self.value
        parameter = isinstance(value, Parameter)
        numbers: Any = resolved[value.name].value if self.is_open else value
        numbers = numbers.default if parameter and value.bound else numbers
        if not is_traced(numbers):
            return True
        placed = value.placed(numbers) if parameter else numbers
        found = [self.domain.allows(placed)]
        if parameter:
            # What is not looked at, as behind the end of a chain, may be no number.
            unseen = self.domain.takes_any and ~namespace(numbers).isfinite(numbers)
            found.append(value.allows(numbers) | unseen)
        batch = len(self.batch_shape(numbers))
        return reduce(and_, (part.all(axis=tuple(range(batch, part.ndim))) for part in found))

    def check(self) -> None:
        """Check what is known of the value: all of it, or a parameter's unit and default."""
        if self.checked:
            return
        if not isinstance(self.value, Parameter):
            self.domain.check(self.owner, self.value)
            return
        self.domain.check_parameter(self.owner, self.value)
        unit, name = self.value.unit, self.value.name
        if unit and dimension_of(unit) != self.domain.dimension:
            raise ValueFault(
                f"parameter '{name}' is in {unit}, but {self.owner} takes "
                f"{self.domain.described()}; change its unit or where it is used"
            )
        self.value.check_place(self.owner, self.domain)
        default = self.value.default
        if self.value.is_listed and (doubt := self.doubt(default.tolist())):
            raise ValueFault(doubt)
        if self.value.is_material and not self.domain.takes_materials:
            raise ValueFault(self._no_index(default))
        if type(default) is float:
            # Whether a number is in the range was asked when the parameter was made.
            self.check_given(default)
        elif default is not None:
            self.check_given(*self.value.resolve(default))

    def doubt(self, given: Any) -> str:
        """Ask what a list or a `Material` that is given for the parameter means; mostly nothing."""
        if hasattr(type(given), "refractive_index") and not self.domain.takes_materials:
            return self._no_index(given)
        if not isinstance(given, (list, tuple)):
            return ""
        return self.domain.doubt(f"parameter '{self.value.name}' (at {self.owner})", given)

    def _no_index(self, material: Any) -> str:
        return (
            f"parameter '{self.value.name}' (at {self.owner}) is {material}, but a Material stands "
            f"for an index of refraction; give {self.domain.described()}"
        )

    def check_given(
        self,
        numbers: float | np.ndarray[Any, Any],
        present: np.ndarray[Any, Any] = THERE,
        given: Mapping[str, Resolved] | None = None,
    ) -> None:
        """Check numbers given for the parameter that stands here."""
        value = self.value
        if isinstance(value, CurveValue):
            check_computed(value, self.owner, self.domain, numbers, given)
            return
        if value.is_signed:
            negative = value.scale < 0.0
            placed = -numbers if negative else numbers
            what = f"{self.owner}, as {value.formula}" if negative else self.owner
            self.domain.check(f"parameter '{value.name}' (at {what})", placed)
            return
        placed = value.placed(numbers, self.domain.interval)
        if not np.all(present):
            placed = np.where(present, placed, 0.0)
        try:
            # What arithmetic has made of a number is not what somebody has written.
            with units_are_written():
                what = f"parameter '{value.name}' (at {self.owner}, as {value.formula})"
                self.domain.check(what, placed)
        except ValueFault as fault:
            raise ValueFault(
                *(sentence + self._meant(numbers) for sentence in fault.faults)
            ) from None

    def _meant(self, numbers: Any) -> str:
        """Return what a number given for a multiple was meant to be, if it is one of degrees."""
        of_angle = self.domain.dimension == "angle" and is_of_an_angle(self.value.scale)
        if not of_angle or np.iscomplexobj(numbers):
            return ""

        def allows(number: Any) -> Any:
            return self.domain.allows(np.asarray(self.value.placed(number, self.domain.interval)))

        refused = np.ravel(numbers)[~np.ravel(allows(np.asarray(numbers)))]
        return meant_in_degrees(float(refused[0]), allows) if refused.size else ""
