"""Inputs: what may be given to a plan, and the check of what is given."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce
from operator import and_
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ParameterError, ValueFault
from optipath.faults import Fault, no_value
from optipath.materials.named_materials import of_complex, passed_too_late
from optipath.values.agreement import first_faults
from optipath.values.angles import TURN, warn_of_degrees
from optipath.values.arrays import array_of, broadcast_fault, joint_shape
from optipath.values.curve import WavelengthRange
from optipath.values.curve_value import computed_values
from optipath.values.jax_values import is_traced
from optipath.values.operands import Ranges
from optipath.values.parameters import THERE, Resolved, is_material, unknown_parameter
from optipath.values.use import axes_for

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.values.agreement import Agreement
    from optipath.values.curve_value import CurveValue
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use


@dataclass(frozen=True, eq=False)
class Inputs:
    """The open parameters of a path, where they are used, and the shapes already known."""

    open: Mapping[str, Parameter]
    bound: Mapping[str, Parameter]
    uses: tuple[Use, ...]
    shapes: Mapping[str, tuple[int, ...]]
    known: tuple[Use, ...] = ()
    choices: tuple[str, ...] = ()
    agreements: tuple[Agreement, ...] = ()
    masks: bool = False
    for_complex: tuple[Agreement, ...] = ()
    computed: tuple[CurveValue, ...] = ()
    per_nanometre: tuple[str, ...] = ()

    def resolve(
        self, arguments: Mapping[str, Any], plain: Callable[[str, Any], bool] | None = None
    ) -> tuple[dict[str, Resolved], tuple[int, ...]]:
        """Return the numbers of every open parameter, and the shape of the batch."""
        faults: list[str] = [
            Fault(self.unknown(name), subject=name) for name in arguments if name not in self.open
        ]
        resolved: dict[str, Resolved] = {}
        unchecked = set()
        for name, parameter in self.open.items():
            value = arguments.get(name, parameter.default)
            if value is None:
                faults.append(no_value(name))
            elif plain is not None and plain(name, value):
                resolved[name] = Resolved(value, THERE)
                unchecked.add(name)
            else:
                try:
                    self.refuse_materials(name, value)
                    value = axes_for(name, value, self.uses)
                    resolved[name] = self.numbers_for(name, value)
                except OptipathError as fault:
                    faults += of_complex(fault.faults, self.uses, name, value)
        resolved |= self._computed_of(resolved, faults) if self.computed else {}
        results: dict[str, tuple[int, ...]] = {}
        refused: set[str] = set()
        for use in self.distinct_uses:
            name = use.value.name
            # What is wrong in one place is mostly wrong in others, for the same reason; but each
            # curve has a range of its own.
            again = refused and use.rests_on(refused) and type(use.domain) is not WavelengthRange
            if name not in resolved or again:
                continue
            numbers, present = resolved[name]
            try:
                if name not in unchecked:
                    use.check_arguments(numbers, present, resolved)
            except OptipathError as fault:
                value = arguments.get(name, use.value.default)
                message = of_complex(fault.faults, self.uses, name, value)
                # n and k of a material may have one fault.
                faults += [sentence for sentence in message if sentence not in faults]
                refused.add(name)
            else:
                shape = getattr(numbers, "shape", ())
                results[name] = shape[: len(shape) - len(use.domain.tail)]
        # As they are given, so that a sentence names them in the order of whoever reads it; what
        # is computed of them has their shapes.
        shapes = {name: results[name] for name in (*arguments, *self.open) if name in results}
        shapes = {**self.shapes, **shapes}
        faults += broadcast_fault(shapes)
        laws = self._agreements_of(resolved, seen=plain is None)
        faults = faults or first_faults(laws, resolved)
        if faults and unchecked:
            return self.resolve(arguments)  # Tells of ranges, too.
        if faults:
            raise ParameterError(*faults)
        return resolved, joint_shape(*shapes.values())

    def _computed_of(
        self, resolved: Mapping[str, Resolved], faults: list[str]
    ) -> dict[str, Resolved]:
        """Return what follows from numbers that are given, and collect what is wrong with them."""
        with ValueFault.collecting(faults):
            return computed_values(self.computed, resolved)
        return {}

    def numbers_for(self, name: str, value: Any) -> Resolved:
        """Return the numbers that are given for an open parameter."""
        parameter, limits = self.open[name], self.limits[name]
        if name not in self._taken or is_traced(value):
            return parameter.resolve(value, limits)
        numbers = array_of(f"parameter '{name}'", value, ParameterError)
        there = np.isfinite(numbers) if numbers.dtype.kind == "f" else True
        if np.all(there):
            return parameter.resolve(value, limits)
        parameter.resolve(np.where(there, numbers, 0.0), limits)
        return Resolved(numbers, THERE)

    @cached_property
    def _taken(self) -> frozenset[str]:
        return frozenset(use.value.name for use in self.uses if use.domain.takes_any)

    def unsound(self, light: Any) -> Any:
        """Return which numbers of light nobody may get; NaN may say that it cannot be."""
        return np.isinf(light) if self.masks else ~np.isfinite(light)

    @cached_property
    def hidden(self) -> tuple[Agreement, ...]:
        """What must fit together, but where light itself shows that it does not."""
        return tuple([law for law in self.agreements if not law.shows_in_light])

    @cached_property
    def distinct_uses(self) -> tuple[Use, ...]:
        """The uses that ask different things of a parameter."""
        results: dict[Any, Use] = {}
        for use in self.uses:
            results.setdefault((use.value, use.domain), use)
        return tuple(results.values())

    def inside(self, resolved: Mapping[str, Resolved]) -> Any:
        """Return for which paths all values that JAX traces are allowed; True where it has none."""
        requests: tuple[Use | Agreement, ...] = (
            *self.uses,
            *self.known,
            *self._agreements_of(resolved),
        )
        return reduce(and_, (each.inside(resolved) for each in requests), True)  # noqa: FBT003

    def _agreements_of(
        self, resolved: Mapping[str, Resolved], *, seen: bool = True
    ) -> tuple[Agreement, ...]:
        """Return what must fit together of these values, and what light itself shows if seen."""
        laws = self.agreements if seen else self.hidden
        if not self.for_complex or not any(map(_is_complex, resolved.values())):
            return laws
        return *laws, *self.for_complex

    @cached_property
    def limits(self) -> Ranges:
        """The range of each open parameter; of a multiple with an offset by `InputKey.quantity`."""
        known = (*self.open.values(), *self.computed)
        result = Ranges({p.name: (p.minimum, p.maximum) for p in known})
        for use in self.uses:
            name = use.value.name
            low, high = use.value.span_for(use.domain.interval)
            result[name] = max(result[name][0], low), min(result[name][1], high)
        for use in self.uses:
            if not use.value.is_signed:
                value, (low, high) = use.value, use.domain.interval
                least, most = value.span_of(result[value.name])
                low, high = max(least, low), min(most, high)
                # A turn back is by the negative.
                result.update({value.quantity: (low, high), (-value).quantity: (-high, -low)})
        return result

    @cached_property
    def turning(self) -> dict[str, Parameter]:
        """The open parameters that may make angles beyond a whole turn."""
        results: dict[str, Parameter] = {}
        for use in self.uses:
            low, high = self.limits[use.value.name]
            if use.domain.dimension == "angle" and max(-low, high) > TURN:
                results.setdefault(use.value.name, use.value)
        return results

    def warn_of_angles(self, arguments: Mapping[str, Any], what: str = "parameter") -> None:
        """Warn of plain numbers that make angles beyond a whole turn."""
        for name, place in self.turning.items():
            if name in arguments:
                warn_of_degrees(f"{what} '{name}'", arguments[name], place.placed)

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
        batches = [joint_shape(*each.shapes.values()) for each in (self, other)]
        return dict(self.open) == dict(other.open) and batches[0] == batches[1]

    __hash__ = None  # type: ignore[assignment]

    def refuse_materials(self, name: str, value: Any) -> None:
        """Raise where a material is given that is not known yet, or for what is no index."""
        if late := passed_too_late(name, value):
            raise ParameterError(late)
        if is_material(value):
            for use in self.uses:
                if use.value.name == name:
                    use.refuse_material(value)

    def unknown(self, name: str) -> str:
        """Return the sentence for a name that is no open parameter's."""
        if name in self.bound:
            value = self.bound[name]
            return (
                f"parameter '{name}' is bound to {value.text(value.default)}; to vary it, leave "
                f"it out of load_preset(...) or path.bind(...), where a case or a default "
                f"leaves it open"
            )
        if name in self.choices:
            return (
                f"'{name}' is chosen before a path runs, not while it does; write "
                f"path.bind({name}=...) or load_preset(..., {name}=...)"
            )
        return unknown_parameter(name, self.open)


def _is_complex(argument: Resolved) -> bool:
    kind = getattr(argument.value, "dtype", None)
    return isinstance(argument.value, complex) if kind is None else kind.kind == "c"
