"""Reducing: the smallest program that gives what the detectors read."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from optipath.composer.fold import fold
from optipath.composer.live import Live, trim
from optipath.engines.program.reduction import MODELS, Reduction, Tolerance
from optipath.errors import ComposerError, listed

if TYPE_CHECKING:
    from optipath.engines.program.program import Program

_ROUNDS = 3


def unreduced(whole: Program) -> Reduction:
    """Return a program with nothing reduced: all four components through every step."""
    live = tuple(Live(whole).components)
    reason = "asked for by name: every step as it stands"
    return Reduction(whole, "full", reason, live, unreduced=True)


def for_jones(whole: Program, *, constants: bool) -> Reduction:
    """Return a program for Jones columns, which are carried whole."""
    program, notes = fold(whole, constants=constants, matrices=False)
    reason = "Jones columns are carried whole"
    return Reduction(program, "full", reason, tuple(Live(program).components), tuple(notes))


def reduced(whole: Program, *, constants: bool) -> Reduction:
    """Return the smallest program that is exact for a path.

    Parameters
    ----------
    whole : Program
        The path as it stands.
    constants : bool
        Whether constants may be multiplied, which is done in float64.
    """
    program, folded = whole, []
    for _ in range(_ROUNDS):
        before = len(program.steps)
        program, notes = fold(program, constants=constants, matrices=True)
        folded += notes
        live = Live(program)
        program, left_out = trim(live)
        folded += [f"left out, since it changes nothing alive: {name}" for name in left_out]
        if len(program.steps) == before or not left_out:
            break
    else:
        live = Live(program)
    size = max(live.counts)
    return Reduction(
        replace(live.program, counts=live.counts),
        MODELS[size - 1],
        _reason(live, size),
        tuple(live.components),
        tuple(dict.fromkeys(folded)),
    )


def by_name(exact: Reduction, model: str) -> Reduction:
    """Return the smallest exact program carried by a model that may be larger.

    Raises
    ------
    ComposerError
        If the model is too small to be exact.
    """
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
    """Return which model is taken where a certificate allows it; None where none is cheaper.

    Raises
    ------
    ComposerError
        If a model is asked for by name that is not exact, and there can be no certificate.
    """
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


def _reason(live: Live, size: int) -> str:
    """Return why as many components are needed."""
    if size == 1:
        return "S1, S2 and S3 are 0, or nobody needs them"
    names = [f"S{i}" for i in range(4) if any(i in alive for alive in live.components)]
    dead = [f"S{i}" for i in range(4) if f"S{i}" not in names]
    return f"{listed(names)} are alive" + (f", {listed(dead)} nowhere" if dead else "")
