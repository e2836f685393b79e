"""SameMedium: light that leaves one boundary and enters another is in one medium."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.values.agreement import Agreement, is_single, text_of
from optipath.values.cures import cure
from optipath.values.curves.curve_value import CurveValue
from optipath.values.follows import FOLLOWS
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Collection

_ROUNDING, _SINGLE_ROUNDING = 1e-9, 2.0**-23
"""How far apart two indices may be, as a share of them."""


@dataclass(frozen=True, eq=False)
class SameMedium(Agreement):
    """The indices of refraction of two boundaries that face each other are the same.

    The operands are n on both sides, and k on both where either may absorb; or k of the first
    alone, where light must come to the second from a medium that does not absorb.
    """

    leaves: str
    enters: str
    field: str
    measures: bool = False
    follows: bool = False

    @property
    def spoils(self) -> tuple[str, ...]:
        """The incidence that is measured in a medium that is wrong says nothing."""
        return (self.enters, self.enters.rpartition(".")[0]) if self.measures else ()

    def fits(self, xp: Any, *numbers: Any) -> Any:
        n1, n2, *k = numbers
        single = is_single(xp, n1) | is_single(xp, n2)
        rounding = xp.where(single, _SINGLE_ROUNDING, _ROUNDING)
        differs = abs(n1 - n2) > rounding * xp.maximum(n1, n2)
        if len(k) == 1:
            return ~(differs | (k[0] != 0.0))
        if k:
            differs = differs | (abs(k[0] - k[1]) > rounding * xp.maximum(k[0], k[1]))
        return ~differs

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        before, behind, *k = (text_of(o, n) for o, n in zip(self.operands, numbers, strict=True))
        name, _, port = self.leaves.rpartition(".")
        side = "behind" if port == "transmitted" else "in front of"
        if len(k) == 1 and numbers[2]:
            return (
                f"'{self.enters}' is lit from a medium that absorbs, with k = {k[0]} {side} "
                f"'{name}' (by '{self.leaves}'); give '{name}' an index without k there, and link "
                f"a Medium between, which absorbs on the way"
            )
        before = _called(before)
        if any(numbers[2:]):
            before, behind = f"{before} and k = {k[0]}", f"{behind} with k = {k[1]}"
        is_lit = f"'{self.enters}' is lit from {before} {side} '{name}' (by '{self.leaves}')"
        if self.follows:
            return (
                f"{is_lit}, but has taken its {self.field} over (FOLLOWS) from other light, in "
                f"{_called(behind)}; light of several media merges there: give each light a face "
                f"of its own"
            )
        fixed = self._is_one_parameter or isinstance(self.operands[1].value, CurveValue)
        cures = [] if fixed or 0 in varying else [self._cure(*numbers[0::2])]
        if not self.enters.endswith(".back"):
            cures.append(f"{cure('op.FOLLOWS', FOLLOWS.in_file)} for {self.field}")
        elif not cures:
            cures.append(f"the same for {self.field} as there")
        return f"{is_lit}, but its {self.field} is {behind}; give {', or '.join(cures)}"

    @property
    def _is_one_parameter(self) -> bool:
        """Whether both are multiples of one parameter, so that no value of it is the cure."""
        values = [operand.value for operand in self.operands[:2]]
        both = all(isinstance(value, Parameter) for value in values)
        return both and len({value.name for value in values}) == 1

    def _cure(self, n: float, k: float = 0.0) -> str:
        value: Any = self.operands[1].value
        given = value.formula if isinstance(value, Parameter) else self.field
        if not k:
            return f"{given} = {n:.12g}"
        return cure(f"{given} = {n:.12g}{k:+.12g}j", f"{given} = {{ n = {n:.12g}, k = {k:.12g} }}")


def _called(number: str) -> str:
    """Return how an index is called; a multiple of a parameter says it."""
    return number if "=" in number else f"n = {number}"
