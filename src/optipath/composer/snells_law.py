"""SnellsLaw: n sin(incidence) is the same at parallel boundaries."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from optipath.composer.one_plane import TURNED, turn_text
from optipath.values.agreement import Agreement, is_single, text_of
from optipath.values.cures import cure
from optipath.values.follows import FOLLOWS

_ROUNDING, _SINGLE_ROUNDING = 3e-8, 2.0**-22
"""How far apart two angles may be, in radians."""

_LAST_DIGITS, _LAST_SINGLE_DIGITS = 2.0**-50, 2.0**-22
"""How far apart two values of sin(incidence) may be, where the sine hardly changes."""


@dataclass(frozen=True, eq=False)
class SnellsLaw(Agreement):
    """An incidence at one boundary, and the medium where it is measured; the same at another.

    The operands are both pairs, and the turns between the two planes of incidence: boundaries
    whose planes differ are not parallel.

    Attributes
    ----------
    leaves, enters : str
        The ports between which light passes, as ``"node.port"``.
    ends : tuple of bool
        Whether the light between ends at each where its incidence is a right angle: at the
        first, since it lets none through, and at the second, which none reaches then.
    may_be_told : bool
        Whether the second could say ``parallel=False``.
    follows : bool
        Whether the second has taken its incidence over from other light.
    """

    leaves: str
    enters: str
    ends: tuple[bool, bool] = (False, False)
    may_be_told: bool = True
    follows: bool = False

    @property
    def rests_on(self) -> tuple[str, ...]:
        """The incidence at the first, and the medium at the second."""
        return self.leaves.rpartition(".")[0], self.enters

    @property
    def spoils(self) -> tuple[str, ...]:
        """The incidence at the second."""
        return (self.enters.rpartition(".")[0],)

    def fits(self, xp: Any, *numbers: Any) -> Any:
        angle1, n1, angle2, n2, *turns = numbers
        single = is_single(xp, angle1) | is_single(xp, angle2)
        rounding = xp.where(single, _SINGLE_ROUNDING, _ROUNDING)
        single = single | is_single(xp, n1) | is_single(xp, n2)
        last = xp.where(single, _LAST_SINGLE_DIGITS, _LAST_DIGITS)
        normal = xp.minimum(abs(n1 * xp.cos(angle1)), abs(n2 * xp.cos(angle2)))
        here, there = n1 * xp.sin(angle1), n2 * xp.sin(angle2)
        apart = abs(here - there)
        differs = apart > rounding * normal + last * xp.maximum(n1, n2)
        if turns:
            differs = differs & ~(abs(xp.sin(sum(turns))) > TURNED)
        # Where all is reflected, the angle behind is a right one, and no light gets there.
        first, second = self.ends
        if first:
            differs = differs & ~((abs(xp.cos(angle1)) <= rounding) & (here < there))
        if second:
            differs = differs & ~((abs(xp.cos(angle2)) <= rounding) & (there < here))
        return ~differs

    def sentence(self, *numbers: float) -> str:
        angle1, n1, angle2, n2, *turns = numbers
        (name, _, _), (own, _, _) = self.leaves.rpartition("."), self.enters.rpartition(".")
        here, there = n1 * math.sin(angle1), n2 * math.sin(angle2)
        cures = [cure("op.FOLLOWS", FOLLOWS.in_file)]
        if n1 != n2:
            cures.insert(0, f"{math.degrees(angle1):.10g} deg with incidence_in = {n1:.12g}")
        if here <= n2:
            exact = f"{math.degrees(math.asin(here / n2)):.10g} deg"
            cures.insert(0, f"{exact} in n = {n2:.12g}")
        given = text_of(self.operands[2], math.degrees(angle2), " deg")
        given += f" in n = {text_of(self.operands[3], n2)}"
        if turns:
            turned = turn_text(self.operands[4:], turns)
            given += f"; their planes of incidence are one where azimuths come to {turned}"
        if self.follows:
            return (
                f"light of '{self.leaves}' enters '{self.enters}', but '{own}' has taken its "
                f"incidence over (FOLLOWS) from other light: n sin(incidence) is {here:.10g} at "
                f"'{name}' and {there:.10g} at '{own}' ({given}); light of several directions "
                f"merges there: give each light a face of its own"
            )
        if self.may_be_told:
            why = (
                f"faces are taken as parallel behind one that refracts; if '{own}' stands at an "
                f"angle to '{name}', as those of a prism do, say "
                f"{cure('parallel=False', 'parallel = false')}"
            )
        else:
            why = "light goes to and fro between them, so they are parallel"
        return (
            f"light of '{self.leaves}' enters '{self.enters}', but n sin(incidence) is {here:.10g} "
            f"at '{name}' and {there:.10g} at '{own}' ({given}); give '{own}' an incidence of "
            f"{', or '.join(cures)} ({why})"
        )
