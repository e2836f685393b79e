"""SnellsLaw: n sin(incidence) is the same at parallel boundaries."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.one_plane import TURNED, turn_text
from optipath.kernels.fresnel.inhomogeneous import phase_index
from optipath.kernels.numbers.primitives import of_module
from optipath.values.agreement import Agreement, is_single, text_of
from optipath.values.cures import cure
from optipath.values.digits import digits_until
from optipath.values.follows import FOLLOWS

if TYPE_CHECKING:
    from collections.abc import Collection

_ROUNDING, _SINGLE_ROUNDING = 3e-8, 2.0**-22
"""How far apart two angles may be, in radians."""

_LAST_DIGITS, _LAST_SINGLE_DIGITS = 2.0**-50, 2.0**-22
"""How far apart two values of sin(incidence) may be, where the sine hardly changes."""


@dataclass(frozen=True, eq=False)
class SnellsLaw(Agreement):
    """An incidence at one boundary, and the medium where it is measured; the same at another.

    The operands are angle, n and k of both, and the turns between the two planes of incidence:
    boundaries whose planes differ are not parallel.
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
        angle1, n1, k1, angle2, n2, k2, *turns = numbers
        n1, n2 = _index(xp, angle1, n1, k1), _index(xp, angle2, n2, k2)
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

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        angle1, n1, k1, angle2, n2, k2, *turns = numbers
        (name, _, _), (own, _, _) = self.leaves.rpartition("."), self.enters.rpartition(".")
        pairs = ((angle1, n1, k1), (angle2, n2, k2))
        here, there = (float(_index(np, a, n, k)) * math.sin(a) for a, n, k in pairs)
        cures = [cure("op.FOLLOWS", FOLLOWS.in_file)]
        if not {0, 1, 2, 4, 5}.intersection(varying) and not (k1 or k2):
            cures = [*self._angles(angle1, n1, n2), *cures]
        digits = digits_until(lambda d: f"{here:.{d}g}" != f"{there:.{d}g}")
        sines = f"{here:.{digits}g} at '{name}' and {there:.{digits}g} at '{own}'"
        given = text_of(self.operands[3], math.degrees(angle2), " deg")
        given += f" in n = {text_of(self.operands[4], n2)}"
        if k2:
            given += f" and k = {text_of(self.operands[5], k2)}"
        if turns:
            turned = turn_text(self.operands[6:], turns)
            given += f"; their planes of incidence are one where azimuths come to {turned}"
        if self.follows:
            return (
                f"light of '{self.leaves}' enters '{self.enters}', but '{own}' has taken its "
                f"incidence over (FOLLOWS) from other light: n sin(incidence) is {sines} "
                f"({given}); light of several directions merges there: give each light a face of "
                f"its own"
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
            f"light of '{self.leaves}' enters '{self.enters}', but n sin(incidence) is {sines} "
            f"({given}); give '{own}' an incidence of {', or '.join(cures)} ({why})"
        )

    def _angles(self, angle: float, n: float, own_n: float) -> list[str]:
        """Return what the second may say of its angle, with as many digits as it takes to pass."""
        found = []
        there = math.degrees(angle)
        if (sine := n * math.sin(angle) / own_n) <= 1.0:
            exact = math.degrees(math.asin(sine))
            digits = digits_until(
                lambda d: self.fits(
                    np, angle, n, 0.0, math.radians(float(f"{exact:.{d}g}")), own_n, 0.0
                )
            )
            found.append(f"{exact:.{digits}g} deg in n = {own_n:.12g}")
        if n != own_n:
            elsewhere = replace(self, ends=(self.ends[0], False))
            digits = digits_until(
                lambda d: elsewhere.fits(
                    np,
                    angle,
                    n,
                    0.0,
                    math.radians(float(f"{there:.{d}g}")),
                    float(f"{n:.{d + 2}g}"),
                    0.0,
                )
            )
            found.append(f"{there:.{digits}g} deg with incidence_in = {n:.{digits + 2}g}")
        return found


def _index(xp: Any, angle: Any, n: Any, k: Any) -> Any:
    """Return the index by which Snell's law holds for a real angle in a medium."""
    with np.errstate(all="ignore"):
        (index,) = phase_index(of_module(xp))(n, k, xp.cos(angle), xp.sin(angle))
    return xp.where(k > 0.0, index, n)
