"""The command ``optipath``: its subcommands, and how errors end it."""

from __future__ import annotations

import contextlib
import io
import os
import sys
import warnings
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import shell_complete

from optipath.cli.accuracy_command import accuracy
from optipath.cli.bench_command import bench
from optipath.cli.cache_command import cache
from optipath.cli.chart_command import chart
from optipath.cli.explain_command import explain
from optipath.cli.interrupts import interruptible
from optipath.cli.polarization_command import polarization
from optipath.cli.presets_command import presets
from optipath.cli.run_command import run
from optipath.cli.show_command import show
from optipath.errors import INTERRUPTED, LoopWarning, OptipathError, printable

if TYPE_CHECKING:
    from collections.abc import Sequence


@click.group(
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "show_default": True},
    commands=[presets, show, run, explain, polarization, bench, cache, chart, accuracy],
)
@click.version_option(version("optipath"), prog_name="optipath")
@click.pass_context
def cli(context: click.Context) -> None:
    """Trace polarised light along optical paths; angles are in degrees."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return the exit status.

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
    for stream in (sys.stdout, sys.stderr):
        # A terminal that lacks a letter shows a question mark in its place.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        with interruptible():
            return _run(sys.argv[1:] if arguments is None else arguments)
    except KeyboardInterrupt:
        _print_error("interrupted")
        return INTERRUPTED


def _run(arguments: Sequence[str]) -> int:
    if sys.stdout is None:
        return _refuse("the output cannot be written: standard output is closed")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("always", LoopWarning)
            warnings.showwarning = _tell  # type: ignore[assignment] # all that it is given
            _invoke(arguments)
        sys.stdout.flush()
    except click.ClickException as error:
        return _refuse(error.format_message())
    except OptipathError as error:
        return _refuse("; ".join(error.faults))
    except BrokenPipeError:
        _forget_output()  # Whoever read it has seen enough.
    except OSError as error:
        _forget_output()
        return _refuse(f"the output cannot be written: {error.strerror or error}")
    return 0


def _invoke(arguments: Sequence[str]) -> None:
    # Not by click's own main, which has ways of its own to end where a pipe breaks or Ctrl-C comes.
    if wanted := os.environ.get("_OPTIPATH_COMPLETE"):
        shell_complete(cli, {}, "optipath", "_OPTIPATH_COMPLETE", wanted)
        return
    try:
        with cli.make_context("optipath", list(arguments)) as context:
            cli.invoke(context)
    except click.exceptions.Exit:
        pass  # Help and version have been printed.


def _tell(message: Warning | str, *_about: Any) -> None:
    """Write a warning as one line, without the place in the code that nobody asked for."""
    _print_error(str(message))


def _forget_output() -> None:
    # Otherwise Python tries once more at exit, and complains.
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _refuse(message: str) -> int:
    _print_error(message)
    return 2


def _print_error(message: str) -> None:
    with contextlib.suppress(OSError):  # There is nobody left to be told.
        click.echo(f"optipath: {printable(' '.join(message.split()))}", err=True)
