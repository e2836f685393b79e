"""Explaining: a plan looked at for its explanation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.automatic import LARGE, batches
from optipath.errors import ParameterError
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.plan.explanation import Explanation, explained_loops, parameter_lines, steps_of
from optipath.plan.running.counts import operations
from optipath.plan.running.formula_maker import LONGEST
from optipath.values.cures import cure, how_to_give

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from optipath.plan.certificate import Certificate

_FEW = 8
"""Of how many ends the bounds are written down."""


def explanation_of(plan: Any) -> Explanation:
    """Return a `Plan` explained, part by part."""
    ends = plan.program.readings
    counts = {
        "source": len(plan.program.sources),
        "detector": len(plan.program.detectors),
        "dump": len(plan.program.dumps),
        "step": len(plan.program.steps),
    }
    return Explanation(
        counts=counts,
        manner={
            "method": plan.method,
            "model": plan.model,
            "engine": plan.engine,
            "dtype": plan.dtype,
            "composing": plan.composing,
        },
        reason=_why(plan),
        steps=steps_of(plan.reduction),
        reads={n: tuple(f"S{i}" for i in range(end.components)) for n, end in ends.items()},
        light_at={name: end.light for name, end in ends.items()},
        folded=plan.reduction.folded,
        operations=_operations(plan),
        loops=tuple(explained_loops(plan.program)),
        certificate=_certified(plan),
        tolerance=_tolerated(plan),
        notes=tuple(_notes(plan)),
        parameters=parameter_lines(plan.inputs),
    )


def _operations(plan: Any) -> dict[str, dict[str, int]] | None:
    own = operations(plan.answers.light, unreduced=plan.reduction.unreduced)
    full = operations(plan.answers.whole, unreduced=True, carrier=StokesCarrier)
    return None if own is None or full is None else {"plan": own, "full": full}


def _why(plan: Any) -> str:
    if plan.instead is None:
        return str(plan.reduction.reason)
    exact = plan.reduction
    return f"where its certificate allows it; exact is '{exact.model}': {exact.reason}"


def _tolerated(plan: Any) -> dict[str, Any] | None:
    if plan.tolerance is None:
        return None
    exact = plan.reduction.model
    if plan.instead is not None:
        text = f"model {plan.instead.model} where its certificate is within it, {exact} elsewhere"
    elif others := [n for n, end in plan.program.readings.items() if end.components > 1]:
        ends = _first_few(others)
        text = f"not used, since certificates are for intensities, and more is read by {ends}"
    else:
        text = f"not needed, since model {plan.model} is exact"
    return {"most": plan.tolerance, "model": plan.model, "otherwise": exact, "text": text}


def _certified(plan: Any) -> dict[str, Any] | None:
    """Return the bounds for the values that are known, and defaults for others."""
    opened = plan.inputs.open.values()
    missing = [parameter.name for parameter in opened if parameter.default is None]
    if missing:
        see = cure(
            "see plan.certificate(...)", f"give {' '.join(map(how_to_give, missing[:_FEW]))}"
        )
        return {"text": f"depends on {_first_few(missing)}; {see}"}
    if plan.whole.loops:
        return {"text": "none, since light goes round"}
    if plan.answers.whole.for_jax.has_traced:
        return {"text": "depends on values that JAX traces"}
    try:
        found = plan.answers.certificates({})
    except ParameterError as fault:
        return {"text": f"none, since {fault}"}
    bounds = {name: _extremes(one) for name, one in found.items()}
    if len(bounds) > _FEW:
        see = cure("see plan.certificate(...)", "see --json")
        return {"bounds": bounds, "text": f"for {len(bounds)} ends; {see}"}
    texts = [
        f"at {name}, S0 is {each['lower']:.6g} .. {each['upper']:.6g} of the scalar model's"
        if each
        else f"the light at {name} cannot be bounded"
        for name, each in bounds.items()
    ]
    stacks = any(evaluation.kernel.unpolarising for evaluation in plan.whole.evaluations)
    at = ", which takes a stack as a whole" if stacks else ""
    at += ", for the defaults" if plan.inputs.open else ""
    return {"bounds": bounds, "text": "; ".join(texts) + at}


def _first_few(names: Sequence[str]) -> str:
    return ", ".join(names[:_FEW]) + (", ..." if len(names) > _FEW else "")


def _extremes(certificate: Certificate) -> dict[str, float] | None:
    """Return the widest bounds of a batch; None where there are none."""
    lower = float(np.min(certificate.lower, initial=np.inf))
    upper = float(np.max(certificate.upper, initial=-np.inf))
    return {"lower": lower, "upper": upper} if np.isfinite([lower, upper]).all() else None


def _notes(plan: Any) -> Iterator[str]:
    yield from _each(plan.outlets, "has no link: its light leaves the path")
    runner, engine = plan.answers.light, plan.chosen
    if plan.engine_for(LARGE) != plan.engine:
        yield (
            f"all batches are run step by step: paths of at most {LONGEST} "
            f"steps are compiled, in float64 and float32, if all elements compute with xp alone, "
            f"in real numbers"
        )
    elif engine != "jax":
        yield batches(engine, runner.formulas.length, runner.dtype.name)
    yield from _each(
        plan.taps, "is a tap, which takes nothing: leave its light out of sums of energy"
    )


def _each(ports: Sequence[str], what: str) -> Iterator[str]:
    """Yield a sentence for each port, or for the first few of many."""
    shown = ports if len(ports) <= _FEW else ports[: _FEW // 2]
    yield from (f"{port} {what}" for port in shown)
    if len(shown) < len(ports):
        yield f"{len(ports) - len(shown)} more ports like these"
