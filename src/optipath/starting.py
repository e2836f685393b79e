"""Ctrl-C while the command ``optipath`` starts: one line and status 130, as it is later on.

The package imports this before all else, since NumPy takes longer to import than a user to change
their mind. Where any other program imports the library, nothing happens here.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from collections.abc import Iterator

INTERRUPTED = 130
"""The status of a command that Ctrl-C ended: 128 and the number of the signal."""


def stop(*_: Any) -> NoReturn:
    """End at once: an exception could be swallowed by what is being imported."""
    with contextlib.suppress(OSError):
        os.write(2, b"optipath: interrupted\n")
    os._exit(INTERRUPTED)


@contextlib.contextmanager
def interruptible() -> Iterator[None]:
    """Let signals raise exceptions inside, so that files and the terminal are put in order."""
    if signal.getsignal(signal.SIGINT) is not stop:
        yield  # The program is another's.
        return
    signal.signal(signal.SIGTERM, _leave)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, stop)


def _leave(number: int, _: Any) -> NoReturn:
    raise SystemExit(128 + number)


def _is_command() -> bool:
    # While a package is looked for, its name stands behind -m, and "-m" is all that argv knows.
    given = [*sys.orig_argv, ""]
    if sys.argv[:1] == ["-m"]:
        return given[given.index("-m") + 1] == "optipath"
    return bool(sys.argv) and PurePath(sys.argv[0]).stem == "optipath"


if _is_command() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, stop)
