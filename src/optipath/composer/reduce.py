"""Reducing: the smallest program that gives what the detectors read."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from optipath.composer.fold import fold
from optipath.composer.live import Live, trim
from optipath.errors import ComposerError
from optipath.reduction import MODELS, Reduction

if TYPE_CHECKING:
    from optipath.program import Program

_ROUNDS = 3


def as_it_stands(whole: Program) -> Reduction:
    """Return a program with nothing reduced: all four components through every step."""
    live = tuple(Live(whole).components)
    reason = "asked for by name: every step as it stands"
    return Reduction(whole, "full", reason, live, as_it_stands=True)


def for_jones(whole: Program, *, constants: bool) -> Reduction:
    """Return a program for Jones columns, which are carried whole."""
    program, notes = fold(whole, constants=constants, matrices=False)
    reason = "Jones columns are carried whole"
    return Reduction(program, "full", reason, tuple(Live(program).components), tuple(notes))


def reduced(whole: Program, model: str, *, constants: bool) -> Reduction:
    """Return the smallest program that is exact for a path.

    Parameters
    ----------
    whole : Program
        The path as it stands.
    model : str
        One of `MODELS`, or ``"auto"``.
    constants : bool
        Whether constants may be multiplied, which is done in float64.

    Raises
    ------
    ComposerError
        If the model is too small to be exact.
    """
    program, folded = whole, []
    for _ in range(_ROUNDS):
        before = len(program.steps)
        program, notes = fold(program, constants=constants, matrices=True)
        folded += notes
        live = Live(program)
        program, left_out = trim(live)
        folded += [f"'{label}' does nothing to what is alive" for label in left_out]
        if len(program.steps) == before:
            break
    live = Live(program)
    counts, size = live.counts, max(live.counts)
    exact = MODELS[size - 1]
    if model == "auto":
        chosen, reason = exact, _reason(live, size)
    elif MODELS.index(model) + 1 < size:
        raise ComposerError(_too_small(live, model, exact))
    else:
        chosen, reason = model, f"asked for by name; {_reason(live, size)}"
        counts = (MODELS.index(model) + 1,) * len(counts)
    program = replace(program, counts=counts)
    components = tuple(live.components)
    return Reduction(program, chosen, reason, components, tuple(dict.fromkeys(folded)))


def _reason(live: Live, size: int) -> str:
    """Return why as many components are needed."""
    if size == 1:
        return "S1, S2 and S3 are 0, or nobody needs them"
    names = [f"S{i}" for i in range(4) if any(i in alive for alive in live.components)]
    dead = [f"S{i}" for i in range(4) if f"S{i}" not in names]
    return f"{_listed(names)} are alive" + (f", {_listed(dead)} nowhere" if dead else "")


def _too_small(live: Live, model: str, exact: str) -> str:
    most = MODELS.index(model)
    light = next(i for i, alive in enumerate(live.components) if alive[-1] > most)
    label, component = live.program.steps[light].label, live.components[light][-1]
    return (
        f"model '{model}' is not exact for this path: S{component} is alive at '{label}'; "
        f"use model '{exact}' or 'auto', or give a tolerance"
    )


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
