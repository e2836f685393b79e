"""Words of a command line that stand where nothing takes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from optipath.errors import did_you_mean
from optipath.spelling import closest

if TYPE_CHECKING:
    from collections.abc import Sequence


class StrictCommand(click.Command):
    """A command that says what words were meant for which there is no place."""

    allow_extra_args = True

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the options; refuse what is left.

        Parameters
        ----------
        ctx, args
            As `click.Command` takes them.

        Returns
        -------
        list of str
            Nothing.
        """
        words = list(args)
        try:
            left = super().parse_args(ctx, args)
        except click.NoSuchOption as error:
            # Of "-delta" click knows no more than "-d".
            whole = [word for word in words if word.startswith(error.option_name)]
            if not whole:
                raise
            name, known = whole[0].partition("=")[0], error.possibilities
            raise click.NoSuchOption(name, possibilities=known, ctx=ctx) from None
        if left and not ctx.resilient_parsing:
            raise click.UsageError(_left_over(left[0], words), ctx)
        return left


def meant_by(error: click.NoSuchOption) -> str:
    """Return the option that was meant, where it should stand, or all that there are."""
    context = error.ctx
    if context is None:
        return ""
    options = [one for one in context.command.get_params(context) if isinstance(one, click.Option)]
    flags = [one.opts[-1] for one in options]
    if isinstance(context.command, click.Group) and closest(error.option_name, flags) is None:
        first = context.command.subcommand_metavar.partition(" ")[0].strip("[]")
        return f" here; write it at the end: {context.command_path} {first} {error.option_name} ..."
    return did_you_mean(error.option_name, flags)


def _left_over(word: str, words: Sequence[str]) -> str:
    """Say what is wrong with a word that no option takes."""
    # Not for every start of the command.
    from optipath.values.unit_names import usual_name  # noqa: PLC0415
    from optipath.values.units import UNITS  # noqa: PLC0415

    at = words.index(word)
    flag, value = ("", "", *words[:at])[-2:]
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
