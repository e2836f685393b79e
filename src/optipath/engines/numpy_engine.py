"""The NumPy engine: runs a program's steps on whole arrays, component by component."""

from __future__ import annotations

from functools import partial, reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels import NUMPY, add, carry, stokes_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.kernels import Carried
    from optipath.kernels.structures import Numbers
    from optipath.program import Evaluation, Program


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def run(
    program: Program, leaves: Sequence[np.ndarray[Any, Any]], columns_from: str | None = None
) -> dict[int, Carried]:
    """Return the light of every reading, as four components that broadcast together.

    Parameters
    ----------
    program : Program
        The steps.
    leaves : sequence of ndarray
        The numbers behind ``program.leaves``, broadcastable.
    columns_from : str, optional
        Emit the four columns of a unit matrix from this source, along a new leading
        axis, and nothing from the others: the readings are then Mueller matrices.

    Returns
    -------
    dict of int to tuple
        The four Stokes components for each light that is read.
    """
    kept = {reading.light for reading in program.readings.values()}
    lights: dict[int, Carried] = {}
    lights_left = list(program.light_uses)
    numbers: dict[int, Numbers] = {}
    numbers_left = list(program.evaluation_uses)
    columns = None
    if columns_from is not None:
        columns = {step: (0.0, 0.0, 0.0, 0.0) for step, _ in program.sources.values()}
        columns[program.sources[columns_from][0]] = _unit_columns(leaves)

    for light, step in enumerate(program.steps):
        if columns is not None and light in columns:
            lights[light] = columns[light]
            continue
        carried = _sum([lights[source] for source in step.inputs])
        if step.evaluation is not None:
            index = step.evaluation
            if index not in numbers:
                numbers[index] = _evaluate(program.evaluations[index], leaves)
            structure = program.evaluations[index].kernel.structure
            if structure is None:
                carried = carry(NUMPY, tuple(numbers[index]))
            else:
                carried = structure.made_for(NUMPY)(numbers[index], carried)
            numbers_left[index] -= 1
            if not numbers_left[index]:
                del numbers[index]
        lights[light] = carried
        for source in step.inputs:
            lights_left[source] -= 1
            if not lights_left[source]:
                del lights[source]
    return {light: stokes_of(NUMPY, lights[light]) for light in kept}


def _evaluate(evaluation: Evaluation, leaves: Sequence[np.ndarray[Any, Any]]) -> Numbers:
    function = evaluation.kernel.made_for(NUMPY)
    numbers = function(*(leaves[leaf] for leaf in evaluation.arguments))
    structure = evaluation.kernel.structure
    if evaluation.presence is None or structure is None:
        return numbers
    present = leaves[evaluation.presence]
    pairs = zip(numbers, structure.identity, strict=True)
    return tuple(np.where(present, number, nothing) for number, nothing in pairs)


def _sum(lights: Sequence[Carried]) -> Any:
    return reduce(partial(add, NUMPY), lights) if lights else None


def _unit_columns(leaves: Sequence[np.ndarray[Any, Any]]) -> Carried:
    dimensions = max((leaf.ndim for leaf in leaves), default=0)
    unit: np.ndarray[Any, Any] = np.eye(4).reshape(4, 4, *[1] * dimensions)
    return carry(NUMPY, tuple(unit[:, component] for component in range(4)))
