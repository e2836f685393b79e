"""Walk: the steps of a program taken one after the other, with numbers of any sort."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.program.loops import Meeting

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.engines.program.program import Evaluation, Loop, Program
    from optipath.kernels import Components, Way
    from optipath.kernels.carriers.structures import Numbers


def itself(number: Any) -> Any:
    """Return a number as it is."""
    return number


def walk(
    program: Program,
    leaves: Sequence[Any],
    way: Way,
    emitted: Mapping[int, Components] | None = None,
    number: Callable[[Any], Any] = itself,
    shared: Mapping[int, Numbers] | None = None,
    meetings: list[Meeting] | None = None,
    meet: Callable[[Loop], Meeting] | None = None,
) -> dict[int, tuple[Components, Any]]:
    """Return the light of every reading, as four components and an exponent.

    Parameters
    ----------
    program : Program
        The steps.
    leaves : sequence
        The numbers behind ``program.leaves``: floats, arrays that broadcast, or symbols.
    way : Way
        How light is carried from step to step, and in which primitives.
    emitted : mapping of int to tuple, optional
        The light of each emitting step, in place of what the sources emit.
    number : callable, optional
        What is done to each number that a kernel gives.
    shared : mapping of int to tuple, optional
        What some evaluations come to, if that is known.
    meetings : list, optional
        Takes what has been solved for each loop.
    meet : callable, optional
        ``meet(loop)`` gives the meeting of a loop that is solved in other numbers.

    Returns
    -------
    dict of int to (tuple, int or array)
        For each light that is read, its four Stokes components, and the exponent of
        the power of two that they are to be taken times.
    """
    reads: dict[int, int] = {}
    for reading in program.readings.values():
        reads[reading.light] = max(reading.components, reads.get(reading.light, 1))
    loops = {loop.start: loop for loop in program.loops}
    states: dict[int, Any] = {}
    states_left = list(program.light_uses)
    numbers: dict[int, Numbers] = dict(shared or {})
    numbers_left = list(program.evaluation_uses)

    def numbers_of(index: int) -> Numbers:
        if index not in numbers:
            numbers[index] = evaluated(program.evaluations[index], leaves, way, number)
        return numbers[index]

    for light, step in enumerate(program.steps):
        if light in loops:
            loop = loops[light]
            meeting = meet(loop) if meet else Meeting(program, loop, numbers_of, way.xp, number)
            states |= _met(meeting, states, way)
            if meetings is not None:
                meetings.append(meeting)
        if emitted is not None and light in emitted:
            states[light] = way.emit(emitted[light], program.count(light))
        # In a loop, some light is of use to the knots alone, and they are known.
        elif light not in states and states_left[light]:
            states[light] = _behind(program, light, states, way, numbers_of)
        if step.evaluation is not None:
            numbers_left[step.evaluation] -= 1
            if not numbers_left[step.evaluation]:
                numbers.pop(step.evaluation, None)
        for source in step.inputs:
            states_left[source] -= 1
            if not states_left[source]:
                states.pop(source, None)
    return {light: way.read(states[light], count) for light, count in reads.items()}


def whole_matrices(
    program: Program, leaves: Sequence[Any], way: Way, number: Callable[[Any], Any] = itself
) -> dict[int, tuple[Any, ...]]:
    """Return what the evaluations of whole Mueller matrices come to, as `walk` may be given it.

    Parameters
    ----------
    program, leaves, way, number
        As `walk` takes them.
    """
    evaluations = program.evaluations
    return {i: evaluated(evaluations[i], leaves, way, number) for i in program.matrices}


def _behind(
    program: Program,
    light: int,
    states: Mapping[int, Any],
    way: Way,
    numbers_of: Callable[[int], Numbers],
) -> Any:
    """Return the light that a step makes."""
    step, count = program.steps[light], program.count(light)
    state = _together([states[source] for source in step.inputs], way)
    if step.evaluation is None:
        return state
    numbers = numbers_of(step.evaluation)
    structure = program.evaluations[step.evaluation].kernel.structure
    if structure is None:
        s0, s1, s2, s3 = numbers
        return way.emit((s0, s1, s2, s3), count)
    return way.act(structure, numbers, state, count)


def _met(meeting: Meeting, states: Mapping[int, Any], way: Any) -> dict[int, Any]:
    """Return the light at the knots of a loop."""
    arriving: dict[int, Any] = {}
    for knot in meeting.loop.knots:
        inputs = meeting.program.steps[knot].inputs
        if outside := [states[source] for source in inputs if source < meeting.loop.start]:
            arriving[knot] = _together(outside, way)
    found: dict[int, Any] = way.meet(meeting, arriving)
    return found


def _together(lights: list[Any], way: Way) -> Any:
    return reduce(way.add, lights) if lights else None


def evaluated(
    evaluation: Evaluation, leaves: Sequence[Any], way: Way, number: Callable[[Any], Any]
) -> tuple[Any, ...]:
    """Return the numbers that an evaluation comes to.

    Parameters
    ----------
    evaluation : Evaluation
        The kernel, and which leaves it is given.
    leaves, way, number
        As `walk` takes them.
    """
    return tuple(map(number, _evaluated(evaluation, leaves, way)))


def _evaluated(evaluation: Evaluation, leaves: Sequence[Any], way: Way) -> Numbers:
    given = [leaves[leaf] for leaf in evaluation.arguments]
    kernel, left = evaluation.kernel.leaving_out(given, _vanishes)
    numbers = kernel.made_for(way.xp)(*left)
    structure = evaluation.kernel.structure
    if evaluation.presence is None or structure is None:
        return numbers
    present, where = leaves[evaluation.presence], way.xp.where
    pairs = zip(numbers, structure.identity, strict=True)
    return tuple(where(present, number, nothing) for number, nothing in pairs)


def _vanishes(number: Any) -> bool:
    """Tell whether a number is one for the whole batch, known, and 0."""
    return isinstance(number, (float, np.floating)) and number == 0.0
