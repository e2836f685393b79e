"""Execution: the steps of a program taken one after the other, with numbers of any sort."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

from optipath.engines.program import LoopSolver, Result
from optipath.kernels.linear_solve import is_zero

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.engines.program import Loop, Program
    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.kernels.carriers.structures import Numbers


def itself(number: Any) -> Any:
    """Return a number as it is."""
    return number


def execute(
    program: Program,
    operands: Sequence[Any],
    carrier: Carrier,
    emitted: Mapping[int, Components] | None = None,
    number: Callable[[Any], Any] = itself,
    shared: Mapping[int, Numbers] | None = None,
    solvers: list[LoopSolver] | None = None,
    meet: Callable[[Loop], LoopSolver] | None = None,
) -> dict[int, tuple[Components, Any]]:
    """Return the light of every reading, as four components and an exponent."""
    reads: dict[int, int] = {}
    for reading in program.readings.values():
        reads[reading.light] = max(reading.components, reads.get(reading.light, 1))
    loops = {loop.start: loop for loop in program.loops}
    states: dict[int, Any] = {}
    states_left = list(program.light_uses)
    numbers: dict[int, Numbers] = dict(shared or {})
    numbers_left = list(program.evaluation_uses)
    results: dict[int, Numbers] = {}

    def numbers_of(index: int) -> Numbers:
        if index not in numbers:
            numbers[index] = evaluated(program, index, operands, carrier, number, results)
        return numbers[index]

    for light, step in enumerate(program.steps):
        if light in loops:
            loop = loops[light]
            solver = (
                meet(loop) if meet else LoopSolver(program, loop, numbers_of, carrier.xp, number)
            )
            states |= _met(solver, states, carrier)
            if solvers is not None:
                solvers.append(solver)
        if emitted is not None and light in emitted:
            states[light] = carrier.emit(emitted[light], program.count(light))
        # In a loop, some light is of use to the junctions alone, and they are known.
        elif light not in states and states_left[light]:
            states[light] = _behind(program, light, states, carrier, numbers_of)
        if step.evaluation is not None:
            numbers_left[step.evaluation] -= 1
            if not numbers_left[step.evaluation]:
                numbers.pop(step.evaluation, None)
        for source in step.inputs:
            states_left[source] -= 1
            if not states_left[source]:
                states.pop(source, None)
    return {light: carrier.read(states[light], count) for light, count in reads.items()}


def whole_matrices(
    program: Program,
    operands: Sequence[Any],
    carrier: Carrier,
    number: Callable[[Any], Any] = itself,
) -> dict[int, tuple[Any, ...]]:
    """Return the values of evaluations of whole Mueller matrices, which `execute` may take."""
    return {i: evaluated(program, i, operands, carrier, number) for i in program.matrices}


def _behind(
    program: Program,
    light: int,
    states: Mapping[int, Any],
    carrier: Carrier,
    numbers_of: Callable[[int], Numbers],
) -> Any:
    """Return the light that a step makes."""
    step, count = program.steps[light], program.count(light)
    state = _together([states[source] for source in step.inputs], carrier)
    if step.evaluation is None:
        return state
    numbers = numbers_of(step.evaluation)
    structure = program.evaluations[step.evaluation].kernel.structure
    if structure is None:
        s0, s1, s2, s3 = numbers
        return carrier.emit((s0, s1, s2, s3), count)
    return carrier.act(structure, numbers, state, count)


def _met(solver: LoopSolver, states: Mapping[int, Any], carrier: Any) -> dict[int, Any]:
    """Return the light at the junctions of a loop."""
    arriving: dict[int, Any] = {}
    for junction in solver.loop.junctions:
        inputs = solver.program.steps[junction].inputs
        if outside := [states[source] for source in inputs if source < solver.loop.start]:
            arriving[junction] = _together(outside, carrier)
    results: dict[int, Any] = carrier.meet(solver, arriving)
    return results


def _together(lights: list[Any], carrier: Carrier) -> Any:
    return reduce(carrier.add, lights) if lights else None


def evaluated(
    program: Program,
    index: int,
    operands: Sequence[Any],
    carrier: Carrier,
    number: Callable[[Any], Any] = itself,
    results: dict[int, Numbers] | None = None,
) -> tuple[Any, ...]:
    """Return the numbers that an evaluation comes to."""
    result = _evaluated(program, index, operands, carrier, {} if results is None else results)
    return tuple(map(number, result))


def _evaluated(
    program: Program,
    index: int,
    operands: Sequence[Any],
    carrier: Carrier,
    results: dict[int, Numbers],
) -> Numbers:
    evaluation, takes = program.evaluations[index], program.takes[index]
    for taken in takes:
        if taken not in results:
            results[taken] = _evaluated(program, taken, operands, carrier, results)
    arguments = [
        results[argument.evaluation][argument.place]
        if type(argument) is Result
        else operands[argument]  # type: ignore[index]
        for argument in evaluation.arguments
    ]
    for taken in takes:
        if taken not in program.taken_by_several:
            del results[taken]
    kernel, left = evaluation.kernel.specialised(arguments, is_zero)
    numbers = carrier.evaluated(kernel, left)
    structure = evaluation.kernel.structure
    if evaluation.presence is None or structure is None:
        return numbers
    present, where = operands[evaluation.presence], carrier.xp.where
    pairs = zip(numbers, structure.identity, strict=True)
    return tuple(where(present, number, nothing) for number, nothing in pairs)
