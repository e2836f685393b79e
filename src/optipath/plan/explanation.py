"""The explanation of a plan: what it does, what it leaves out, and why."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from optipath.errors import listed
from optipath.kernels.carriers.structures import FULL, ROTATION

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from optipath.engines.program.program import Program
    from optipath.engines.program.reduction import Reduction
    from optipath.values.inputs import Inputs

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
        places = ", ".join(self.places[:_FEW]) + (", ..." if len(self.places) > _FEW else "")
        how = "added layer after layer" if self.layered else "summed over all rounds"
        return f"light goes round at {places}: {how}, {_count(self.unknowns, 'unknown')}"


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
    parameters: tuple[str, ...] = field(default=())

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as JSON can hold it."""
        return asdict(self)

    def __str__(self) -> str:
        counted = [_count(n, what) for what, n in self.counts.items() if n or what != "dump"]
        manner = self.manner
        words = [f"{name} {manner[name]}" for name in ("method", "model", "engine")]
        words.append(manner["dtype"])
        if manner["composing"] == "jones":
            words.append("composing Jones columns")
        reads = [
            f"{name} reads {', '.join(self.reads[name])} of light {light}"
            for name, light in self.light_at.items()
        ]
        lines = [
            f"{', '.join(counted)}; {', '.join(words)}",
            f"model {manner['model']}: {self.reason}",
            "",
            *self._heading(),
            *_step_lines(self.steps),
            "",
            *_shortened(reads, "readings", _SHOWN),
            *_shortened(list(map(str, self.loops)), "loops", _FEW),
            *self._cost(),
            *self._bounds(),
            *_shortened([f"folded: {sentence}" for sentence in self.folded], "folds", _FEW),
            *self.notes,
            *_shortened(self.parameters, "parameters", _SHOWN),
        ]
        return "\n".join(lines)

    def _heading(self) -> list[str]:
        if self.tolerance is None or self.tolerance["otherwise"] == self.tolerance["model"]:
            return []
        return [f"steps of the exact model {self.tolerance['otherwise']}:"]

    def _cost(self) -> list[str]:
        if self.operations is None:
            return []
        plan, full = (_operations(self.operations[name]) for name in ("plan", "full"))
        return [f"operations per path: {plan}; of the full 4x4 composition: {full}"]

    def _bounds(self) -> list[str]:
        lines = []
        if self.tolerance is not None:
            lines.append(f"tolerance {self.tolerance['most']:g}: {self.tolerance['text']}")
        if self.certificate is not None:
            lines.append(f"certificate: {self.certificate['text']}")
        return lines


def steps_of(reduction: Reduction) -> tuple[ExplainedStep, ...]:
    """Return the steps of a reduced program in words."""
    program = reduction.program
    return tuple(
        ExplainedStep(light, step.label, _action(program, light), tuple(f"S{i}" for i in live))
        for light, (step, live) in enumerate(zip(program.steps, reduction.live, strict=True))
    )


def explained_loops(program: Program) -> Iterator[ExplainedLoop]:
    """Yield the loops of a program in words."""
    for loop in program.loops:
        yield ExplainedLoop(
            tuple(program.steps[junction].label for junction in loop.junctions),
            sum(map(program.count, loop.junctions)),
            loop.layered and not any(_turns(program, at) for at in range(loop.start, loop.stop)),
        )


def _turns(program: Program, light: int) -> bool:
    """Tell whether a step mixes the polarisations along and across the plane of incidence."""
    evaluation = program.steps[light].evaluation
    if evaluation is None:
        return False
    structure = program.evaluations[evaluation].kernel.structure
    return structure in (ROTATION, FULL)


def parameter_lines(inputs: Inputs) -> tuple[str, ...]:
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
    shown = steps
    if len(steps) > _SHOWN:
        shown = (*steps[: _SHOWN // 2], *steps[-_SHOWN // 2 :])
    rows = [(str(s.light), s.label, " ".join(s.live), s.action) for s in shown]
    widths = [max((len(row[column]) for row in rows), default=0) for column in range(3)]
    lines = [
        f"{light.rjust(widths[0])}  {label.ljust(widths[1])}  {live.ljust(widths[2])}  {action}"
        for light, label, live, action in rows
    ]
    if len(shown) < len(steps):
        lines.insert(_SHOWN // 2, f"... {len(steps) - len(shown)} more steps ...")
    return lines


def _action(program: Program, light: int) -> str:
    step = program.steps[light]
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
