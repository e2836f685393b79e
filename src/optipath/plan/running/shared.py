"""Shared: equal programs are run by one runner, so that a path built anew is not prepared anew."""

from __future__ import annotations

from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.carriers.own_code import is_defined_in
from optipath.plan.running.runner import Runner
from optipath.values.arrays.jax_values import is_traced

if TYPE_CHECKING:
    from collections.abc import Hashable

    from optipath.elements.own_ways import OwnWays
    from optipath.engines.program.program import Program
    from optipath.plan.running.options import RunOptions
    from optipath.values.inputs import Inputs

_MOST = 32
"""How many runners are kept; that which was asked for longest ago goes first."""

_LARGEST = 1 << 16
"""How many bytes the arrays of a program have at most that is kept."""

_RUNNERS: dict[Hashable, Runner] = {}
_LOCK = Lock()


def runner_for(
    program: Program,
    inputs: Inputs,
    options: RunOptions,
    own_ways: tuple[OwnWays, ...] = (),
    *,
    unreduced: bool = False,
) -> Runner:
    """Return what runs a program: what ran an equal one before, if that is still kept."""
    key = _key(program, inputs)
    if key is None or own_ways:
        return Runner(program, inputs, options, own_ways, unreduced=unreduced)
    key = key, options, unreduced
    with _LOCK:
        # Taken out and put back, it stands last; an OrderedDict compares keys three times for that.
        runner = _RUNNERS.pop(key, None)
        if runner is None:
            runner = Runner(program, inputs, options, unreduced=unreduced)
        _RUNNERS[key] = runner
        while len(_RUNNERS) > _MOST:
            del _RUNNERS[next(iter(_RUNNERS))]
        return runner


def _key(program: Program, inputs: Inputs) -> Hashable:
    """Return what equal programs share, names included; None for what is not kept."""
    operands = [operand.key() for operand in program.operands]
    size = sum([getattr(operand.value, "nbytes", 0) for operand in program.operands])
    agreements = [agreement.key() for agreement in (*inputs.agreements, *inputs.for_complex)]
    if None in (*operands, *agreements) or size > _LARGEST or inputs.known:
        return None
    parameters = (*inputs.open.values(), *inputs.bound.values())
    if any(is_traced(parameter.default) for parameter in parameters):
        return None
    if not all(_is_pure(evaluation.kernel.factory) for evaluation in program.evaluations):
        return None
    return (
        tuple(operands),
        program.evaluations,
        program.steps,
        program.counts,
        program.loops,
        tuple([(name, step) for name, (step, _) in program.sources.items()]),
        tuple([(name, end.light, end.components) for name, end in program.readings.items()]),
        tuple(inputs.open.values()),
        tuple(inputs.bound.values()),
        # A default of -0.0 equals 0.0, but is another number.
        tuple([np.asarray(p.default).tobytes() for p in parameters if p.default is not None]),
        tuple(
            [(u.owner, u.value.name, u.value.scale, u.value.offset, u.domain) for u in inputs.uses]
        ),
        tuple(inputs.shapes.items()),
        tuple(agreements),
    )


def _is_pure(factory: Any) -> bool:
    """Tell whether a kernel is of the library; one of a user's own may read what changes."""
    return is_defined_in("optipath.kernels.", factory)
