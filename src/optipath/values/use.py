"""Use: a value at its place in a path, and the check of what it may be there."""

from __future__ import annotations

from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass
from functools import reduce
from itertools import chain
from operator import and_
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from optipath.errors import OptipathError, ParameterError, ValueFault
from optipath.values.angles import TURN, warn_of_degrees
from optipath.values.arrays import as_argument
from optipath.values.curve_value import CurveValue, check_computed, takes_0_alone
from optipath.values.domains import Domain, Refused, in_unit_of
from optipath.values.jax_values import is_traced, namespace
from optipath.values.parameters import (
    AXES,
    PURE,
    THERE,
    Parameter,
    unknown_word,
    warn_of_limits,
    word_meant,
)
from optipath.values.precision import affine
from optipath.values.units import dimension_of, with_article

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Mapping

    from optipath.values.parameters import Resolved


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

    def batch_shape(self, numbers: Any) -> tuple[int, ...]:
        """Return the shape of numbers for this place, the axes of one value left out."""
        if type(numbers) is float:
            return ()
        with suppress(OptipathError):  # What is no array is a fault of its own.
            shape = numbers.shape if is_traced(numbers) else as_argument("", numbers).shape
            return tuple(shape[: len(shape) - len(self.domain.tail)])
        return ()

    def inside(self, resolved: Mapping[str, Resolved]) -> Any:
        """Return for which paths a value that JAX traces is allowed; True for any other."""
        value: Any = self.value
        numbers: Any = value
        if is_parameter := isinstance(value, Parameter):
            numbers = value.default if value.bound else resolved[value.name].value
        if not is_traced(numbers):
            return True
        results = [self.domain.allows(value.placed(numbers) if is_parameter else numbers)]
        if is_parameter:
            # What is not looked at, as behind the end of a chain, may be no number.
            unseen = self.domain.takes_any and ~namespace(numbers).isfinite(numbers)
            results.append(value.allows(numbers) | unseen)
        batch = len(self.batch_shape(numbers))
        return reduce(and_, (part.all(axis=tuple(range(batch, part.ndim))) for part in results))

    def check(self) -> None:
        """Check what is known of the value: all of it, or a parameter's unit and default."""
        if self.checked:
            return
        value, domain = self.value, self.domain
        if not isinstance(value, Parameter) or isinstance(domain, Refused):
            domain.check(self.owner, value)
            return
        if not domain.takes_parameters:
            wanted = domain.described()
            raise ValueFault(f"{self.owner} cannot be a parameter; give {wanted}")
        unit, offset = value.unit, value.offset_dimension
        is_other = bool(unit) and dimension_of(unit) != domain.dimension
        if is_other or (offset and offset != (domain.dimension or PURE)):
            what = f"is in {unit}" if is_other else f"has an offset that is {with_article(offset)}"
            raise ValueFault(
                f"parameter '{value.name}' {what}, but {self.owner} takes "
                f"{domain.described()}; change its unit or where it is used"
            )
        if domain.tail and not value.is_signed:
            raise ValueFault(
                f"{self.owner} is {value.formula}, but takes several numbers that belong together; "
                f"compute them in NumPy and give them as the parameter '{value.name}'"
            )
        if isinstance(value, CurveValue) and value.is_nowhere_0 and takes_0_alone(domain):
            raise ValueFault(
                f"{value.formula_of(value.spoken)} is 0 at no wavelength, and {self.owner} takes "
                f"{domain.described()}"
            )
        default = value.default
        if value.is_material:
            self.refuse_material(default)
        if type(default) is float:  # Whether it is in the range was asked when it was made.
            self.check_arguments(default)
        elif default is not None:
            self.check_arguments(*value.resolve(default))

    def refuse_material(self, material: Any) -> None:
        """Raise where a `Material` is given for what is no index of refraction."""
        if not self.domain.takes_materials:
            raise ValueFault(
                f"parameter '{self.value.name}' (at {self.owner}) is {material}, but a Material "
                f"stands for an index of refraction; give {self.domain.described()}"
            )

    def check_arguments(
        self,
        numbers: float | np.ndarray[Any, Any],
        present: np.ndarray[Any, Any] = THERE,
        arguments: Mapping[str, Resolved] | None = None,
    ) -> None:
        """Check numbers given for the parameter that stands here."""
        value = self.value
        if isinstance(value, CurveValue):
            check_computed(value, self.owner, self.domain, numbers, arguments)
            return
        if value.offset == 0.0 and value.scale == 1.0 and self.domain.quickly_allows(numbers):
            return
        placed = affine(value.scale, value.offset, numbers, self.domain.interval)
        if not value.is_signed and not np.all(present):
            placed = np.where(present, placed, 0.0)
        where = self.owner if placed is numbers else f"{self.owner}, as {value.formula}"
        self.domain.check(f"parameter '{value.name}' (at {where})", placed)


def known_among(uses: Iterable[Use]) -> list[tuple[Use, Any]]:
    """Return the values that are known, each with what it is; of a parameter, its default."""
    return [
        (use, value.default if isinstance(value, Parameter) else value)
        for use in uses
        if not isinstance(value := use.value, Parameter) or value.bound
    ]


T = TypeVar("T")

_EXACT = 1 << 53
"""Up to what size a float is every whole number."""

_is_checked_later: ContextVar[bool] = ContextVar("_is_checked_later", default=False)


@contextmanager
def checked_later() -> Iterator[None]:
    """Leave the values of what is made inside to the check of the whole path, which names nodes."""
    token = _is_checked_later.set(True)
    try:
        yield
    finally:
        _is_checked_later.reset(token)


def is_checked_later() -> bool:
    """Tell whether values are left to the check of the whole path."""
    return _is_checked_later.get()


def make_sound(
    whole: Any,
    domains: Mapping[str, Domain],
    quantities: Callable[[], Iterable[tuple[str, Any, Domain]]],
    *,
    of_fields: bool = True,
) -> bool:
    """Replace the values of something by what it keeps, and refuse what is not allowed."""
    sound: dict[str, Domain] = {}
    faults: dict[str, tuple[str, ...]] = {}
    for name, domain in domains.items():
        value = getattr(whole, name)
        number = float(value) if type(value) is int and abs(value) <= _EXACT else value
        left_out = value is None and not domain.parts(name, value)
        if left_out or domain.quickly_allows(number):
            sound[name] = domain
            continue
        owner = f"{type(whole).__name__} {name}"
        try:
            object.__setattr__(whole, name, stored_value(owner, value, domain))
        except ValueFault as fault:
            faults[name] = fault.faults
    if _is_checked_later.get():
        return False
    if of_fields and len(sound) == len(domains):
        return True
    uses = [
        Use(f"{type(whole).__name__} {name}", value, domain)
        for name, value, domain in quantities()
        if name not in faults and sound.get(name) is not domain
    ]
    refuse([*chain(*faults.values()), *faults_of(uses)])
    return True


def stored_value(owner: str, value: Any, domain: Domain) -> Any:
    """Return a value as it is kept: numbers for texts, read-only arrays, parameters with a unit."""
    warns = domain.dimension == "angle" and not _is_checked_later.get()
    looks = warns and max(-domain.minimum, domain.maximum) > TURN
    if not isinstance(value, Parameter):
        if looks:
            warn_of_degrees(owner, value)
        return domain.kept(domain.read(owner, value))
    # Of a parameter with a unit, it has been told when it was made.
    if looks and (value.bound or not value.unit):
        warn_of_degrees(owner, value.plain_numbers, value.placed)
    if looks and not value.offset_dimension:
        warn_of_degrees(f"the offset of parameter '{value.name}' at {owner}", value.offset)
    if warns and not value.unit:
        warn_of_limits(value, value.placed)
    return value if value.unit else in_unit_of(value, domain)


def refuse(faults: list[str]) -> None:
    """Raise with what is wrong with something that has just been made, unless it is told later."""
    if faults and not _is_checked_later.get():
        raise ValueFault(*faults)


def faults_of(uses: Iterable[Use]) -> list[str]:
    """Return what is wrong with the values that are known already, a sentence each."""
    results: list[str] = []
    for use in uses:
        with ValueFault.collecting(results):
            use.check()
    return results


def axes_for(name: str, value: Any, uses: Iterable[Use]) -> Any:
    """Return what is given for a parameter, with angles for names of axes if it stands as one.

    A parameter whose negative is the axis, as in double pass, has the name for its own angle.
    """
    if not isinstance(value, (str, list, tuple)):
        return value
    for use in uses:
        if not isinstance(use.domain, AxisDomain) or not isinstance(use.value, Parameter):
            continue
        if use.value.name == name and use.value.is_signed:
            if isinstance(value, str):
                return _angle_of(value, use.value)
            # One row of them; a list of lists may be anything, even a part of itself.
            return [_angle_of(one, use.value) for one in value]
    return value


def _angle_of(value: Any, parameter: Parameter) -> Any:
    """Return the angle of an axis that has a name; the value itself where that is none."""
    if not isinstance(value, str) or value in parameter.all_words:
        return value
    if value[:1].isalpha() and value not in AXES:
        words = dict.fromkeys((*parameter.all_words, *AXES))
        raise ParameterError(unknown_word(parameter.name, value, words, "angle"))
    return AXES.get(value, value)


class AxisDomain(Domain):
    """Angles of an axis across the light; some have names."""

    def parse(self, text: str) -> Any:
        if (word := text.strip()) in AXES:
            return AXES[word]
        if word[:1].isalpha():
            raise ValueFault(f"axis '{word}' is unknown{word_meant(word, AXES, self.dimension)}")
        return super().parse(text)
