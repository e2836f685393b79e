"""The explanation of a plan, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from optipath.inputs import Inputs
    from optipath.program import Program, Step

_SHOWN = 40
_READS = {4: "S0, S1, S2, S3", 3: "S0, S1, S2", 1: "S0"}


def explanation(program: Program, inputs: Inputs, manner: str, notes: tuple[str, ...]) -> str:
    """Return what a program does, in the order in which it does it.

    Parameters
    ----------
    program : Program
        The steps.
    inputs : Inputs
        The parameters.
    manner : str
        How the steps are run, for the first line.
    notes : tuple of str
        What else a reader should know, a line each.
    """
    counts = [
        _count(len(program.sources), "source"),
        _count(len(program.detectors), "detector"),
        *([_count(len(program.dumps), "dump")] if program.dumps else []),
        _count(len(program.steps), "step"),
    ]
    readings = program.readings.items()
    return "\n".join(
        [
            f"{', '.join(counts)}; {manner}",
            "",
            *_step_lines(program),
            "",
            *(f"{name} reads {_READS[r.components]} of light {r.light}" for name, r in readings),
            *notes,
            *_parameter_lines(inputs),
        ]
    )


def _parameter_lines(inputs: Inputs) -> list[str]:
    bound = [f"parameter {p.name} = {p.text(p.default)}" for p in inputs.bound.values()]
    return bound + [
        f"parameter {p.name}: "
        + (p.default_text() if p.default is None else f"open, {p.default_text()} if not given")
        for p in inputs.open.values()
    ]


def _step_lines(program: Program) -> list[str]:
    rows = [(str(light), step.label, _action(program, step)) for light, step in _shown(program)]
    widths = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    lines = [
        f"{light.rjust(widths[0])}  {label.ljust(widths[1])}  {action}"
        for light, label, action in rows
    ]
    left_out = len(program.steps) - len(rows)
    if left_out:
        lines.insert(_SHOWN // 2, f"... {left_out} more steps ...")
    return lines


def _shown(program: Program) -> list[tuple[int, Step]]:
    numbered = list(enumerate(program.steps))
    if len(numbered) <= _SHOWN:
        return numbered
    return numbered[: _SHOWN // 2] + numbered[-_SHOWN // 2 :]


def _action(program: Program, step: Step) -> str:
    inputs = " + ".join(f"light {light}" for light in step.inputs)
    if step.evaluation is None:
        return f"sum of {inputs}"
    evaluation = program.evaluations[step.evaluation]
    structure = evaluation.kernel.structure
    if structure is None:
        return f"emits {evaluation.kernel.name}"
    where = ", where it is there" if evaluation.presence is not None else ""
    return f"{evaluation.kernel.name} ({structure.name}) of {inputs}{where}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}" + "s" * (number != 1)
