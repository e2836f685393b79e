"""Ctrl-C while the command ``optipath`` starts: one line and status 130, as it is later on.

The package imports this before all else, since NumPy takes longer to import than a user to change
their mind; so it imports little itself. Where any other program imports the library, nothing
happens here.
"""

import os
import signal
import sys

INTERRUPTED = 130
"""The status of a command that Ctrl-C ended: 128 and the number of the signal."""


def stop(*_: object) -> None:
    """End at once: what is being imported could swallow an exception."""
    try:
        os.write(2, b"optipath: interrupted\n")
    finally:
        os._exit(INTERRUPTED)


def _is_command() -> bool:
    # While a package is looked for, its name stands behind -m, and "-m" is all that argv knows.
    if sys.argv[:1] == ["-m"]:
        return sys.orig_argv[sys.orig_argv.index("-m") + 1 :][:1] == ["optipath"]
    return os.path.basename("".join(sys.argv[:1])).partition(".")[0] == "optipath"  # noqa: PTH119


if _is_command() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, stop)
