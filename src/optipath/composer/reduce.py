"""Reducing: the smallest program that gives what the detectors read."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from optipath.composer.cheaper import cheaper_kernels
from optipath.composer.live import Live, left_out
from optipath.composer.multiply import multiplied_constants
from optipath.composer.turns import joined_turns
from optipath.engines.program.reduction import MODELS, Reduction, Tolerance
from optipath.errors import ComposerError, listed

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.engines.program.program import Program


@dataclass(frozen=True)
class Pass:
    """One way in which a program gives the same light for less work."""

    name: str
    change: Callable[[Program], tuple[Program, list[str]]]

    def __call__(self, program: Program) -> tuple[Program, list[str]]:
        """Return the program that is left, and notes."""
        return self.change(program)


def passes_for(model: str, composing: str, dtype: str) -> tuple[tuple[Pass, ...], int]:
    """Return what programs go through, in order, and how often as long as one of them helps."""
    stokes, doubles = composing == "stokes", dtype != "longdouble"
    every = (
        (True, Pass("cheaper kernels", cheaper_kernels)),
        (True, Pass("joined turns", partial(joined_turns, sums=doubles))),
        (doubles, Pass("multiplied constants", partial(multiplied_constants, matrices=stokes))),
        (stokes, Pass("left out", left_out)),
    )
    found = () if model == "full" else every
    return tuple(each for is_wanted, each in found if is_wanted), 3 if stokes else 1


def reduced(whole: Program, model: str, composing: str, dtype: str) -> Reduction:
    """Return the smallest program that is exact for a path."""
    passes, rounds = passes_for(model, composing, dtype)
    program, notes = whole, list[str]()
    for _ in range(rounds):
        done = len(notes)
        for each in passes:
            program, found = each(program)
            notes += found
        if len(notes) == done:
            break
    folded = tuple(dict.fromkeys(notes))
    program = replace(program, live=program.live or Live(program).components)
    if passes and composing == "stokes":
        counts = tuple([alive[-1] + 1 for alive in program.live])
        program, size = replace(program, counts=counts), max(counts)
        return Reduction(program, MODELS[size - 1], _reason(program, size), folded)
    reason = "Jones columns are carried whole"
    if not passes:
        reason = "asked for by name: every step as it stands"
    return Reduction(program, "full", reason, folded, unreduced=not passes)


def by_name(exact: Reduction, model: str) -> Reduction:
    """Return the smallest exact program carried by a model that may be larger."""
    most = MODELS.index(model)
    for light, alive in enumerate(exact.live):
        if alive[-1] > most:
            cure = f"use model '{exact.model}' or 'auto'"
            if not _others(exact):
                cure += ", or give a tolerance"
            raise ComposerError(
                f"model '{model}' is not exact for this path: S{alive[-1]} is alive at "
                f"'{exact.program.steps[light].label}'; {cure}"
            )
    return replace(exact.by(model), reason=f"asked for by name; {exact.reason}")


def tolerated(exact: Reduction, model: str, most: float) -> Tolerance | None:
    """Return which model is taken where a certificate allows it."""
    size = MODELS.index(exact.model)
    wanted = "scalar" if model == "auto" else model
    if MODELS.index(wanted) >= size:
        return None
    others = _others(exact)
    if not others and not exact.program.loops:
        return Tolerance(wanted, most)
    if model == "auto":
        return None
    if exact.program.loops:
        raise ComposerError(
            f"model '{model}' is not exact for this path, and there are no certificates for light "
            f"that goes round; use model '{exact.model}'"
        )
    raise ComposerError(
        f"model '{model}' is not exact for this path, and certificates are for intensities: "
        f"{listed([repr(name) for name in others])} reads more; let all read 'intensity', as "
        f"path.reading('intensity') does, or use model '{exact.model}'"
    )


def _others(exact: Reduction) -> list[str]:
    """Return the ends that read more than the intensity."""
    return [name for name, end in exact.program.readings.items() if end.components > 1]


def _reason(program: Program, size: int) -> str:
    """Return why as many components are needed."""
    if size == 1:
        return "S1, S2 and S3 are 0, or nobody needs them"
    names = [f"S{i}" for i in range(4) if any(i in alive for alive in program.live)]
    dead = [f"S{i}" for i in range(4) if f"S{i}" not in names]
    return f"{listed(names)} are alive" + (f", {listed(dead)} nowhere" if dead else "")
