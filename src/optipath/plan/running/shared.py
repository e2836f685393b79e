"""Shared: equal programs are run by one runner, so that a path built anew is not prepared anew."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.running.runner import Runner

if TYPE_CHECKING:
    from collections.abc import Hashable

    from optipath.engines.program.program import Program
    from optipath.plan.running.options import RunOptions
    from optipath.values.inputs import Inputs

_MOST = 32
"""How many runners are kept; that which was asked for longest ago goes first."""

_LARGEST = 1 << 16
"""How many bytes the arrays of a program have at most that is kept."""

_RUNNERS: OrderedDict[Hashable, Runner] = OrderedDict()
_LOCK = Lock()


def runner_for(
    program: Program, inputs: Inputs, options: RunOptions, *, unreduced: bool = False
) -> Runner:
    """Return what runs a program: what ran an equal one before, if that is still kept.

    Parameters
    ----------
    program : Program
        The steps.
    inputs : Inputs
        What may be given.
    options : RunOptions
        How they are run.
    unreduced : bool, optional
        Whether everything is done for each path.

    Returns
    -------
    Runner
        One for all programs of equal steps, numbers and parameters.
    """
    key = _key(program, inputs)
    if key is None:
        return Runner(program, inputs, options, unreduced=unreduced)
    key = key, options, unreduced
    with _LOCK:
        if key not in _RUNNERS:
            _RUNNERS[key] = Runner(program, inputs, options, unreduced=unreduced)
        _RUNNERS.move_to_end(key)
        while len(_RUNNERS) > _MOST:
            _RUNNERS.popitem(last=False)
        return _RUNNERS[key]


def _key(program: Program, inputs: Inputs) -> Hashable:
    """Return what equal programs share, names included; None for what is not kept."""
    operands = [operand.key() for operand in program.operands]
    size = sum([getattr(operand.value, "nbytes", 0) for operand in program.operands])
    if None in operands or size > _LARGEST or inputs.known:
        return None
    if not all(_is_pure(evaluation.kernel.factory) for evaluation in program.evaluations):
        return None
    parameters = (*inputs.open.values(), *inputs.bound.values())
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
        tuple([(use.owner, use.value.name, use.value.negative, use.domain) for use in inputs.uses]),
        tuple(inputs.shapes.items()),
    )


def _is_pure(factory: Any) -> bool:
    """Tell whether a kernel is of the library; one of a user's own may read what changes."""
    maker = factory if hasattr(factory, "__name__") else type(factory)
    return str(getattr(maker, "__module__", "")).startswith("optipath.kernels.")
