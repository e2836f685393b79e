"""Agreement: values of a path that must fit to each other, once all of them are known."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError
from optipath.faults import Fault
from optipath.values.angles import CosSin
from optipath.values.arrays import broadcast_fault, joint_shape, place_text
from optipath.values.curve_value import CurveValue
from optipath.values.jax_values import is_traced, namespace
from optipath.values.operands import NOTHING, Operand
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Mapping

    from optipath.values.parameters import Resolved


_AT_ONCE = 8192
"""How many paths are looked at at once."""


@dataclass(frozen=True, eq=False)
class Agreement:
    """Numbers that must fit to each other."""

    shows_in_light = False  # Whether light is not finite where they do not fit.

    operands: tuple[Operand, ...]

    def fits(self, xp: Any, *numbers: Any) -> Any:
        """Return for which paths numbers fit, with the functions of NumPy or of JAX."""
        raise NotImplementedError

    def sentence(self, *numbers: float) -> str:
        """Say of numbers of one path that they do not fit, and the cure."""
        raise NotImplementedError

    @property
    def rests_on(self) -> tuple[str, ...]:
        """What must be right for a fault of it to say something."""
        return ()

    @property
    def spoils(self) -> tuple[str, ...]:
        """What is not right where it has a fault."""
        return ()

    @property
    def waits_for_complex(self) -> bool:
        """Whether there is nothing to look at before a complex number is given."""
        return False

    @property
    def is_open(self) -> bool:
        """Whether a number is only known when the path runs."""
        return any(not operand.known or operand.traced for operand in self.operands)

    def key(self) -> Hashable:
        """Return what equal agreements share; None where an operand has no such."""
        keys = tuple(operand.key() for operand in self.operands)
        others = (getattr(self, f.name) for f in fields(self)[1:] if f.compare)
        return None if None in keys else (type(self), keys, *others)

    def fault(self, arguments: Mapping[str, Resolved] = NOTHING) -> str:
        """Say what does not fit; nothing where all does, or cannot be compared."""
        try:
            numbers = [_number(operand, arguments) for operand in self.operands]
        except (OptipathError, ArithmeticError, TypeError, ValueError):
            return ""  # What is no number is a fault of its own.
        if any(map(is_traced, numbers)):
            return ""
        arrays = [np.asarray(number) for number in numbers]
        shapes = {str(place): array.shape for place, array in enumerate(arrays)}
        if any(array.dtype.kind not in "iuf" for array in arrays) or broadcast_fault(shapes):
            return ""
        if (result := self._first_misfit(arrays)) is None:
            return ""
        at, misfit = result
        fault = Fault.of(self.sentence(*misfit))
        shape = joint_shape(*(array.shape for array in arrays))
        if (count := math.prod(shape)) == 1:
            return fault
        which = f" ({place_text(shape, at).strip()}, of {count} paths)"
        return fault.but(reason=fault.reason + which)

    def _first_misfit(self, arrays: list[Any]) -> tuple[int, list[float]] | None:
        """Return the first path whose numbers do not fit, and these; None where all do."""
        # A grid is never laid out as a whole.
        cut: Any = np.nditer(
            arrays,
            ["external_loop", "buffered", "zerosize_ok"],
            order="C",
            op_dtypes=[np.float64] * len(arrays),
            casting="same_kind",
            buffersize=_AT_ONCE,
        )
        passed = 0
        with np.errstate(all="ignore"):
            for columns in cut:
                # Of one operand alone, NumPy gives no tuple.
                part = columns if isinstance(columns, tuple) else (columns,)
                bad = ~self.fits(np, *part)
                if np.any(bad):
                    at = int(np.argmax(bad))
                    return passed + at, [float(column[at]) for column in part]
                passed += len(bad)
        return None

    def inside(self, arguments: Mapping[str, Resolved]) -> Any:
        """Return for which paths numbers fit that JAX traces; True where it traces none."""
        numbers = [_number(operand, arguments) for operand in self.operands]
        traced = [number for number in numbers if is_traced(number)]
        return self.fits(namespace(traced[0]), *numbers) if traced else True


def first_faults(
    agreements: Iterable[Agreement], arguments: Mapping[str, Resolved] = NOTHING
) -> list[str]:
    """Say what does not fit, but for what may only follow from another of these faults."""
    results = [(law, fault) for law in agreements if (fault := law.fault(arguments))]
    spoilt = {what for law, _ in results for what in law.spoils}
    first = [fault for law, fault in results if spoilt.isdisjoint(law.rests_on)]
    # In a ring, each may follow from the one before.
    return first or [fault for _, fault in results[:1]]


def _number(operand: Operand, arguments: Mapping[str, Resolved]) -> Any:
    """Return what an operand comes to; an angle that is given by its cosine and sine, as one."""
    value: Any = operand.value
    if isinstance(value, Parameter) and not value.bound:
        angle: Any = arguments[value.name].value
        if type(angle) is CosSin:
            arguments = {value.name: arguments[value.name]._replace(value=angle.angle)}
    return operand.at(arguments)


def text_of(operand: Operand, number: float, unit: str = "") -> str:
    """Write a number, and whose value it is."""
    value: Any = operand.value
    number_text = f"{number:.{10 if unit else 12}g}{unit}"
    if not isinstance(value, Parameter):
        return number_text
    if isinstance(value, CurveValue):
        return f"{number_text} ({value.formula_of(value.spoken)})"
    if value.formula != value.name:
        return f"{value.formula} = {number_text}"
    return f"{number_text} (parameter '{value.name}')"


def is_single(xp: Any, numbers: Any) -> Any:
    """Tell of numbers whether they have been rounded to single precision."""
    numbers = xp.asarray(numbers)
    grains = numbers * 4096.0
    rounded = numbers.astype(np.float32)
    return (rounded == numbers) & (grains != xp.floor(grains))
