"""Linear systems of light that adds up in loops, solved without a difference.

Written for (I - M) x = b, where M says what of each unknown comes back as which. What stays of an
intensity is 1 less what goes elsewhere, taken as the sum of all that (Grassmann, Taksar & Heyman,
Operations Research 33, 1985): it keeps its digits, and energy is conserved.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from optipath.kernels.primitives import Primitives


_LITTLE = 2.0**-26
"""A difference of 1 and a gain that has lost half of its digits."""

_LARGE = 2.0
"""The size of a sum from which on a difference of 1 and a gain has more digits."""

_LEAST = 2.0**-53
"""What a pivot is at least that may be 0 by chance."""


class Elimination:
    """A system of unknowns, eliminated one after the other, and what its solutions are."""

    def __init__(
        self,
        xp: Primitives,
        back: Sequence[dict[int, Any]],
        leaves: Sequence[Any],
        intensities: Sequence[bool],
        fading: Any = None,
        sizes: Sequence[Any] | None = None,
    ) -> None:
        self._xp = xp
        self._fading = fading
        self._quotient = _quotient(xp)
        self._difference = _difference(xp)
        self._back = [{to: g for to, g in column.items() if not is_zero(g)} for column in back]
        self._leaves = list(leaves)
        self._sizes = None if sizes is None else list(sizes)
        self._intensities = intensities
        self._feeds: list[set[int]] = [set() for _ in back]
        for unknown, column in enumerate(self._back):
            for to in column:
                self._feeds[to].add(unknown)
        self.pivots = [self._without(unknown) for unknown in range(len(back))]

    def solved(self, arriving: Sequence[Any]) -> list[Any]:
        """Return all unknowns for what arrives from outside, as numbers or plain zeros."""
        results = list(arriving)
        for unknown, pivot in enumerate(self.pivots):
            if not is_zero(results[unknown]):
                results[unknown] = self._quotient(results[unknown], pivot, of_light=True)
                for to, gain in self._later(unknown):
                    results[to] = results[to] + gain * results[unknown]
        for unknown in reversed(range(len(results))):
            pivot = self.pivots[unknown]
            terms = [
                self._quotient(self._back[source][unknown], pivot) * results[source]
                for source in self._feeds[unknown]
                if source > unknown and not is_zero(results[source])
            ]
            results[unknown] = reduce(_add, terms, results[unknown])
        return results

    def _later(self, unknown: int) -> Iterable[tuple[int, Any]]:
        return [(to, gain) for to, gain in self._back[unknown].items() if to > unknown]

    def _without(self, unknown: int) -> Any:
        """Send what passes an unknown on to where it goes; return what does not come back."""
        onwards = self._later(unknown)
        if self._intensities[unknown]:
            others = [gain for to, gain in onwards if self._intensities[to]]
            pivot = reduce(_add, others, self._leaves[unknown])
            if self._sizes is not None:
                size = reduce(_add, map(abs, others), self._sizes[unknown])
                stays = 1.0 - self._back[unknown].get(unknown, 0.0)
                pivot = self._xp.where(size < _LARGE, pivot, stays)
            if self._fading is not None:
                pivot, more = self._moved(pivot)
                self._leaves[unknown] = self._leaves[unknown] + more
        else:
            pivot = 1.0
            if unknown in self._back[unknown]:
                pivot = self._difference(1.0 - self._back[unknown][unknown])
            if self._fading is not None:
                pivot, _ = self._moved(pivot)
        for source in sorted(self._feeds[unknown]):
            if source > unknown:
                column = self._back[source]
                share = self._quotient(column[unknown], pivot)
                for to, gain in onwards:
                    column[to] = column[to] + share * gain if to in column else share * gain
                    self._feeds[to].add(source)
                self._leaves[source] = self._leaves[source] + share * self._leaves[unknown]
                if self._sizes is not None:
                    more = abs(share) * self._sizes[unknown]
                    self._sizes[source] = self._sizes[source] + more
        return pivot

    def _moved(self, pivot: Any) -> tuple[Any, Any]:
        """Return a pivot that is not 0 by chance, and by how much it has been moved."""
        there = self._fading | (self._xp.absolute(pivot) > _LEAST)
        moved = self._xp.where(there, pivot, _LEAST)
        return moved, moved - pivot


def _quotient(xp: Primitives) -> Callable[..., Any]:
    def dark(number: Any) -> Any:
        # Next to an edge, less may get through than any slope there lets through.
        return xp.absolute(number) < xp.within**5 if xp.within else number == 0.0

    def quotient(number: Any, pivot: Any, *, of_light: bool = False) -> Any:
        if isinstance(pivot, (float, np.floating)) and pivot != 0.0:
            return number / pivot
        # What would keep all light that gets there is no matter as long as none does.
        closed = pivot == 0.0
        return number / xp.where(closed & dark(number) if of_light else closed, 1.0, pivot)

    return quotient


def _difference(xp: Primitives) -> Callable[[Any], Any]:
    if not xp.within:
        return lambda difference: difference
    # What has all but cancelled next to an edge says nothing of slopes; none come of dividing by 0.
    return lambda left: xp.where(xp.absolute(left) > _LITTLE, left, 0.0)


def is_zero(number: Any) -> bool:
    """Tell whether a number is known to be 0."""
    return isinstance(number, (float, np.floating)) and number == 0.0


def _add(one: Any, other: Any) -> Any:
    if is_zero(one):
        return other
    return one if is_zero(other) else one + other
