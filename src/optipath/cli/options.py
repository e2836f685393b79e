"""Options of commands: unknown ones, words that are left over, help texts."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from optipath.faults import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


def flag(name: str) -> str:
    """Return the option of a parameter.

    >>> flag("sky_angle"), parameter_name(" --sky-angle")
    ('--sky-angle', 'sky_angle')
    """
    return f"--{name.replace('_', '-')}"


def parameter_name(option: str) -> str:
    """Return the parameter of an option, with hyphens before and within it or without."""
    return option.strip().lstrip("-").replace("-", "_")


def completed_by(names: Callable[[], Iterable[str]]) -> Callable[..., list[str]]:
    """Return what completes a word in shells to one of some names."""
    return lambda _context, _parameter, begun: [name for name in names() if name.startswith(begun)]


def given_options() -> list[str]:
    """Return the options that stand on the command line, without their values."""
    context = click.get_current_context()
    return [
        one.opts[0]
        for one in context.command.params
        if isinstance(one, click.Option)
        and context.get_parameter_source(one.name or "") is not ParameterSource.DEFAULT
    ]


class StrictCommand(click.Command):
    """A command that says what was meant by words for which there is no place."""

    allow_extra_args = True

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the options; refuse what is left, and what is given again."""
        words = list(args)
        left = super().parse_args(ctx, args)
        if ctx.resilient_parsing:
            return left
        # Of the values of an option that takes one, click keeps the last alone.
        _, _, order = self.make_parser(ctx).parse_args(words)
        for one, count in Counter(order).items():
            is_single = isinstance(one, click.Option) and not (one.multiple or one.is_flag)
            if is_single and count > 1:
                raise click.UsageError(f"{one.opts[0]} is given {count} times; give it once")
        if left:
            raise click.UsageError(
                f"'{left[0]}' belongs to no option; leave it out, or quote words: '30 deg'"
            )
        return left


def unknown_option(error: click.NoSuchOption) -> str:
    """Return what is said of an unknown option, with the one that was meant."""
    meant = ""
    if (context := error.ctx) is not None:
        options = context.command.get_params(context)
        flags = [flag for one in options for flag in sorted(one.opts) if flag.startswith("-")]
        meant = did_you_mean(error.option_name, flags)
        if isinstance(context.command, click.Group) and "did you mean" not in meant:
            meant = "; options of a command stand behind its name, those of a preset behind that"
    return f"option '{error.option_name}' is unknown{meant}"


class WholeHelp(click.Group):
    """A group of commands whose help cuts no sentence short, whatever the terminal."""

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write a line for each subcommand, which goes on in the next where it is long."""
        with formatter.section("Commands"):
            formatter.write_dl([*self.short_helps(ctx).items()])

    def short_helps(self, ctx: click.Context) -> dict[str, str]:
        """Return what help says of each subcommand."""
        commands = {name: self.get_command(ctx, name) for name in self.list_commands(ctx)}
        return {n: c.get_short_help_str(1000) for n, c in commands.items() if c is not None}
