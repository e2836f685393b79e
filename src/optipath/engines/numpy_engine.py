"""The NumPy engine: runs a program's steps on whole arrays, component by component."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels import NUMPY

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.kernels import Components, Way
    from optipath.kernels.structures import Numbers
    from optipath.program import Evaluation, Program


@np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore")
def run(
    program: Program,
    leaves: Sequence[np.ndarray[Any, Any]],
    way: Way,
    emitted: Mapping[int, Components] | None = None,
) -> dict[int, tuple[Components, Any]]:
    """Return the light of every reading, as four components that broadcast together.

    Parameters
    ----------
    program : Program
        The steps.
    leaves : sequence of ndarray
        The numbers behind ``program.leaves``, broadcastable.
    way : Way
        How light is carried from step to step.
    emitted : mapping of int to tuple, optional
        The light of each emitting step, in place of what the sources emit.

    Returns
    -------
    dict of int to (tuple, int or ndarray)
        For each light that is read, its four Stokes components, and the exponent of
        the power of two that they are to be taken times.
    """
    kept = {reading.light for reading in program.readings.values()}
    states: dict[int, Any] = {}
    states_left = list(program.light_uses)
    numbers: dict[int, Numbers] = {}
    numbers_left = list(program.evaluation_uses)

    for light, step in enumerate(program.steps):
        if emitted is not None and light in emitted:
            states[light] = way.emit(emitted[light])
            continue
        arriving = [states[source] for source in step.inputs]
        state: Any = reduce(way.add, arriving) if arriving else None
        if step.evaluation is not None:
            index = step.evaluation
            if index not in numbers:
                numbers[index] = _evaluate(program.evaluations[index], leaves)
            structure = program.evaluations[index].kernel.structure
            if structure is None:
                s0, s1, s2, s3 = numbers[index]
                state = way.emit((s0, s1, s2, s3))
            else:
                state = way.act(structure, numbers[index], state)
            numbers_left[index] -= 1
            if not numbers_left[index]:
                del numbers[index]
        states[light] = state
        for source in step.inputs:
            states_left[source] -= 1
            if not states_left[source]:
                del states[source]
    return {light: way.read(states[light]) for light in kept}


def _evaluate(evaluation: Evaluation, leaves: Sequence[np.ndarray[Any, Any]]) -> Numbers:
    function = evaluation.kernel.made_for(NUMPY)
    given = [leaves[leaf] for leaf in evaluation.arguments]
    # Plain numbers among them have no precision of their own, and so would not keep it.
    numbers = tuple(np.asarray(number, given[0].dtype) for number in function(*given))
    structure = evaluation.kernel.structure
    if evaluation.presence is None or structure is None:
        return numbers
    present = leaves[evaluation.presence]
    pairs = zip(numbers, structure.identity, strict=True)
    return tuple(np.where(present, number, nothing) for number, nothing in pairs)
