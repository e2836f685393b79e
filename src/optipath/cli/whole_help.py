"""Groups of commands: whole sentences in help, and options that are told where they belong."""

from __future__ import annotations

import click

from optipath.cli.unknown_options import unknown_options_told

_LONGEST = 1000
"""No line of help is longer, whatever the terminal."""


class WholeHelp(click.Group):
    """A group of commands whose help cuts no sentence short."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the options of the group; say of others what was meant."""
        with unknown_options_told(ctx, [*args]):
            return super().parse_args(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write a line for each subcommand, which goes on in the next where it is long."""
        commands = {name: self.get_command(ctx, name) for name in self.list_commands(ctx)}
        rows = [(n, c.get_short_help_str(_LONGEST)) for n, c in commands.items() if c is not None]
        if rows:
            with formatter.section("Commands"):
                formatter.write_dl(rows)
