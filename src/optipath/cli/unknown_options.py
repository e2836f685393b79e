"""Options that a command does not have: misspelt ones, and those of another on the same line."""

from __future__ import annotations

import shlex
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

import click

from optipath.errors import OptipathError, did_you_mean
from optipath.spelling import closest

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


@contextmanager
def unknown_options_told(context: click.Context, words: Sequence[str]) -> Iterator[None]:
    """Let what is said of an unknown option name what was meant, and where it stands."""
    try:
        yield
    except click.NoSuchOption as error:
        # Of "-delta" click knows no more than "-d".
        whole = [word for word in words if word.startswith(error.option_name)]
        name = whole[0].partition("=")[0] if whole else error.option_name
        raise click.UsageError(_told(name, words, context), context) from None


def refuse_outer_options(context: click.Context, words: Sequence[str]) -> None:
    """Raise where an option of a command stands behind that of its subcommand."""
    for word in words:
        name = word.partition("=")[0]
        if name not in _flags(context.command, context) and (
            line := _outer_line(name, words, context)
        ):
            raise click.UsageError(f"option '{name}' is unknown here; {line}", context)


def _told(name: str, words: Sequence[str], context: click.Context) -> str:
    if line := _outer_line(name, words, context):
        return f"option '{name}' is unknown here; {line}"
    flags = _flags(context.command, context)
    if closest(name, flags) is None and (line := _inner_line(name, words, context)):
        return f"option '{name}' is unknown here; {line}"
    return f"option '{name}' is unknown{did_you_mean(name, flags)}"


def _outer_line(name: str, words: Sequence[str], context: click.Context) -> str:
    """Return how an option is written that a command further to the left has; else nothing."""
    inner: list[str] = []
    outer = context
    while outer.parent is not None:
        inner, outer = [outer.info_name or "", *inner], outer.parent
        option = next((one for one in _options(outer.command, outer) if name in one.opts), None)
        if option is None:
            continue
        at = next((i for i, word in enumerate(words) if word.partition("=")[0] == name), 0)
        taken = 1 if option.is_flag or "=" in words[at] else 2
        moved = [*words[at : at + taken]]
        moved += [option.metavar or "VALUE"] if len(moved) < taken else []
        if outer.parent is not None or option.is_eager:
            return f"it stands alone: {shlex.join([*outer.command_path.split(), *moved])}"
        rest = [*words[:at], *words[at + taken :]]
        line = shlex.join([outer.command_path, *moved, *inner, *rest])
        return f"write it before the command: {line}"
    return ""


def _inner_line(name: str, words: Sequence[str], context: click.Context) -> str:
    """Return how an option is written that a command further to the right has; else nothing."""
    command, path = context.command, context.command_path
    for word in words:
        found = None
        if isinstance(command, click.Group) and not word.startswith("-"):
            with suppress(OptipathError):  # No preset, but what an option takes, perhaps.
                found = command.get_command(context, word)
        if found is not None:
            command, path = found, f"{path} {word}"
    if isinstance(command, click.Group):
        # Of a preset that is not there, or cannot be read, a parameter may have any name.
        first = command.subcommand_metavar.partition(" ")[0].strip("[]")
        known = command is not context.find_root().command and name.startswith("--")
        return f"write it at the end: {path} {first} {name} ..." if known else ""
    flags = _flags(command, context)
    meant = name if name in flags else closest(name, flags)
    return f"write it at the end: {path} {meant} ..." if meant else ""


def _options(command: click.Command, context: click.Context) -> list[click.Option]:
    return [one for one in command.get_params(context) if isinstance(one, click.Option)]


def _flags(command: click.Command, context: click.Context) -> list[str]:
    return [flag for one in _options(command, context) for flag in sorted(one.opts)]
