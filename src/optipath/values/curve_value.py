"""CurveValue: a number in a path that follows from the wavelength of a run."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Self, cast

import numpy as np

from optipath.errors import ParameterError, ValueFault
from optipath.faults import shown
from optipath.values.arrays import broadcast_fault, changed, check_broadcast, place_text
from optipath.values.curve import CurveSum, WavelengthRange, marked_name
from optipath.values.domains import Domain, in_unit_of
from optipath.values.jax_values import is_traced
from optipath.values.operands import Operand
from optipath.values.parameters import THERE, Parameter, Resolved
from optipath.values.units import dimension_of, displayed, with_article
from optipath.values.wavelength import WAVELENGTH, Wavelength, read_within

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from optipath.values.curve import Curve


_THERE = Wavelength(default=1e-6, maximum=np.inf, bound=True)
"""What stands for a wavelength that is known."""


@dataclass(frozen=True, eq=False)
class CurveValue(Parameter):
    """A value that nobody gives: a part of a curve at a wavelength that is given.

    It is used like a `Parameter`, and computed before anything else; made by `curve_values`.
    """

    curve: Any = field(default=None, repr=False)
    place: int = 0
    depends_on: tuple[Any, ...] = ()

    def __post_init__(self) -> None:
        """Take all as it is: nobody but this library makes one."""

    @property
    def arguments(self) -> tuple[Parameter, ...]:
        """The parameters that it is computed of."""
        return tuple([one for one in self.depends_on if isinstance(one, Parameter)])

    def argument_places(self, owner: str) -> list[tuple[str, Any, Domain]]:
        """Return where the parameters stand that it is computed of, and what they may be."""
        domains = [
            (owner, WavelengthRange.of(self.curve)),
            *[(f"{owner}.{name}", domain) for name, _, domain in self.curve.arguments()],
        ]
        return [
            (place, value, domain)
            for value, (place, domain) in zip(self.depends_on, domains, strict=True)
            if isinstance(value, Parameter)
        ]

    def follows(self, arguments: Mapping[str, Resolved]) -> bool:
        """Tell whether all is given that it is computed of, in one shape, and real."""
        names = [one.name for one in self.arguments if not one.bound or one.name in arguments]
        if any(name not in arguments or np.iscomplexobj(arguments[name].value) for name in names):
            return False
        return not broadcast_fault(self.shapes(arguments))

    def shapes(self, arguments: Mapping[str, Resolved]) -> dict[str, tuple[int, ...]]:
        """Return the shapes of what it is computed of, by name."""
        return {one.name: np.shape(Operand(one).at(arguments)) for one in self.arguments}

    def computed(self, arguments: Mapping[str, Resolved]) -> Resolved:
        """Return its numbers, scale and offset aside."""
        return Resolved(self.parts(arguments)[self.place], THERE)

    def parts(self, arguments: Mapping[str, Resolved]) -> tuple[Any, ...]:
        """Return the numbers of all parts of its curve, of which its own are one."""
        results: tuple[Any, ...]
        results = self.curve.evaluated(*[Operand(one).at(arguments) for one in self.depends_on])
        return results

    def bound_to(self, values: Mapping[str, Parameter]) -> CurveValue:
        """Return what it is once parameters that it is computed of have values."""
        if not any(one.name in values for one in self.arguments):
            return self
        named = [(one, getattr(one, "name", "")) for one in self.depends_on]
        others = [values[name].like(one) if name in values else one for one, name in named]
        return _of(self.curve, self.place, tuple(others)).like(self)

    @property
    def is_nowhere_0(self) -> bool:
        """Whether it is known to be above 0, or below, at all wavelengths."""
        return not self.offset and self.scale != 0.0 and self.curve.is_nowhere_0(self.place)

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
        """Return its numbers at wavelengths in metres, scale and offset applied."""
        others = self.depends_on[1:]
        known = _defaults(others)
        for one in others:
            if isinstance(one, Parameter) and one.name not in known:
                besides = f"{self.spoken} follows from parameter '{one.name}' besides"
                raise ParameterError(f"{besides}, which has no value; give it a default")
        where = read_within(self.curve.span, wavelength)
        WavelengthRange.of(self.curve).check("the wavelength", where)
        there = _of(self.curve, self.place, (changed(_THERE, default=where), *others))
        check_broadcast(there.shapes(known))
        result = there.computed(known).value
        check_computed(there.like(self), "", Domain("number"), result, known)
        result = self.placed(result)
        return result if is_traced(result) or result.ndim else result.item()

    def _shifted(self, other: Any, sign: float) -> Self:
        """Return a sum with a number, or with what follows from the same wavelength."""
        if not isinstance(other, CurveValue):
            return super()._shifted(other, sign)
        both = f"{self.spoken} and {other.spoken}"
        if self.depends_on[0] != other.depends_on[0]:
            names = f"'{self.depends_on[0].name}' and '{other.depends_on[0].name}'"
            raise ParameterError(f"{both} follow from two wavelengths, {names}; give the same one")
        terms = [(one.scale * by, one.curve, one.place) for one, by in ((self, 1.0), (other, sign))]
        total = CurveSum(tuple(terms), self.offset + sign * other.offset)
        one, another = dimension_of(self.unit), dimension_of(other.unit)
        if one != another:
            kinds = " and ".join(with_article(each or "pure number") for each in (one, another))
            raise ParameterError(f"{both} are {kinds}; add up what is of one kind")
        low, high = total.span
        if not low <= high:
            raise ParameterError(f"{both} are known at no common wavelength; take other curves")
        return cast("Self", _of(total, 0, (*self.depends_on, *other.depends_on[1:])))

    def same_specification(self, other: Parameter) -> bool:
        return isinstance(other, CurveValue) and self.name == other.name

    def __repr__(self) -> str:
        argument = ", ".join([one.name for one in self.arguments])
        scale = f"{self.scale:g} * " * (self.scale != 1.0)
        offset = f" + {self.offset:g}" * bool(self.offset)
        return f"<{scale}{shown(self.spoken)[1:-1]}{offset}, by {argument}>"

    def __eq__(self, other: object) -> bool:
        return Parameter.__eq__(self, other)

    def __hash__(self) -> int:
        return hash(self.name)


def curve_values(curve: Curve, wavelength: Any) -> tuple[Any, ...]:
    """Return values for each part of a curve, at a wavelength in metres or a parameter."""
    depends_on = (wavelength, *[value for _, value, _ in curve.arguments()])
    if not any(isinstance(one, Parameter) for one in depends_on):
        return curve.evaluated(*depends_on)
    return tuple([_of(curve, place, depends_on) for place in range(len(curve.parts))])


def _of(curve: Curve, place: int, depends_on: tuple[Any, ...]) -> CurveValue:
    parameters = [one for one in depends_on if isinstance(one, Parameter)]
    bound = all(one.bound for one in parameters)
    of: dict[str, Any] = {"curve": curve, "place": place, "depends_on": depends_on}
    made = CurveValue(marked_name(**of), None, unit=curve.unit, bound=bound, **of)
    known = _defaults(parameters)
    if not made.follows(known) or (curve.takes_grid and not bound):
        return made
    default = made.computed(known).value
    return changed(made, default=default if is_traced(default) or default.ndim else default.item())


def _defaults(values: Iterable[Any]) -> dict[str, Resolved]:
    parameters = [one for one in values if isinstance(one, Parameter)]
    return {p.name: p.resolve(p.default) for p in parameters if p.default is not None}


def check_computed(
    value: Any,
    owner: str,
    domain: Domain,
    numbers: Any,
    arguments: Mapping[str, Resolved] | None = None,
) -> None:
    """Check what a curve comes to where it stands."""
    if value.curve.is_checked:
        return
    placed = value.placed(numbers)
    try:
        domain.check(owner, placed)
    except ValueFault as fault:
        if is_traced(placed) or domain.tail:
            raise
        bad = ~np.asarray(domain.allows(np.asarray(placed)))
        if not np.any(bad):
            raise
        known = {**_defaults(value.arguments), **(arguments or {})}
        ValueFault.raise_for(value.curve.misfits(value.depends_on[1:], known))
        what, cure = _no_result(value, placed, bad, known)
        wanted = f", and {owner} takes {domain.described()}" if owner else ""
        if not takes_0_alone(domain):
            wanted += f"; {cure}"
        raise ValueFault(f"{what}{wanted}") from fault


def takes_0_alone(domain: Domain) -> bool:
    """Tell whether a domain says itself what to do about any other number."""
    return domain.interval == (0.0, 0.0)


def _no_result(
    value: Any, numbers: Any, bad: Any, known: Mapping[str, Resolved]
) -> tuple[str, str]:
    """Say where a curve comes to what is not allowed, and what else to give."""
    wavelength, *others = [_number_at(one, bad, known) for one in value.depends_on]
    at = "" if wavelength is None else f" at {displayed(wavelength, WAVELENGTH.unit)}"
    result = float(np.asarray(numbers)[bad].ravel()[0])
    is_what = f"is {result:.6g}" if np.isfinite(result) else "has no value"
    coefficients = [
        f"{one.formula} is {number:.6g}"
        for one, number in zip(value.depends_on[1:], others, strict=True)
        if isinstance(one, Parameter) and number is not None
    ]
    cure, place = "give another wavelength", ""
    if coefficients:
        cure = f"give other coefficients ({', '.join(coefficients)}), or another wavelength"
        which = place_text(bad.shape, int(np.argmax(bad))).strip()
        place = f" ({which}, of {bad.size} paths)" if bad.size > 1 else ""
    reason = value.curve.unreal_of(value.place)
    why = f" ({reason})" if reason else ""
    return f"{value.formula_of(value.spoken)}{at} {is_what}{place}{why}", cure


def _number_at(one: Any, bad: Any, known: Mapping[str, Resolved]) -> float | None:
    """Return the first number of one argument that a fault is of; None where it is not known."""
    if isinstance(one, Parameter) and one.name not in known:
        return None
    number = Operand(one).at(known)
    return None if is_traced(number) else float(np.broadcast_to(number, bad.shape)[bad].flat[0])


def computed_values(
    values: Iterable[CurveValue], arguments: Mapping[str, Resolved]
) -> dict[str, Resolved]:
    """Return the numbers of those values of which all is given; each curve is evaluated once."""
    results: dict[str, Resolved] = {}
    parts: dict[Any, tuple[Any, ...]] = {}
    for value in values:
        if value.follows(arguments):
            same = id(value.curve), *map(id, value.depends_on)
            if same not in parts:
                parts[same] = value.parts(arguments)
            results[value.name] = Resolved(parts[same][value.place], THERE)
    return results


def parameters_among(values: Iterable[Any]) -> list[Parameter]:
    """Return the parameters among some values, and behind each those that it follows from."""
    results: list[Parameter] = []
    for value in values:
        if isinstance(value, Parameter):
            results.append(value)
        if isinstance(value, CurveValue):
            results += value.arguments
    return results


def curve_at(curve: Curve, wavelength: Any = None) -> tuple[Any, ...]:
    """Return what stands for each part of a curve.

    >>> from optipath.materials.tables import Tabulated
    >>> table = Tabulated("gold", ("n",), ["500 nm", "600 nm"], [[0.9, 0.3]])
    >>> curve_at(table, "500 nm"), curve_at(table)
    ((0.9,), (<n of gold, by wavelength>,))
    """
    if wavelength is None or isinstance(wavelength, Parameter):
        return curve_values(curve, in_unit_of(wavelength or Wavelength(), WAVELENGTH))
    there = read_within(curve.span, wavelength)
    WavelengthRange.of(curve).check("the wavelength", there)
    values = curve_values(curve, there)
    if isinstance(values[0], CurveValue):
        return values  # Its coefficients are given later.
    return tuple([one.at(there) for one in curve_values(curve, Wavelength())])
