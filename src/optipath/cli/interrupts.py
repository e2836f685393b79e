"""Signals while a command runs: exceptions, so that files and the terminal are put in order."""

from __future__ import annotations

import signal
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, NoReturn

from optipath.interruption import stop

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def interruptible() -> Iterator[None]:
    """Let Ctrl-C raise KeyboardInterrupt inside, and a request to terminate SystemExit.

    Behind it there is nothing left to interrupt. In a program of others nothing changes.
    """
    if signal.getsignal(signal.SIGINT) is not stop:
        yield
        return
    sys.unraisablehook = _unraisable
    signal.signal(signal.SIGTERM, _terminate)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _terminate(number: int, _: object) -> NoReturn:
    raise SystemExit(128 + number)


def _unraisable(lost: sys.UnraisableHookArgs) -> None:
    # Compiled code that calls Python back, such as LLVM, would go on.
    if lost.exc_type in (KeyboardInterrupt, SystemExit):
        stop()
    sys.__unraisablehook__(lost)
