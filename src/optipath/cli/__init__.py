"""The command line; what it stands on is imported when it is called, and so after `starting`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command ``optipath``; return the exit status.

    Parameters
    ----------
    arguments : sequence of str, optional
        What stands behind ``optipath``; that of the process by default.

    Returns
    -------
    int
        0, also where who read the output has seen enough; 2 with one line on standard error for
        bad input; 130 where Ctrl-C ended it.
    """
    from optipath.cli.command import main as command  # noqa: PLC0415 - see above

    return command(arguments)
