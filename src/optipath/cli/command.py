"""The command ``optipath``: its subcommands, and how errors end it."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import sys
import warnings
from contextlib import contextmanager, redirect_stdout
from importlib import import_module, invalidate_caches
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click
from click.shell_completion import shell_complete

from optipath.cli.interruption import INTERRUPTED, stop
from optipath.cli.options import WholeHelp, unknown_option
from optipath.errors import (
    AngleWarning,
    LoopWarning,
    MeshWarning,
    OptipathError,
    PathError,
    PhotonWarning,
    StoreWarning,
)
from optipath.extras import needing
from optipath.faults import Fault, did_you_mean, printable, shown

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


_COMMANDS = {
    "accuracy": "bench",
    "bench": "bench",
    "cache": "cache",
    "chart": "chart",
    "explain": "run",
    "explore": "explore",
    "materials": "materials",
    "plot": "plot",
    "polarization": "polarization",
    "presets": "presets",
    "run": "run",
    "show": "show",
    "surface": "surface",
    "sweep": "sweep",
}
"""Which file each command is in."""


class _Commands(WholeHelp):
    """The subcommands, each imported when it is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        del ctx
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        del ctx
        if cmd_name not in _COMMANDS:
            return None
        module = import_module(f"optipath.cli.{_COMMANDS[cmd_name]}_command")
        command: click.Command = getattr(module, cmd_name)
        return command

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
        return _refuse(OptipathError("the output cannot be written: standard output is closed"))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("always", LoopWarning)
            warnings.simplefilter("ignore", AngleWarning)  # All angles are texts with units.
            for once in (MeshWarning, PhotonWarning, StoreWarning):  # The same of each surface.
                warnings.simplefilter("default", once)
            warnings.showwarning = _tell  # type: ignore[assignment] # all that it is given
            with needing("some options"):
                _invoke(arguments)
        sys.stdout.flush()
    except click.NoSuchOption as error:
        return _refuse(OptipathError(unknown_option(error)))
    except click.ClickException as error:
        return _refuse(OptipathError(error.format_message()))
    except OptipathError as error:
        return _refuse(error)
    except MemoryError:
        why = "the memory of this machine does not suffice"
        return _refuse(OptipathError(Fault(why, "run fewer paths at once")))
    except BrokenPipeError:
        _forget_output()  # Whoever read it has seen enough.
    except OSError as error:
        _forget_output()
        return _refuse(OptipathError(f"the output cannot be written: {error.strerror or error}"))
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
    fault = Fault.of(message if isinstance(message, str) else message.args[0])
    _print_error(fault.written("command"))


def _forget_output() -> None:
    # Otherwise Python tries once more at exit, and complains.
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _refuse(error: OptipathError) -> int:
    """Tell what is wrong: one fault on the one line, several on a line each."""
    _print_error(*error.written("command").splitlines())
    return 2


def _print_error(first: str, *others: str) -> None:
    lines = [" ".join(line.split()) for line in (f"optipath: {first}", *others)]
    with contextlib.suppress(OSError):  # There is nobody left to be told.
        click.echo(printable("\n".join(lines)), err=True)


@contextmanager
def interruptible() -> Iterator[None]:
    """Let Ctrl-C raise KeyboardInterrupt inside, and a request to terminate SystemExit."""
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


def _unraisable(missing: sys.UnraisableHookArgs) -> None:
    # Compiled code that calls Python back, such as LLVM, would go on.
    if missing.exc_type in (KeyboardInterrupt, SystemExit):
        stop()
    sys.__unraisablehook__(missing)


def import_own(name: str) -> None:
    """Import a module by its name, from this folder or Python's path, or a file of Python."""
    file = Path(name)
    is_file = file.suffix == ".py"
    module = file.stem if is_file else name
    unknown = PathError(
        f"--import takes a module in this folder or on Python's path, or a file that ends in .py, "
        f"and {shown(name)} is neither; look at its name"
    )
    taken = PathError(
        f"--import: a module named {shown(module)} is there already; rename {shown(name)}"
    )
    if not (file.is_file() if is_file else all(map(str.isidentifier, name.split(".")))):
        raise unknown
    if is_file and module in sys.stdlib_module_names:  # Python would import the file for its own.
        raise taken
    folder = str((file.parent if is_file else Path()).resolve())
    sys.path.insert(0, folder)
    invalidate_caches()
    try:
        # What it prints is no part of what the command finds, which may be read as JSON.
        with redirect_stdout(sys.stderr):
            imported = import_module(module)
    except (MemoryError, OptipathError):
        raise
    except (Exception, SystemExit) as error:
        if isinstance(error, ModuleNotFoundError) and error.name in (name, name.partition(".")[0]):
            raise unknown from error
        fault = f"--import: {shown(name)} raises {type(error).__name__}: {error}"
        raise PathError(fault) from error
    finally:
        if folder in sys.path:
            sys.path.remove(folder)
    if is_file and getattr(imported, "__file__", None) != str(file.resolve()):
        raise taken
