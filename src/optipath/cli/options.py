"""Options of commands: unknown and misplaced ones, help texts."""

from __future__ import annotations

import shlex
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

import click

from optipath.errors import OptipathError, closest, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence


_DASHES = "-\u2010\u2011\u2012\u2013\u2014\u2212"
"""What a text that is pasted may have in place of the hyphen: other hyphens, dashes, a minus."""


class StrictCommand(click.Command):
    """A command that says what words were meant for which there is no place, or more than one."""

    allow_extra_args = True

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the options; refuse what is left."""
        words = list(args)
        with unknown_options_reported(ctx, words):
            left = super().parse_args(ctx, args)
        if ctx.resilient_parsing:
            return left
        if repeated := self._repeated(ctx, words):
            raise click.UsageError("; ".join(repeated), ctx)
        if left:
            options = [one for one in self.get_params(ctx) if isinstance(one, click.Option)]
            flags = {flag: one.is_flag for one in options for flag in one.opts}
            raise click.UsageError(_left_over(left[0], words, flags), ctx)
        return left

    def _repeated(self, ctx: click.Context, words: Sequence[str]) -> list[str]:
        """Say which options are given several times that take one value."""
        # Of the values click keeps the last alone.
        _, _, order = self.make_parser(ctx).parse_args([*words])
        return [
            f"{one.opts[0]} is given {order.count(one)} times; give it once"
            for one in dict.fromkeys(order)
            if isinstance(one, click.Option) and not (one.multiple or one.is_flag or one.count)
            if order.count(one) > 1
        ]


def _left_over(word: str, words: Sequence[str], flags: Mapping[str, bool]) -> str:
    """Say what is wrong with a word that no option takes; of each is known if it takes none."""
    from optipath.values.units import UNITS, usual_name  # noqa: PLC0415 - not for every start

    at = words.index(word)
    flag, value = ("", "", *words[:at])[-2:]
    name, _, argument = word.partition("=")
    if (meant := f"--{name.lstrip(_DASHES)}") in flags:
        behind = [one for one in words[at + 1 : at + 2] if not one.startswith("--")]
        argument = "" if flags[meant] else shlex.quote(argument or "".join(behind) or "VALUE")
        return f"'{word}' is no option; write {meant} {argument}".rstrip()
    if value.startswith("--") and value.endswith("="):
        return f"'{word}' is cut off from {value}; write {value[:-1]} {shlex.quote(word)}"
    if value.startswith("--") and "=" in value:
        flag, _, value = value.partition("=")
    if flag == "--case":
        return (
            f"'{word}' belongs to no option; give each case its own: {flag} {value} {flag} {word}"
        )
    if flag.startswith("--") and usual_name(word) in UNITS:
        return (
            f"'{word}' is cut off from its number; quote them: {flag} '{value} {usual_name(word)}'"
        )
    return f"'{word}' belongs to no option; leave it out, or quote words with spaces between"


@contextmanager
def unknown_options_reported(context: click.Context, words: Sequence[str]) -> Iterator[None]:
    """Let what is said of an unknown option name what was meant, and where it stands."""
    try:
        yield
    except click.NoSuchOption as error:
        # Of "-delta" click knows no more than "-d".
        whole = [word for word in words if word.startswith(error.option_name)]
        name = whole[0].partition("=")[0] if whole else error.option_name
        raise click.UsageError(_option_fault(name, words, context), context) from None


def refuse_outer_options(context: click.Context, words: Sequence[str]) -> None:
    """Raise where an option of a command stands behind that of its subcommand."""
    for word in words:
        name = word.partition("=")[0]
        if name not in _flags(context.command, context) and (
            line := _outer_line(name, words, context)
        ):
            raise click.UsageError(f"option '{name}' is unknown here; {line}", context)


def _option_fault(name: str, words: Sequence[str], context: click.Context) -> str:
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
        result = None
        if isinstance(command, click.Group) and not word.startswith("-"):
            with suppress(OptipathError):  # No preset, but what an option takes, perhaps.
                result = command.get_command(context, word)
        if result is not None:
            command, path = result, f"{path} {word}"
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


_LONGEST = 1000
"""No line of help is longer, whatever the terminal."""


class WholeHelp(click.Group):
    """A group of commands whose help cuts no sentence short."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the options of the group; say of others what was meant."""
        with unknown_options_reported(ctx, [*args]):
            return super().parse_args(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write a line for each subcommand, which goes on in the next where it is long."""
        commands = {name: self.get_command(ctx, name) for name in self.list_commands(ctx)}
        rows = [(n, c.get_short_help_str(_LONGEST)) for n, c in commands.items() if c is not None]
        if rows:
            with formatter.section("Commands"):
                formatter.write_dl(rows)
