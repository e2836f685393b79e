"""Light paths: the ways of light through a path, listed by power."""

from __future__ import annotations

from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush
from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.program import evaluated
from optipath.errors import ParameterError
from optipath.kernels.carriers.carried import energy
from optipath.kernels.carriers.carrier import StokesCarrier
from optipath.kernels.primitives import NUMPY
from optipath.values.precision import whole_number

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    import numpy.typing as npt

    from optipath.engines.program import Program
    from optipath.kernels.carriers.carried import Carried
    from optipath.light.light import Light
    from optipath.plan.runner import Runner


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

    @property
    def intensity(self) -> npt.NDArray[Any]:
        """The intensity that it contributes, of shape (...)."""
        return self.light.intensity

    def __str__(self) -> str:
        brightest = float(np.max(self.intensity, initial=0.0))
        return f"{brightest:.6g}  {' -> '.join((*self.route, self.end))}"


def light_paths(
    whole: Runner,
    limit: int | None,
    bounces: int | None,
    parameters: Mapping[str, Any],
    as_light: Callable[[Any, Any], Light],
) -> list[LightPath]:
    """Return the ways of light through a path, the brightest first."""
    faults = [] if limit is None else whole_number("limit", limit)
    faults += [] if bounces is None else whole_number("bounces", bounces, 0)
    ParameterError.raise_for(faults)
    if limit is None and (place := endless(whole.program, bounces)):
        cure = "a limit" if bounces is not None else "a limit, or a number of bounces"
        raise ParameterError(f"light goes round at '{place}' for ever; give {cure}")
    whole.for_jax.refuse_traced(parameters, "light paths are listed")
    _, batch = whole.inputs.resolve(parameters)
    results: list[LightPath] = []
    with whole.enough_for(batch, 4 * len(whole.program.readings) + 16):
        # Refuses light that never fades.
        whole.interpreter.lights(whole.reader.read(parameters))
        for path in Search(whole, parameters, as_light).paths(bounces):
            if len(results) == limit:
                break
            results.append(path)
    return results


_FAINTEST = 1e-200
"""What is not followed any further, as a share of what a source emits."""

_PATIENCE = 1 << 10
"""How many branches may hope to be brighter than what arrives (more in longer paths), before the
oldest have their turn: in a loop that hardly any light leaves, others would hope for ever."""


@dataclass(order=True)
class _Branch:
    """Light on its way, first that of which most can arrive somewhere by one way."""

    hope: float
    number: int
    light: int = field(compare=False)
    state: Carried = field(compare=False)
    route: tuple[str, ...] = field(compare=False)
    bounces: int = field(compare=False)
    end: str = field(compare=False, default="")


class Search:
    """Goes along all ways at once, always on from where most may come of it."""

    def __init__(
        self, whole: Runner, parameters: Mapping[str, Any], as_light: Callable[[Any, Any], Light]
    ) -> None:
        self.as_light = as_light
        self.program = whole.program
        self.carrier = StokesCarrier(NUMPY)
        argument = whole.reader.read(parameters)
        self.batch = argument.shape
        operands = whole.interpreter.operands(argument)
        with np.errstate(all="ignore"):
            self.numbers = [
                evaluated(self.program, index, operands, self.carrier, whole.interpreter.number)
                for index in range(len(self.program.evaluations))
            ]
        self._ends: dict[int, list[str]] = {}
        for name, reading in self.program.readings.items():
            self._ends.setdefault(reading.light, []).append(name)
        self._count = count()
        self._waiting: list[_Branch] = []
        self._arriving: list[_Branch] = []
        self._most = self._most_that_arrives()
        self._least = 0.0
        self._patience = _PATIENCE + 64 * len(self.program.steps)

    def paths(self, bounces: int | None) -> Iterator[LightPath]:
        """Yield the ways with so many bounces at most."""
        for light, _ in self.program.sources.values():
            s0, s1, s2, s3 = self.numbers[self.program.steps[light].evaluation or 0]
            state = self.carrier.emit((s0, s1, s2, s3))
            self._least = max(self._least, _FAINTEST * self._brightness(state))
            self._add(light, state, (self.program.steps[light].label,), 0)
        followed = 0
        while self._waiting or self._arriving:
            # Nothing can be brighter than what has arrived, or nobody waits any longer.
            first = not self._waiting or self._arriving[:1] < self._waiting[:1]
            if self._arriving and (first or followed >= self._patience):
                followed = max(0, followed - self._patience // 16)
                yield self._arrived(heappop(self._arriving))
                continue
            branch = self._oldest() if followed >= self._patience else heappop(self._waiting)
            followed += 1
            if followed > 2 * self._patience:
                place = self.program.steps[branch.light].label
                raise ParameterError(
                    f"of {followed} ways of light, followed as far as '{place}', none arrives "
                    f"anywhere; give a smaller limit, or fewer bounces"
                )
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
                state = self.carrier.act(structure, self.numbers[step.evaluation], state)
            same_element = self.program.steps[branch.light].label == step.label
            if step.port and not same_element:
                route = (*route, step.label)
        self._add(user, state, route, bounces)

    def _add(
        self, light: int, state: Carried, route: tuple[str, ...], bounces: int, end: str = ""
    ) -> None:
        hope = self._brightness(state) * (1.0 if end else self._most[light])
        if hope > self._least:
            branch = _Branch(-hope, next(self._count), light, state, route, bounces, end)
            heappush(self._arriving if end else self._waiting, branch)

    def _oldest(self) -> _Branch:
        """Take the branch that has waited longest."""
        branch = min(self._waiting, key=lambda waiting: waiting.number)
        self._waiting.remove(branch)
        heapify(self._waiting)
        return branch

    @staticmethod
    def _brightness(state: Carried) -> float:
        with np.errstate(all="ignore"):
            return float(np.max(np.abs(energy(NUMPY, state)), initial=0.0))

    def _most_that_arrives(self) -> list[float]:
        """Return the largest share of each light that can get to an end by one way (Dijkstra).

        No way passes a light twice, as rounding makes gains just above 1; amplifying ones may be
        brighter.
        """
        steps = self.program.steps
        gains = [self._largest_gain(place) for place in range(len(self.program.evaluations))]
        most = [0.0] * len(steps)
        waiting = [(-1.0, light) for light in self._ends]
        for _, light in waiting:
            most[light] = 1.0
        resolved: set[int] = set()
        while waiting:
            share, light = heappop(waiting)
            if light in resolved:
                continue
            resolved.add(light)
            evaluation = steps[light].evaluation
            share = -share if evaluation is None else -share * gains[evaluation]
            for before in steps[light].inputs:
                if share > most[before] and before not in resolved:
                    most[before] = share
                    heappush(waiting, (-share, before))
        return most

    def _largest_gain(self, evaluation: int) -> float:
        """Return what an element does to the intensity of the light that it dims least."""
        structure = self.program.evaluations[evaluation].kernel.structure
        if structure is None:
            return 1.0
        with np.errstate(all="ignore"):
            first = structure.rows(NUMPY, self.numbers[evaluation])[0]
            polarised = np.sqrt(sum(np.square(entry) for entry in first[1:]))
            return float(np.max(np.abs(first[0]) + polarised, initial=0.0))

    def _arrived(self, branch: _Branch) -> LightPath:
        reading = self.program.readings[branch.end]
        with np.errstate(all="ignore"):
            components, _ = self.carrier.read(branch.state)
        # Interpreters may have one path as a batch of one.
        parts = [np.broadcast_to(part, self.batch or (1,)) for part in components]
        stokes = np.stack(parts, axis=-1).reshape(*self.batch, 4)
        stokes[..., reading.components :] = np.nan
        light = self.as_light(stokes, reading.frame)
        return LightPath(branch.route, branch.end, branch.bounces, light)


def endless(program: Program, bounces: int | None) -> str:
    """Return a place where light goes round without end; nothing where it does not."""
    for loop in program.loops:
        if bounces is None or _goes_round_unbounced(program, range(loop.start, loop.stop)):
            return program.steps[loop.start].label
    return ""


def _goes_round_unbounced(program: Program, members: range) -> bool:
    """Tell whether there is a way round a loop that has no reflection."""
    left = {light for light in members if not program.steps[light].bounces}
    before = 0
    while before != len(left):
        before = len(left)
        # What waits for nothing any more is on no way round.
        left = {light for light in left if not left.isdisjoint(program.steps[light].inputs)}
    return bool(left)
