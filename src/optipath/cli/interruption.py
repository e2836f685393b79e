"""Ctrl-C while the command ``optipath`` starts: one line, and no traceback of imports.

The package imports this first, and this only what is loaded already: importing NumPy is slow.
"""

import _signal  # type: ignore[import-not-found]
import os
import sys

# Built in; `signal` itself imports `enum`, which takes milliseconds.

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
    return os.path.basename("".join(map(str, sys.argv[:1]))).partition(".")[0] == "optipath"  # noqa: PTH119


# In a program of others, nothing changes.
if _is_command() and _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
    _signal.signal(_signal.SIGINT, stop)
