"""Walk: the steps of a program taken one after the other, with numbers of any sort."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.kernels import Components, Way
    from optipath.kernels.structures import Numbers
    from optipath.program import Evaluation, Program


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

    Returns
    -------
    dict of int to (tuple, int or array)
        For each light that is read, its four Stokes components, and the exponent of
        the power of two that they are to be taken times.
    """
    reads: dict[int, int] = {}
    for reading in program.readings.values():
        reads[reading.light] = max(reading.components, reads.get(reading.light, 1))
    states: dict[int, Any] = {}
    states_left = list(program.light_uses)
    numbers: dict[int, Numbers] = dict(shared or {})
    numbers_left = list(program.evaluation_uses)

    for light, step in enumerate(program.steps):
        if emitted is not None and light in emitted:
            states[light] = way.emit(emitted[light], program.count(light))
            continue
        arriving = [states[source] for source in step.inputs]
        state: Any = reduce(way.add, arriving) if arriving else None
        if step.evaluation is not None:
            index = step.evaluation
            if index not in numbers:
                numbers[index] = evaluated(program.evaluations[index], leaves, way, number)
            structure = program.evaluations[index].kernel.structure
            if structure is None:
                s0, s1, s2, s3 = numbers[index]
                state = way.emit((s0, s1, s2, s3), program.count(light))
            else:
                state = way.act(structure, numbers[index], state, program.count(light))
            numbers_left[index] -= 1
            if not numbers_left[index]:
                del numbers[index]
        states[light] = state
        for source in step.inputs:
            states_left[source] -= 1
            if not states_left[source]:
                del states[source]
    return {light: way.read(states[light], count) for light, count in reads.items()}


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
