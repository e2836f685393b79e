"""Light paths: the ways from a source to a detector one by one, with what each contributes."""

from __future__ import annotations

from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.kernels import NUMPY, Plain, energy
from optipath.light import Light
from optipath.walk import evaluated

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from optipath.kernels import Carried
    from optipath.program import Program
    from optipath.whole_path import WholePath


@dataclass(frozen=True)
class LightPath:
    """One way from a source to a detector or a dump.

    Attributes
    ----------
    route : tuple of str
        The out-ports by which light leaves element after element, as ``"node.port"``.
    end : str
        The detector or dump.
    bounces : int
        How often it has been reflected.
    light : Light
        What it contributes.
    """

    route: tuple[str, ...]
    end: str
    bounces: int
    light: Light

    def __str__(self) -> str:
        brightest = float(np.max(self.light.intensity, initial=0.0))
        return f"{brightest:.6g}  {' -> '.join((*self.route, self.end))}"


@dataclass(order=True)
class _Branch:
    """Light on its way, the brightest first."""

    dimness: float
    number: int
    light: int = field(compare=False)
    state: Carried = field(compare=False)
    route: tuple[str, ...] = field(compare=False)
    bounces: int = field(compare=False)
    end: str = field(compare=False, default="")


def light_paths(
    whole: WholePath,
    limit: int | None,
    bounces: int | None,
    parameters: Mapping[str, Any],
    framed: Callable[[Any], Any],
) -> list[LightPath]:
    """Return the ways of light through a path, the brightest first.

    Parameters
    ----------
    whole : WholePath
        The path as it stands.
    limit : int or None
        How many at most.
    bounces : int or None
        How many reflections each may have.
    parameters : mapping of str to Any
        As a plan takes them.
    framed : callable
        Gives the frame of a reading for these values, or what makes it.

    Raises
    ------
    ParameterError
        If what is given is not allowed, or there is no end of ways.
    """
    _check("limit", limit, 1)
    _check("bounces", bounces, 0)
    if limit is None and (place := _endless(whole.program, bounces)):
        cure = "a limit" if bounces is not None else "a limit, or a number of bounces"
        raise ParameterError(f"light goes round at '{place}' for ever; give {cure}")
    whole.refuse_traced(parameters, "light paths are listed")
    whole.inputs.resolve(parameters)
    found: list[LightPath] = []
    for path in _Search(whole, parameters, framed).paths(bounces):
        if len(found) == limit:
            break
        found.append(path)
    return found


class _Search:
    """Goes along all ways at once, always on from where light is brightest."""

    def __init__(
        self, whole: WholePath, parameters: Mapping[str, Any], framed: Callable[[Any], Any]
    ) -> None:
        self.framed = framed
        self.program = whole.program
        self.way = Plain(NUMPY)
        given = whole.sorter.sort(parameters)
        self.batch = given.batch
        leaves = whole.stepwise.leaves(given)
        with np.errstate(all="ignore"):
            self.numbers = [
                evaluated(evaluation, leaves, self.way, whole.stepwise.number)
                for evaluation in self.program.evaluations
            ]
        self._ends: dict[int, list[str]] = {}
        for name, reading in self.program.readings.items():
            self._ends.setdefault(reading.light, []).append(name)
        self._count = count()
        self._waiting: list[_Branch] = []

    def paths(self, bounces: int | None) -> Iterator[LightPath]:
        """Yield the ways with so many bounces at most."""
        for light, _ in self.program.sources.values():
            s0, s1, s2, s3 = self.numbers[self.program.steps[light].evaluation or 0]
            state = self.way.emit((s0, s1, s2, s3))
            self._add(light, state, (self.program.steps[light].label,), 0)
        while self._waiting:
            branch = heappop(self._waiting)
            if branch.end:
                yield self._arrived(branch)
                continue
            for end in self._ends.get(branch.light, ()):
                self._add(branch.light, branch.state, branch.route, branch.bounces, end)
            for user in self.program.used_by[branch.light]:
                now = branch.bounces + self.program.steps[user].bounces
                if bounces is None or now <= bounces:
                    self._go_on(branch, user, now)

    def _go_on(self, branch: _Branch, user: int, bounces: int) -> None:
        step, state, route = self.program.steps[user], branch.state, branch.route
        if step.evaluation is not None:
            structure = self.program.evaluations[step.evaluation].kernel.structure
            assert structure is not None  # noqa: S101 - sources take no light
            with np.errstate(all="ignore"):
                state = self.way.act(structure, self.numbers[step.evaluation], state)
            same_element = self.program.steps[branch.light].label == step.label
            if step.port and not same_element:
                route = (*route, step.label)
        self._add(user, state, route, bounces)

    def _add(
        self, light: int, state: Carried, route: tuple[str, ...], bounces: int, end: str = ""
    ) -> None:
        brightest = float(np.max(energy(NUMPY, state), initial=0.0))
        if brightest > 0.0:
            branch = _Branch(-brightest, next(self._count), light, state, route, bounces, end)
            heappush(self._waiting, branch)

    def _arrived(self, branch: _Branch) -> LightPath:
        reading = self.program.readings[branch.end]
        components, _ = self.way.read(branch.state)
        parts = [np.broadcast_to(part, self.batch) for part in components]
        stokes = np.stack(parts, axis=-1)
        stokes[..., reading.components :] = np.nan
        light = Light.of(stokes, self.framed(reading.frame))
        return LightPath(branch.route, branch.end, branch.bounces, light)


def _check(what: str, number: Any, least: int) -> None:
    whole = isinstance(number, (int, np.integer)) and not isinstance(number, bool)
    if number is not None and not (whole and number >= least):
        raise ParameterError(f"{what} must be a whole number of {least} or more, not {number!r}")


def _endless(program: Program, bounces: int | None) -> str:
    """Return a place where light goes round without end; nothing where it does not."""
    for loop in program.loops:
        if bounces is None or _goes_round_unbounced(program, range(loop.start, loop.stop)):
            return program.steps[loop.start].label
    return ""


def _goes_round_unbounced(program: Program, members: range) -> bool:
    """Tell whether there is a way round a loop that has no reflection."""
    inputs = {
        light: {i for i in program.steps[light].inputs if i in members}
        for light in members
        if not program.steps[light].bounces
    }
    waiting = True
    while waiting:
        # What waits for nothing any more is on no way round.
        done = [light for light, before in inputs.items() if not before & inputs.keys()]
        for light in done:
            del inputs[light]
        waiting = bool(done)
    return bool(inputs)
