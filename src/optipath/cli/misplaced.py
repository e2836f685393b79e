"""Words of a command line that stand where nothing takes them."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

import click

from optipath.cli.unknown_options import unknown_options_told

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_DASHES = "-\u2010\u2011\u2012\u2013\u2014\u2212"
"""What a text that is pasted may have in place of the hyphen: other hyphens, dashes, a minus."""


class StrictCommand(click.Command):
    """A command that says what words were meant for which there is no place, or more than one."""

    allow_extra_args = True

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the options; refuse what is left."""
        words = list(args)
        with unknown_options_told(ctx, words):
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
    # Not for every start of the command.
    from optipath.values.unit_names import usual_name  # noqa: PLC0415
    from optipath.values.units import UNITS  # noqa: PLC0415

    at = words.index(word)
    flag, value = ("", "", *words[:at])[-2:]
    name, _, given = word.partition("=")
    if (meant := f"--{name.lstrip(_DASHES)}") in flags:
        behind = [one for one in words[at + 1 : at + 2] if not one.startswith("--")]
        given = "" if flags[meant] else shlex.quote(given or "".join(behind) or "VALUE")
        return f"'{word}' is no option; write {meant} {given}".rstrip()
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
