"""Counts: how many operations a path takes, and how often each step is evaluated."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.formulas import lights_formula
from optipath.views import MANY

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.running.runner import Runner


def operations(runner: Runner, *, as_it_stands: bool) -> dict[str, int] | None:
    """Return how many operations a path takes in all, and of the dear sorts.

    None for what cannot be compiled, and so not counted.
    """
    if not runner.compilable:
        return None
    program, limits = runner.program, runner.inputs.limits
    forms = dict.fromkeys((view.raw for view in program.leaves if not view.known), MANY)
    return lights_formula(
        program,
        runner.way,
        runner.dtype.name,
        forms,
        limits,
        polynomials=False,
        as_it_stands=as_it_stands,
    ).operations


def evaluations(runner: Runner, parameters: Mapping[str, Any]) -> dict[str, int]:
    """Return how often the numbers of each step are computed for a batch.

    Raises
    ------
    ParameterError
        With every fault of what is given.
    """
    given, program = runner.sorter.sort(parameters), runner.program
    runner.inputs.resolve(parameters)
    found: dict[str, int] = {}
    for step in program.steps:
        if step.evaluation is None:
            continue
        shapes: list[tuple[int, ...]] = [given.batch] if runner.as_it_stands else []
        for leaf in program.evaluations[step.evaluation].arguments:
            view = program.leaves[leaf]
            known = runner.known_arrays.get(f".{leaf}")
            numbers: Any = known if view.known else given.numbers.get(view.raw)
            shapes.append(np.shape(numbers))
        found[step.label] = int(np.prod(np.broadcast_shapes(*shapes), dtype=np.int64))
    return found
