"""The command ``optipath``: its subcommands, and how errors end it."""

from __future__ import annotations

import contextlib
import io
import os
import sys
import warnings
from importlib import import_module
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import shell_complete

from optipath.cli.interrupts import interruptible
from optipath.cli.whole_help import WholeHelp
from optipath.errors import (
    LoopWarning,
    MeshWarning,
    OptipathError,
    PhotonWarning,
    StoreWarning,
    did_you_mean,
    printable,
)
from optipath.extras import needing
from optipath.interruption import INTERRUPTED
from optipath.values.cures import of_files
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    from collections.abc import Sequence


_COMMANDS = (
    "accuracy",
    "bench",
    "cache",
    "chart",
    "explain",
    "explore",
    "materials",
    "plot",
    "polarization",
    "presets",
    "run",
    "show",
    "surface",
    "sweep",
)


class _Commands(WholeHelp):
    """The subcommands, each imported when it is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        del ctx
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        del ctx
        if cmd_name not in _COMMANDS:
            return None
        found: click.Command = getattr(import_module(f"optipath.cli.{cmd_name}_command"), cmd_name)
        return found

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return a subcommand; refuse one that there is not."""
        name = args[0]
        if not (ctx.resilient_parsing or name in _COMMANDS or name.startswith("-")):
            raise click.UsageError(f"command '{name}' is unknown{did_you_mean(name, _COMMANDS)}")
        return super().resolve_command(ctx, args)


def _import(context: click.Context, _option: click.Parameter, modules: tuple[str, ...]) -> None:
    if modules and not context.resilient_parsing:
        from optipath.cli.own_modules import import_own  # noqa: PLC0415 - hardly ever needed

        for name in modules:
            import_own(name)


@click.group(
    cls=_Commands,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "show_default": True},
)
@click.version_option(package_name="optipath", prog_name="optipath")
@click.option(
    "--import",
    "modules",
    multiple=True,
    metavar="MODULE",
    expose_value=False,
    callback=_import,
    help="Import elements of your own: a module's name, or a .py file. May be repeated.",
)
@click.pass_context
def cli(context: click.Context) -> None:
    """Trace polarised light along optical paths; angles are in degrees."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return the exit status."""
    for stream in (sys.stdout, sys.stderr):
        # A terminal that lacks a letter shows a question mark in its place.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        with interruptible():
            return _run(sys.argv[1:] if arguments is None else arguments)
    except KeyboardInterrupt:
        _print_error("interrupted")
        exec("")  # noqa: S102 - else Python, interrupted in a text it ran, ends by the signal
        return INTERRUPTED


def _run(arguments: Sequence[str]) -> int:
    if sys.stdout is None:
        return _refuse("the output cannot be written: standard output is closed")
    try:
        with warnings.catch_warnings(), units_are_written(), of_files():
            warnings.simplefilter("always", LoopWarning)
            for once in (MeshWarning, PhotonWarning, StoreWarning):  # The same of each surface.
                warnings.simplefilter("default", once)
            warnings.showwarning = _tell  # type: ignore[assignment] # all that it is given
            with needing("some options"):
                _invoke(arguments)
        sys.stdout.flush()
    except click.ClickException as error:
        return _refuse(error.format_message())
    except OptipathError as error:
        return _refuse(*error.faults, about=error.about)
    except MemoryError:
        return _refuse("the memory of this machine does not suffice; run fewer paths at once")
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


def _refuse(*faults: str, about: str = "") -> int:
    """Tell what is wrong: one fault on the one line, several on a line each."""
    _print_error(*str(OptipathError(*faults, about=about)).splitlines())
    return 2


def _print_error(first: str, *others: str) -> None:
    lines = [" ".join(line.split()) for line in (f"optipath: {first}", *others)]
    with contextlib.suppress(OSError):  # There is nobody left to be told.
        click.echo(printable("\n".join(lines)), err=True)
