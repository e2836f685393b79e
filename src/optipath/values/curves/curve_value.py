"""CurveValue: a number that follows from the wavelength of a run, where it stands in a path."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Self, cast

import numpy as np

from optipath.errors import ParameterError, ValueFault, shown
from optipath.kernels.numbers.primitives import NUMPY
from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.read_only import changed
from optipath.values.arrays.shapes import broadcast_fault, check_broadcast
from optipath.values.curves.computed_check import check_computed, takes_0_alone
from optipath.values.curves.curve_sum import CurveSum
from optipath.values.curves.marked_names import marked_name
from optipath.values.curves.wavelength_range import WavelengthRange
from optipath.values.domains.domain import Domain
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter
from optipath.values.resolved import THERE, Resolved
from optipath.values.units import dimension_of, with_article
from optipath.values.wavelength import Wavelength, read_within

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from optipath.values.curves.curve import Curve


_THERE = Wavelength(default=1e-6, maximum=np.inf, bound=True)
"""What stands for a wavelength that is known."""


@dataclass(frozen=True, eq=False)
class CurveValue(Parameter):
    """A value that nobody gives: a part of a curve at a wavelength that is given.

    It stands where a `Parameter` does, by a name of its own, and is computed of what is given
    before anything else is done. Made by `curve_values`.
    """

    curve: Any = field(default=None, repr=False)
    place: int = 0
    given_by: tuple[Any, ...] = ()

    def __post_init__(self) -> None:
        """Take all as it is: nobody but this library makes one."""

    @property
    def arguments(self) -> tuple[Parameter, ...]:
        """The parameters that it is computed of."""
        return tuple([one for one in self.given_by if isinstance(one, Parameter)])

    def argument_places(self, owner: str) -> list[tuple[str, Any, Domain]]:
        """Return where the parameters stand that it is computed of, and what they may be."""
        domains = [
            (owner, WavelengthRange.of(self.curve)),
            *[(f"{owner}.{name}", domain) for name, _, domain in self.curve.arguments()],
        ]
        return [
            (place, value, domain)
            for value, (place, domain) in zip(self.given_by, domains, strict=True)
            if isinstance(value, Parameter)
        ]

    def follows(self, given: Mapping[str, Resolved]) -> bool:
        """Tell whether all is given that it is computed of, in one shape, and real."""
        names = [one.name for one in self.arguments if not one.bound or one.name in given]
        if any(name not in given or np.iscomplexobj(given[name].value) for name in names):
            return False
        return not broadcast_fault(self.shapes(given))

    def shapes(self, given: Mapping[str, Resolved]) -> dict[str, tuple[int, ...]]:
        """Return the shapes of what it is computed of, by name."""
        return {one.name: np.shape(_number(one, given)) for one in self.arguments}

    def computed(self, given: Mapping[str, Resolved]) -> Resolved:
        """Return its numbers, scale and offset aside."""
        return Resolved(self.parts(given)[self.place], THERE)

    def parts(self, given: Mapping[str, Resolved]) -> tuple[Any, ...]:
        """Return the numbers of all parts of its curve, of which its own are one."""
        found: tuple[Any, ...]
        found = self.curve.evaluated(*[_number(one, given) for one in self.given_by])
        return found

    def bound_to(self, values: Mapping[str, Parameter]) -> CurveValue:
        """Return what it is once parameters that it is computed of have values."""
        if not any(one.name in values for one in self.arguments):
            return self
        given_by = tuple(
            [
                values[one.name].like(one) if getattr(one, "name", None) in values else one
                for one in self.given_by
            ]
        )
        return _of(self.curve, self.place, given_by).like(self)

    def argument(self, place: int, given: Mapping[str, Resolved]) -> Any:
        """Return the numbers of one of those that it is computed of."""
        return _number(self.given_by[place], given)

    def check_place(self, owner: str, domain: Domain) -> None:
        super().check_place(owner, domain)
        nowhere = not self.offset and self.scale and self.curve.is_nowhere_0(self.place)
        if nowhere and takes_0_alone(domain):
            raise ValueFault(
                f"{self.formula_of(self.spoken)} is 0 at no wavelength, and {owner} takes "
                f"{domain.described()}"
            )

    @property
    def plain_numbers(self) -> Any:
        return self.default if self.curve.unit else self.curve.samples(self.place)

    @property
    def spoken(self) -> str:
        """What sentences call it: by its curve, and by its part where that has several."""
        parts, label = self.curve.parts, self.curve.label
        return label if parts == ("value",) else f"{parts[self.place]} of {label}"

    @property
    def called(self) -> str:
        return self.spoken

    def at(self, wavelength: Any) -> Any:
        """Return its numbers at wavelengths, scale and offset applied.

        Units: wavelength in metres.
        """
        others = self.given_by[1:]
        known = _defaults(others)
        for one in others:
            if isinstance(one, Parameter) and one.name not in known:
                raise ParameterError(
                    f"{self.spoken} follows from parameter '{one.name}' besides, which has no "
                    f"value; give the parameter a default"
                )
        where = read_within(self.curve.span, wavelength)
        WavelengthRange.of(self.curve).check("the wavelength", where)
        there = _of(self.curve, self.place, (changed(_THERE, default=where), *others))
        check_broadcast(there.shapes(known))
        found = there.computed(known).value
        check_computed(there.like(self), "", Domain("number"), found, known)
        found = self.placed(found)
        return found if is_traced(found) or found.ndim else found.item()

    def _shifted(self, other: Any, sign: float) -> Self:
        """Return a sum with a number, or with what follows from the same wavelength."""
        if not isinstance(other, CurveValue):
            return super()._shifted(other, sign)
        if self.given_by[0] != other.given_by[0]:
            raise ParameterError(
                f"{self.spoken} and {other.spoken} follow from two wavelengths, "
                f"'{self.given_by[0].name}' and '{other.given_by[0].name}'; give both the same one"
            )
        terms = [(one.scale * by, one.curve, one.place) for one, by in ((self, 1.0), (other, sign))]
        total = CurveSum(tuple(terms), self.offset + sign * other.offset)
        one, another = dimension_of(self.unit), dimension_of(other.unit)
        if one != another:
            raise ParameterError(
                f"{self.spoken} is {with_article(one or 'pure number')}, and {other.spoken} "
                f"{with_article(another or 'pure number')}; add up what is of one kind"
            )
        low, high = total.span
        if not low <= high:
            raise ParameterError(
                f"{self.spoken} and {other.spoken} are known at no common wavelength; take curves "
                f"whose ranges meet"
            )
        return cast("Self", _of(total, 0, (*self.given_by, *other.given_by[1:])))

    def same_specification(self, other: Parameter) -> bool:
        return isinstance(other, CurveValue) and self.name == other.name

    def __repr__(self) -> str:
        given = ", ".join([one.name for one in self.arguments])
        shape = (
            f"{self.scale:g} * " * (self.scale != 1.0),
            f" + {self.offset:g}" * bool(self.offset),
        )
        return f"<{shape[0]}{shown(self.spoken)[1:-1]}{shape[1]}, by {given}>"

    def __eq__(self, other: object) -> bool:
        return Parameter.__eq__(self, other)

    def __hash__(self) -> int:
        return hash(self.name)


def curve_values(curve: Curve, wavelength: Any) -> tuple[Any, ...]:
    """Return what stands for each part of a curve, at a wavelength that may be a parameter.

    Units: wavelength in metres.
    """
    given_by = (wavelength, *[value for _, value, _ in curve.arguments()])
    if not any(isinstance(one, Parameter) for one in given_by):
        return curve.evaluated(*given_by)
    return tuple([_of(curve, place, given_by) for place in range(len(curve.parts))])


def _of(curve: Curve, place: int, given_by: tuple[Any, ...]) -> CurveValue:
    parameters = [one for one in given_by if isinstance(one, Parameter)]
    bound = all(one.bound for one in parameters)
    made = CurveValue(
        marked_name(curve, place, given_by),
        None,
        unit=curve.unit,
        bound=bound,
        curve=curve,
        place=place,
        given_by=given_by,
    )
    known = _defaults(parameters)
    if not made.follows(known) or (curve.takes_grid and not bound):
        return made
    default = made.computed(known).value
    return changed(made, default=default if is_traced(default) or default.ndim else default.item())


def _defaults(values: Iterable[Any]) -> dict[str, Resolved]:
    parameters = [one for one in values if isinstance(one, Parameter)]
    return {p.name: p.resolve(p.default) for p in parameters if p.default is not None}


def _number(one: Any, given: Mapping[str, Resolved]) -> Any:
    operand = Operand(one)
    return operand.evaluated(NUMPY, operand.raw(given))
