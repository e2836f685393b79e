"""Loops: lights that depend on each other, found where they meet.

Every way round a loop passes a junction, where lights add up. What light at one brings to
others is found by sending unit lights along the steps between; a system of equations in the
intensities along x and y, S2 and S3 of all junctions then gives the light at each.
"""

from __future__ import annotations

from functools import reduce
from math import inf
from operator import and_
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.carriers.parted import energy, parts_of, unit_light
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.carriers.structures import SCALE
from optipath.kernels.numbers.elimination import Elimination, is_zero
from optipath.kernels.numbers.vanishing import not_above_rounding

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.engines.program.program import Loop, Program
    from optipath.kernels.carriers.carried import Carried
    from optipath.kernels.carriers.parted import Parts
    from optipath.kernels.carriers.structures import Numbers
    from optipath.kernels.numbers.primitives import Primitives


LITTLE = 1e-2
"""What of an unknown does not come back where its sum takes a closer look, as a share."""

_ROUNDING = 1e-9
"""How much light may gain by roundings of what leaves."""


class Column(NamedTuple):
    """What becomes of one unit of light at a junction until it meets other light again."""

    back: dict[int, Parts]
    leaves: Any


class LoopSolver:
    """The lights at the junctions of a loop, for any light that arrives there."""

    def __init__(
        self,
        program: Program,
        loop: Loop,
        numbers: Callable[[int], Numbers],
        xp: Primitives,
        number: Callable[[Any], Any],
        rounded: Callable[[Any], Any] | None = None,
    ) -> None:
        self.number = number
        self.rounded = rounded or number
        self.program = program
        self.loop = loop
        self.numbers = numbers
        self.carrier = StokesCarrier(xp)
        self.unknowns = [
            (junction, part) for junction in loop.junctions for part in range(self.count(junction))
        ]
        self._junctions = frozenset(loop.junctions)
        self._place = {unknown: place for place, unknown in enumerate(self.unknowns)}
        self.columns = [self._column(*unknown) for unknown in self.unknowns]
        self.leaves = [self._settled(column.leaves) for column in self.columns]
        self._system = Elimination(
            xp,
            [self.scattered(column.back) for column in self.columns],
            self.leaves,
            [part < 2 for _, part in self.unknowns],
            None if rounded is None else reduce(and_, self.fading(), True),  # noqa: FBT003
        )
        self.pivots = self._system.pivots
        self.found: list[Any] = []

    def count(self, junction: int) -> int:
        """Return by how many components the light at a junction is carried."""
        return self.program.count(junction)

    def lights(self, arriving: Mapping[int, Parts]) -> dict[int, Parts]:
        """Return the parts of the light at each junction, for those of what arrives at some."""
        given = self.scattered(arriving)
        found = self._system.solved([given.get(i, 0.0) for i in range(len(self.unknowns))])
        self.found = [found if is_zero(found) else self.rounded(found) for found in found]
        lights: dict[int, Parts] = dict.fromkeys(self.loop.junctions, ())
        for (junction, _), number in zip(self.unknowns, self.found, strict=True):
            lights[junction] = (*lights[junction], self.rounded(number))
        return lights

    @property
    def conditions(self) -> list[Any]:
        """Whether so much of each unknown leaves that nobody needs to look at it."""
        enough = [pivot > LITTLE for pivot in self.pivots if not is_zero(pivot - 1.0)]
        return [*enough, *self.fading(self.pivots)]

    def adds_up(self, slack: float) -> Any:
        """Return whether what has been found is light that can be, but for roundings.

        Where light gains on each round, its rounds have no sum, and what solves the system is no
        light: a solution x = b + M x that is one is never less than b + M b + ... + M^n b.
        """
        xp, holds = self.carrier.xp, True
        for junction in self.loop.junctions:
            parts = [
                self.found[self._place[junction, part]] for part in range(self.count(junction))
            ]
            total = sum(parts[:2])
            size = xp.where(total > 0.0, total, 1.0)
            x, *others = (part / size for part in parts)
            y, *across = others or (x,)
            squares = sum(part * part for part in across)
            bright = (x >= -slack) & (y >= -slack) & (squares <= 4.0 * x * y + slack)
            holds = holds & bright & (total < inf)
        return holds

    def fading(self, looked_at: Sequence[Any] = ()) -> list[Any]:
        """Return whether no light at any junction, however polarised, gains on its way to others.

        Of light (x, y, S2, S3), l1 x + l2 y + l3 S2 + l4 S3 leaves; that is never negative
        where l3^2 + l4^2 <= l1 l2. Numbers that are looked at in any case are left out.
        """
        found = []
        for junction in self.loop.junctions:
            places = [self._place[junction, part] for part in range(self.count(junction))]
            along, across = places[:2], [self.leaves[place] for place in places[2:]]
            found += [
                self.leaves[place] > -_ROUNDING
                for place in along
                if not any(self.leaves[place] is number for number in looked_at)
            ]
            squares = [leaves * leaves for leaves in across if not is_zero(leaves)]
            if squares:
                most = self.leaves[along[0]] * self.leaves[along[1]] + _ROUNDING
                found.append(sum(squares) <= most)
        return found

    def scattered(self, lights: Mapping[int, Parts]) -> dict[int, Any]:
        """Return the parts of the lights at some junctions by their place among the unknowns."""
        return {
            self._place[junction, part]: self._settled(number)
            for junction, parts in lights.items()
            for part, number in enumerate(parts)
        }

    def _settled(self, number: Any) -> Any:
        return 0.0 if is_zero(number) else self.number(number)

    def _column(self, junction: int, part: int) -> Column:
        """Follow a unit of light at a junction to the next ones."""
        column, xp = Column({}, 0.0), self.carrier.xp
        waiting = [(junction, unit_light(part, self.program.count(junction)))]
        while waiting:
            light, state = waiting.pop()
            there = energy(xp, state)
            passed = [there] * self.program.times_read[light]
            leaves = sum(passed, start=column.leaves)
            for user in self.program.used_by[light]:
                after = self._behind(user, state)
                passed.append(energy(xp, after))
                if user in self._junctions:
                    parts = parts_of(xp, after, self.count(user))
                    before = column.back.get(user, (0.0,) * len(parts))
                    sums = (one + other for one, other in zip(before, parts, strict=True))
                    column.back[user] = tuple(sums)
                elif self.loop.start <= user < self.loop.stop:
                    waiting.append((user, after))
                else:
                    leaves = leaves + passed[-1]
            absorbed = there - sum(passed)
            if not self._only_dims(light):
                # What a lossless element seems to absorb is its rounding.
                size = sum(map(xp.absolute, passed), start=xp.absolute(there))
                absorbed = not_above_rounding(xp, absorbed, size)
            column = Column(column.back, leaves + absorbed)
        return column

    def _only_dims(self, light: int) -> bool:
        """Tell whether light goes one way only, and is dimmed there: the difference is exact."""
        users = self.program.used_by[light]
        if len(users) != 1 or self.program.times_read[light]:
            return False
        evaluation = self.program.steps[users[0]].evaluation
        if evaluation is None:
            return False
        return self.program.evaluations[evaluation].kernel.structure is SCALE

    def _behind(self, user: int, state: Carried) -> Carried:
        step, count = self.program.steps[user], self.count(user)
        if step.evaluation is None:
            return state
        structure = self.program.evaluations[step.evaluation].kernel.structure
        assert structure is not None  # noqa: S101 - sources take no light
        return self.carrier.act(structure, self.numbers(step.evaluation), state, count)
