"""Live components: which of (S0, S1, S2, S3) light may have and somebody needs, step by step."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from optipath.composer.chains import Item, along_chains
from optipath.composer.entries import entries_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from collections.abc import Set as AbstractSet

    from optipath.composer.entries import Entries
    from optipath.engines.program.program import Program


class Live:
    """What of each light of a program is alive."""

    def __init__(
        self,
        program: Program,
        doubtful: AbstractSet[int] = frozenset(),
        entries: list[Entries] | None = None,
    ) -> None:
        self.program = program
        self.doubtful = doubtful
        self.entries = _entries_of_steps(program) if entries is None else entries
        self.sources = [_sources(each) for each in self.entries]
        self.reached: list[set[int]] = [set() for _ in program.steps]
        self.needed: list[set[int]] = [set() for _ in program.steps]
        _until_settled(reversed(range(len(program.steps))), self._forward)
        for reading in program.readings.values():
            self.needed[reading.light] |= set(range(reading.components))
        _until_settled(range(len(program.steps)), self._backward)

    @property
    def components(self) -> tuple[tuple[int, ...], ...]:
        """For each light, the components that are alive; an intensity always is."""
        pairs = zip(self.reached, self.needed, strict=True)
        return tuple([tuple(sorted((reached & needed) | {0})) for reached, needed in pairs])

    def idle(self) -> set[int]:
        """Return the steps that each leave everything as it is that is alive."""
        return {light for light in range(len(self.program.steps)) if self._does_nothing(light)}

    def _does_nothing(self, light: int) -> bool:
        step, needed = self.program.steps[light], self.needed[light] | {0}
        if step.evaluation is None or not step.inputs:
            return False
        reached = self.reached[step.inputs[0]]
        changed = _changed(self.entries[light])
        return not [1 for row, column in changed if row in needed and column in reached]

    def _forward(self, light: int) -> Iterable[int]:
        inputs, sources = self.program.steps[light].inputs, self.sources[light]
        arriving = set().union(*[self.reached[before] for before in inputs]) if inputs else _ALL
        found = {row for row, columns in enumerate(sources) if columns & arriving}
        if light in self.doubtful:
            found |= arriving
        if found <= self.reached[light]:
            return ()
        self.reached[light] |= found
        return self.program.used_by[light]

    def _backward(self, light: int) -> Iterable[int]:
        sources = self.sources[light]
        asked = set().union(*[sources[row] for row in self.needed[light]])
        before = [i for i in self.program.steps[light].inputs if not asked <= self.needed[i]]
        for source in before:
            self.needed[source] |= asked
        return before


_ALL = frozenset(range(4))
_IDENTITY: Entries = tuple(tuple(float(row == column) for column in range(4)) for row in range(4))


def _entries_of_steps(program: Program) -> list[Entries]:
    known = entries_of(program)
    # What adds lights up, and does nothing to them, is known as such.
    places = [step.evaluation for step in program.steps]
    return [_IDENTITY if place is None else known[place] for place in places]


@lru_cache(1024)
def _sources(entries: Entries) -> tuple[frozenset[int], ...]:
    """Return of which components each component is made."""
    if len(entries) == 1:
        # What a source emits is made of nothing that arrives, and there if it is not 0.
        return tuple(_ALL if entry != 0.0 else frozenset() for entry in entries[0])
    return tuple(frozenset(j for j, entry in enumerate(row) if entry != 0.0) for row in entries)


@lru_cache(1024)
def _changed(entries: Entries) -> tuple[tuple[int, int], ...]:
    """Return which entries are not, or may not be, those of a step that does nothing."""
    places = ((row, column) for row in range(4) for column in range(4))
    return tuple((r, c) for r, c in places if entries[r][c] != _IDENTITY[r][c])


def _until_settled(lights: Iterable[int], look: Callable[[int], Iterable[int]]) -> None:
    """Look at lights, the last one first, and again at those that the look at another asks for."""
    waiting = dict.fromkeys(lights)
    while waiting:
        light, _ = waiting.popitem()
        waiting |= dict.fromkeys(look(light))


def left_out(program: Program) -> tuple[Program, list[str]]:
    """Return a program without the steps that do nothing to what is alive."""
    live = Live(program)
    # One may be idle since another takes away what would reach it: without both, it reaches on.
    idle = live.idle()
    idle = idle and idle & Live(program, idle, live.entries).idle()
    if not idle:
        return replace(program, live=live.components), []
    notes = []
    for light in sorted(idle):
        step = program.steps[light]
        kernel = program.evaluations[step.evaluation or 0].kernel
        notes.append(f"left out, since it changes nothing alive: {kernel.name} at '{step.label}'")

    def rest(items: list[Item]) -> list[Item]:
        return [item for item in items if item.light not in idle]

    return along_chains(program, rest), notes
