"""The explanation of a plan: what it does, what it leaves out, and why."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import asdict, dataclass
from itertools import pairwise
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.choice import LARGE
from optipath.engines.program import MODELS
from optipath.errors import ParameterError
from optipath.faults import listed
from optipath.kernels.carriers.carrier import StokesCarrier
from optipath.kernels.carriers.structures import FULL, JONES, ROTATION
from optipath.plan.runnable import LONGEST
from optipath.values.arrays import joint_shape
from optipath.values.operands import MANY

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from optipath.engines.program import Loop, Program, Step
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.certificate import Certificate
    from optipath.plan.inputs import Inputs
    from optipath.plan.runner import Runner


_SHOWN = 40
_FEW = 8


@dataclass(frozen=True)
class ExplainedStep:
    """A step in words."""

    light: int
    label: str
    action: str
    live: tuple[str, ...]


@dataclass(frozen=True)
class ExplainedLoop:
    """A loop in words."""

    places: tuple[str, ...]
    unknowns: int
    layered: bool

    def __str__(self) -> str:
        how = "added layer after layer" if self.layered else "summed over all rounds"
        unknowns = _count(self.unknowns, "unknown")
        return f"light goes round at {_first_few(self.places)}: {how}, {unknowns}"


@dataclass(frozen=True)
class Explanation:
    """What a plan does, step by step."""

    counts: Mapping[str, int]
    manner: Mapping[str, str]
    reason: str
    steps: tuple[ExplainedStep, ...]
    reads: Mapping[str, tuple[str, ...]]
    light_at: Mapping[str, int]
    folded: tuple[str, ...] = ()
    loops: tuple[ExplainedLoop, ...] = ()
    operations: Mapping[str, Mapping[str, int]] | None = None
    certificate: Mapping[str, Any] | None = None
    tolerance: Mapping[str, Any] | None = None
    notes: tuple[str, ...] = ()
    parameters: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as JSON can hold it."""
        return asdict(self)

    def __str__(self) -> str:
        manner, tolerance, counts = self.manner, self.tolerance, self.operations
        counted = [_count(n, what) for what, n in self.counts.items() if n or what != "dump"]
        how = [f"{name} {manner[name]}" for name in ("method", "model", "engine")]
        how += [manner["dtype"], *["composing Jones columns"] * (manner["composing"] == "jones")]
        reads = [
            f"{name} reads {', '.join(self.reads[name])} of light {light}"
            for name, light in self.light_at.items()
        ]
        lines = [
            f"{', '.join(counted)}; {', '.join(how)}",
            f"model {manner['model']}: {self.reason}",
            "",
        ]
        if tolerance is not None and tolerance["otherwise"] != tolerance["model"]:
            lines.append(f"steps of the exact model {tolerance['otherwise']}:")
        lines += [
            *_step_lines(self.steps),
            "",
            *_shortened(reads, "readings", _SHOWN),
            *_shortened([*map(str, self.loops)], "loops", _FEW),
        ]
        if counts is not None:
            plan, full = (_operations(counts[name]) for name in ("plan", "full"))
            lines.append(f"operations per path: {plan}; of the full 4x4 composition: {full}")
        if tolerance is not None:
            lines.append(f"tolerance {tolerance['most']:g}: {tolerance['text']}")
        if self.certificate is not None:
            lines.append(f"certificate: {self.certificate['text']}")
        folded = [f"folded: {sentence}" for sentence in self.folded]
        return "\n".join(
            [
                *lines,
                *_shortened(folded, "folds", _FEW),
                *self.notes,
                *_shortened(self.parameters, "parameters", _SHOWN),
            ]
        )


def _loop(program: Program, loop: Loop) -> ExplainedLoop:
    """Return a loop in words; one in which nothing mixes s and p is added layer after layer."""
    evaluations = [program.steps[at].evaluation for at in range(loop.start, loop.stop)]
    kernels = [program.evaluations[index].kernel for index in evaluations if index is not None]
    return ExplainedLoop(
        tuple(program.steps[junction].label for junction in loop.junctions),
        sum(map(program.count, loop.junctions)),
        loop.layered and not any(kernel.structure in (ROTATION, FULL, JONES) for kernel in kernels),
    )


def _parameter_lines(inputs: Inputs) -> tuple[str, ...]:
    """Return the parameters of a plan, and what follows from them, a sentence each."""
    bound = [f"parameter {p.name} = {p.text(p.default)}" for p in inputs.bound.values()]
    opened = [
        f"parameter {p.name}: "
        + (p.default_text() if p.default is None else f"open, {p.default_text()} if not given")
        for p in inputs.open.values()
    ]
    computed = dict.fromkeys(
        f"{value.spoken} follows from {listed([one.name for one in value.arguments])}"
        for value in inputs.computed
        if not value.bound
    )
    return (*bound, *opened, *computed)


def _operations(counts: Mapping[str, int]) -> str:
    parts = [f"{counts[name]} {name}" for name in counts if name != "all" and counts[name]]
    return f"{counts['all']}" + (f" ({', '.join(parts)})" if parts else "")


def _shortened(lines: Sequence[str], what: str, most: int) -> list[str]:
    if len(lines) <= most:
        return list(lines)
    return [*lines[: most - 1], f"{len(lines) - most + 1} more {what}"]


def _step_lines(steps: Sequence[ExplainedStep]) -> list[str]:
    rows = [(str(s.light), s.label, " ".join(s.live), s.action) for s in steps]
    half, more = _SHOWN // 2, len(rows) - _SHOWN
    rows = rows if more <= 0 else [*rows[:half], *rows[-half:]]
    a, b, c = (max((len(row[column]) for row in rows), default=0) for column in range(3))
    lines = [f"{n:>{a}}  {label:<{b}}  {live:<{c}}  {action}" for n, label, live, action in rows]
    return lines if more <= 0 else [*lines[:half], f"... {more} more steps ...", *lines[half:]]


def _action(program: Program, step: Step) -> str:
    inputs = " + ".join(f"light {light}" for light in step.inputs)
    if step.evaluation is None:
        return f"sum of {inputs}"
    evaluation = program.evaluations[step.evaluation]
    if evaluation.kernel.structure is None:
        return f"emits {evaluation.kernel.name}"
    where = ", where it is there" if evaluation.presence is not None else ""
    return f"{evaluation.kernel.name} of {inputs}{where}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}" + "s" * (number != 1)


def _components(places: Sequence[int]) -> tuple[str, ...]:
    return tuple(f"S{place}" for place in places)


def _first_few(names: Sequence[str]) -> str:
    return ", ".join(names[:_FEW]) + (", ..." if len(names) > _FEW else "")


def explanation_of(plan: Any) -> Explanation:
    """Return a `Plan` explained, part by part."""
    program, reduction = plan.program, plan.reduction
    ends = program.readings
    kinds = ("source", "detector", "dump", "step")
    reason = reduction.reason
    if plan.instead is not None:
        reason = f"where its certificate allows it; exact is '{reduction.model}': {reason}"
    own = operations(plan.answers.light, unreduced=reduction.unreduced)
    full = operations(plan.answers.whole, unreduced=True, carrier=StokesCarrier)
    manner = ("method", "model", "engine", "dtype", "composing")
    return Explanation(
        counts={kind: len(getattr(program, f"{kind}s")) for kind in kinds},
        manner={name: getattr(plan, name) for name in manner},
        reason=reason,
        steps=tuple(
            ExplainedStep(light, step.label, _action(program, step), _components(live))
            for light, (step, live) in enumerate(zip(program.steps, reduction.live, strict=True))
        ),
        reads={name: _components(range(end.components)) for name, end in ends.items()},
        light_at={name: end.light for name, end in ends.items()},
        folded=reduction.folded,
        operations=None if own is None or full is None else {"plan": own, "full": full},
        loops=tuple(_loop(program, loop) for loop in program.loops),
        certificate=_certified(plan),
        tolerance=_tolerated(plan),
        notes=tuple(_notes(plan)),
        parameters=_parameter_lines(plan.inputs),
    )


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
    if plan.reduction.model == MODELS[0]:
        return {"text": f"not needed, since model {MODELS[0]} is exact"}
    opened = plan.inputs.open.values()
    missing = [parameter.name for parameter in opened if parameter.default is None]
    if missing:
        return {"text": f"depends on {_first_few(missing)}; give values"}
    if plan.answers.whole.for_jax.has_traced:
        return {"text": "depends on values that JAX traces"}
    try:
        result = plan.answers.certificates({})
    except ParameterError as fault:
        return {"text": f"none, since {fault}"}
    bounds = {name: _extremes(one) for name, one in result.items()}
    if len(bounds) > _FEW:
        return {"bounds": bounds, "text": f"for {len(bounds)} ends"}
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


def _extremes(certificate: Certificate) -> dict[str, float] | None:
    """Return the widest bounds of a batch; None where there are none."""
    lower = float(np.min(certificate.lower, initial=np.inf))
    upper = float(np.max(certificate.upper, initial=-np.inf))
    return {"lower": lower, "upper": upper} if np.isfinite([lower, upper]).all() else None


def _notes(plan: Any) -> Iterator[str]:
    outlets = [f"{port} has no link: its light leaves the path" for port in plan.outlets]
    tap = "is a tap, which takes nothing: leave its light out of sums of energy"
    taps = [f"{port} {tap}" for port in plan.taps]
    yield from _shortened(outlets, "ports like these", _FEW)
    if plan.engine_for(LARGE) != plan.engine:
        yield (
            f"all batches are run step by step: paths of at most {LONGEST} "
            f"steps are compiled, in float64 and float32, if all elements compute with xp alone, "
            f"in real numbers"
        )
    else:
        sizes = {plan.engine_for(1): 1}
        for few, many in pairwise([10**power for power in range(10)]):
            if (engine := plan.engine_for(many)) not in sizes:
                counts = range(few, many)
                reached = bisect_left(counts, 1, key=lambda count: plan.engine_for(count) == engine)
                sizes[engine] = few + reached
        (first, _), *others = sizes.items()
        larger = [f"; from {count:,} paths, {engine}" for engine, count in others]
        yield f"batches are run by {first}{''.join(larger)}"
    yield from _shortened(taps, "ports like these", _FEW)


def operations(
    runner: Runner, *, unreduced: bool, carrier: type[Carrier] | None = None
) -> dict[str, int] | None:
    """Return how many operations a path takes in all, and of the dear sorts."""
    options: dict[str, Any] = {"counted": True, "unreduced": unreduced}
    made = runner.attempt(
        lambda: runner.recorded(runner.all_passed_as(MANY), **options).lights(
            carrier or runner.carrier
        )
    )
    return None if made is None else made.operations


def evaluations(runner: Runner, parameters: Mapping[str, Any]) -> dict[str, int]:
    """Return how often the numbers of each step are computed for a batch."""
    runner.for_jax.refuse_traced(parameters, "evaluations are counted")
    runner.inputs.resolve(parameters)
    argument, program = runner.reader.read(parameters), runner.program
    results: dict[str, int] = {}
    for step in program.steps:
        if step.evaluation is None:
            continue
        shapes: list[tuple[int, ...]] = [argument.shape] if runner.unreduced else []
        for place in program.passed_to[step.evaluation]:
            if program.operands[place].known:
                shapes.append(np.shape(runner.known_arrays.get(f".{place}", 0.0)))
            else:
                own = program.operands[place].input_key
                keys = (own, own._replace(part="cos"), own._replace(part="sin"))
                shapes += [np.shape(argument.numbers[k]) for k in keys if k in argument.numbers]
        # What one element does in several steps goes by one name.
        results[step.label] = max(prod(joint_shape(*shapes)), results.get(step.label, 0))
    return results
