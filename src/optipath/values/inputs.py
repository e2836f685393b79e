"""Inputs: what may be given to a plan, and the check of what is given."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce
from operator import and_
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ParameterError, ValueFault, did_you_mean
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.shapes import broadcast_fault, joint_shape
from optipath.values.parameters import Parameter, Resolved
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.values.domains.domain import Domain

_THERE = np.ones((), dtype=bool)


@dataclass(frozen=True, slots=True)
class Use:
    """A value where it stands.

    Attributes
    ----------
    owner : str
        The node and the field, such as ``X1.incidence``.
    value : Any
        A number, an array, or a `Parameter`.
    domain : Domain
        Which values are allowed there.
    """

    owner: str
    value: Any
    domain: Domain

    @property
    def is_open(self) -> bool:
        """Whether the value is a parameter that is given when the plan runs."""
        return isinstance(self.value, Parameter) and not self.value.bound

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
        signed = -numbers if parameter and value.negative else numbers
        found = [self.domain.allows(signed), *([value.allows(numbers)] if parameter else [])]
        batch = len(self.batch_shape(numbers))
        return reduce(and_, (part.all(axis=tuple(range(batch, part.ndim))) for part in found))

    def check(self) -> None:
        """Check what is known of the value: all of it, or a parameter's unit and default.

        Raises
        ------
        ValueFault
            Naming the owner, the value and what is asked for.
        """
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
        default = self.value.default
        if default is not None:
            # Whether a number is in the range was asked when the parameter was made.
            number = type(default) is float
            self.check_given(default if number else self.value.resolve(default).value)

    def check_given(self, numbers: float | np.ndarray[Any, Any]) -> None:
        """Check numbers given for the parameter that stands here.

        Raises
        ------
        ValueFault
            Naming the parameter, the place and the value.
        """
        signed = -numbers if self.value.negative else numbers
        self.domain.check(f"parameter '{self.value.name}' (at {self.owner})", signed)


@dataclass(frozen=True, eq=False)
class Inputs:
    """The open parameters of a path, where they are used, and the shapes already known.

    Attributes
    ----------
    open : mapping of str to Parameter
        What can be given.
    bound : mapping of str to Parameter
        What has been given for good.
    uses : tuple of Use
        Where the open parameters stand.
    shapes : mapping of str to tuple of int
        The batch shapes of arrays that are known, by owner.
    known : tuple of Use
        Where values stand that are known, but to JAX alone.
    """

    open: Mapping[str, Parameter]
    bound: Mapping[str, Parameter]
    uses: tuple[Use, ...]
    shapes: Mapping[str, tuple[int, ...]]
    known: tuple[Use, ...] = ()

    def resolve(
        self, given: Mapping[str, Any], plain: Callable[[str, Any], bool] | None = None
    ) -> tuple[dict[str, Resolved], tuple[int, ...]]:
        """Return the numbers of every open parameter, and the shape of the batch.

        Parameters
        ----------
        given : mapping of str to Any
            What is given, by name; defaults stand in for the rest.
        plain : callable, optional
            Tells of a name and a value whether it is taken as it stands, its range unchecked.

        Returns
        -------
        resolved : dict of str to Resolved
            The numbers by name.
        batch : tuple of int
            The shape that they and all known arrays broadcast to.

        Raises
        ------
        ParameterError
            With every fault of what is given.
        """
        faults = [self._unknown(name) for name in given if name not in self.open]
        resolved: dict[str, Resolved] = {}
        unchecked = set()
        for name, parameter in self.open.items():
            value = given.get(name, parameter.default)
            if value is None:
                faults.append(f"parameter '{name}' has no value; give one, {name}=...")
            elif plain is not None and plain(name, value):
                resolved[name] = Resolved(value, _THERE)
                unchecked.add(name)
            else:
                try:
                    resolved[name] = parameter.resolve(value, self.limits[name])
                except OptipathError as fault:
                    faults += fault.faults
        shapes = dict(self.shapes)
        for use in self.distinct_uses:
            name = use.value.name
            if name not in resolved:
                continue
            numbers = resolved[name].value
            try:
                if name not in unchecked:
                    use.check_given(numbers)
            except OptipathError as fault:
                faults += fault.faults
            else:
                shape = getattr(numbers, "shape", ())
                shapes[name] = shape[: len(shape) - len(use.domain.tail)]
        faults += broadcast_fault(shapes)
        if faults and unchecked:
            return self.resolve(given)  # Tells of ranges, too.
        if faults:
            raise ParameterError(*faults)
        return resolved, joint_shape(*shapes.values())

    @cached_property
    def distinct_uses(self) -> tuple[Use, ...]:
        """The uses that ask different things of a parameter."""
        found: dict[Any, Use] = {}
        for use in self.uses:
            found.setdefault((use.value, use.domain), use)
        return tuple(found.values())

    def inside(self, resolved: Mapping[str, Resolved]) -> Any:
        """Return for which paths all values that JAX traces are allowed; True where it has none."""
        return reduce(and_, (use.inside(resolved) for use in (*self.uses, *self.known)), True)  # noqa: FBT003

    @cached_property
    def limits(self) -> dict[str, tuple[float, float]]:
        """The range of each open parameter, wherever it stands; its own range included."""
        found = {name: (p.minimum, p.maximum) for name, p in self.open.items()}
        for use in self.uses:
            name = use.value.name
            low, high = use.domain.interval
            if use.value.negative:
                low, high = -high, -low
            found[name] = max(found[name][0], low), min(found[name][1], high)
        return found

    @cached_property
    def dimensions(self) -> dict[str, str]:
        """The dimension of each open parameter."""
        return {use.value.name: use.domain.dimension for use in self.uses}

    @cached_property
    def tails(self) -> dict[str, tuple[int, ...]]:
        """The axes of one value of each open parameter, behind the batch."""
        return {use.value.name: use.domain.tail for use in self.uses}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Inputs):
            return NotImplemented
        return dict(self.open) == dict(other.open) and self._batch() == other._batch()

    __hash__ = None  # type: ignore[assignment]

    def _batch(self) -> tuple[int, ...]:
        return joint_shape(*self.shapes.values())

    def _unknown(self, name: str) -> str:
        if name in self.bound:
            value = self.bound[name]
            return (
                f"parameter '{name}' is bound to {value.text(value.default)}; "
                f"leave it open when loading or building the path to vary it"
            )
        return f"parameter '{name}' is unknown{did_you_mean(name, self.open)}"
