"""One attack: what is given, what is done with it, and whether the library stood it."""

from __future__ import annotations

import resource
import signal
import time
import traceback
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import optipath as op

if TYPE_CHECKING:
    from collections.abc import Callable

LONGEST_SENTENCE = 800
MOST_MEMORY = 500 * 2**20


class Attack(NamedTuple):
    """What is given, as a text from which it can be given again, and what is done with it."""

    shown: str
    act: Callable[[], object]
    seconds: float = 20.0


class Overtime(BaseException):
    """An attack that takes too long; no ``except Exception`` holds it up."""


def fault_of(attack):
    """Return what the library did wrong, or None."""
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    started = time.process_time()
    try:
        with warnings.catch_warnings(), _limited(3.0 * attack.seconds):
            warnings.simplefilter("error")
            for kind in (
                op.errors.LoopWarning,
                op.errors.AngleWarning,
                op.errors.ColourWarning,
                op.errors.CoherenceWarning,
            ):
                warnings.simplefilter("ignore", kind)
            attack.act()
    except op.OptipathError as error:
        if fault := _fault_of_sentences(error.faults):
            return fault
    except Overtime:
        return f"not done after {3.0 * attack.seconds:g} s of processor time"
    except KeyboardInterrupt:
        raise
    except BaseException:  # noqa: BLE001 - whatever the library raises besides
        return traceback.format_exc()
    taken = time.process_time() - started
    if taken > attack.seconds:
        return f"took {taken:.1f} s of processor time"
    grown = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory)
    return f"took {grown >> 20} MiB" if grown > MOST_MEMORY else None


def check_light(light, emitted=np.inf):
    """Refuse light that cannot be: negative, more than was emitted, or polarised beyond 100 %."""
    stokes = np.asarray(light.stokes)
    rounding = 1e3 * np.finfo(stokes.dtype).eps
    assert np.isfinite(stokes[..., 0]).all(), f"S0 is {stokes[..., 0]}"
    assert (stokes[..., 0] >= 0.0).all(), f"S0 is {stokes[..., 0].min()}"
    assert (stokes[..., 0] <= emitted * (1.0 + rounding)).all(), f"S0 is {stokes[..., 0].max()}"
    parts = stokes[..., 1:]
    read = ~np.isnan(parts).all(axis=tuple(range(parts.ndim - 1)))
    assert np.isfinite(parts[..., read]).all(), "a component is not finite"
    polarised = np.hypot.reduce(np.asarray(light.normalized)[..., 1:][..., read], axis=-1)
    assert not (polarised > 1.0 + rounding).any(), f"DoP is {np.nanmax(polarised)}"


def _fault_of_sentences(faults):
    for fault in faults:
        if not fault or len(fault) > LONGEST_SENTENCE:
            return f"a sentence of {len(fault)} letters: {fault[:100]!r}"
        if not fault.replace("\n", " ").isprintable():
            return f"a sentence that a terminal obeys: {fault!r}"
    return None


@contextmanager
def _limited(seconds):
    def stop(_signal, _frame):
        raise Overtime

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
