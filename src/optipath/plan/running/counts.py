"""Counts: how many operations a path takes, and how often each step is evaluated."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.shapes import joint_shape
from optipath.values.operands import MANY

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.running.runner import Runner


def operations(
    runner: Runner, *, unreduced: bool, carrier: type[Carrier] | None = None
) -> dict[str, int] | None:
    """Return how many operations a path takes in all, and of the dear sorts."""
    formulas = runner.formulas
    forms = formulas.all_given_as(MANY)
    made = formulas.attempt(
        lambda: formulas.lights(forms, carrier=carrier, counted=True, unreduced=unreduced)
    )
    return None if made is None else made.operations


def evaluations(runner: Runner, parameters: Mapping[str, Any]) -> dict[str, int]:
    """Return how often the numbers of each step are computed for a batch."""
    runner.for_jax.refuse_traced(parameters, "evaluations are counted")
    runner.inputs.resolve(parameters)
    given, program = runner.reader.read(parameters), runner.program
    found: dict[str, int] = {}
    for step in program.steps:
        if step.evaluation is None:
            continue
        shapes: list[tuple[int, ...]] = [given.batch] if runner.unreduced else []
        for place in program.given_to[step.evaluation]:
            operand = program.operands[place]
            if operand.known:
                array = runner.formulas.known_arrays.get(f".{place}")
                shapes.append(() if array is None else array.shape)
            else:
                keys = (
                    operand.input_key,
                    *(operand.input_key._replace(part=part) for part in ("cos", "sin")),
                )
                shapes += [np.shape(given.numbers[key]) for key in keys if key in given.numbers]
        count = prod(joint_shape(*shapes))
        # What one element does in several steps goes by one name.
        found[step.label] = max(count, found.get(step.label, 0))
    return found
