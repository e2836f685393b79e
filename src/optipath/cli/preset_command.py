"""Subcommands that take a preset, with an option for each of its parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath.composer import CHOICES
from optipath.errors import OptipathError, ParameterError, PresetError, printable
from optipath.kernels import METHODS
from optipath.paths.presets.loader import load_preset, preset_names
from optipath.values.domains import READINGS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter

METHOD = click.Option(
    ["--method"],
    type=click.Choice(METHODS),
    default=METHODS[0],
    show_default=True,
    help="How Fresnel's equations are computed.",
)
MODEL = click.Option(
    ["--model"],
    type=click.Choice(CHOICES["model"]),
    default="auto",
    show_default=True,
    help="What is carried along; by default the smallest that is exact.",
)
TOLERANCE = click.Option(
    ["--tolerance"],
    type=float,
    help="How large the error of an intensity may be, such as 0.01; exact by default.",
)
READS = click.Option(
    ["--reads"],
    type=click.Choice(READINGS),
    help="What all detectors read, in place of what the preset says.",
)
JSON = click.Option(["--json", "as_json"], is_flag=True, help="Print one JSON object.")


class PresetGroup(click.Group):
    """A group whose subcommands are the presets, and files of the user's own.

    Parameters
    ----------
    action : callable
        ``action(preset, case, values, **options)``.
    options : sequence of click.Option, optional
        What can be given besides the parameters and the case.
    """

    def __init__(
        self,
        name: str,
        action: Callable[..., None],
        options: Sequence[click.Option] = (METHOD, MODEL, TOLERANCE, READS, JSON),
        **keywords: Any,
    ) -> None:
        keywords.setdefault("subcommand_metavar", "PRESET [OPTIONS]")
        super().__init__(name, **keywords)
        self.action = action
        self.options = tuple(options)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Refuse a command without a preset."""
        if not args and not ctx.resilient_parsing and not self.invoke_without_command:
            names = ", ".join(preset_names())
            raise click.UsageError(f"PRESET is missing; give a file or one of: {names}")
        return super().parse_args(ctx, args)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the presets."""
        del ctx
        return preset_names()

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        """Return the command of a preset, with its parameters as options."""
        del ctx
        path = load_preset(cmd_name)
        taken = sorted(set(path.parameters) & self._reserved())
        if taken:
            raise PresetError(
                f"parameter '{taken[0]}' of '{cmd_name}' has the name of an option of the "
                f"command line; rename it in the file"
            )

        names = {option.name for option in self.options}

        def callback(*, case: str | None, **given: Any) -> None:
            texts = {name: text for name, text in given.items() if name not in names}
            chosen = {name: value for name, value in given.items() if name in names}
            self.action(cmd_name, case, _parsed(path, cmd_name, case, texts), **chosen)

        options: list[click.Parameter] = [
            _option(parameter) for parameter in path.parameters.values() if not parameter.bound
        ]
        cases = printable(", ".join(path.cases)) or "none in this preset"
        help_ = f"Named set of values: {cases}."
        options += [click.Option(["--case"], metavar="NAME", help=help_), *self.options]
        return click.Command(
            cmd_name,
            callback=callback,
            params=options,
            help=printable(path.description),
        )

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command of a preset, by a name that help may print."""
        name, command, rest = super().resolve_command(ctx, args)
        return printable(name or ""), command, rest

    def _reserved(self) -> set[str]:
        flags = {flag.lstrip("-") for option in self.options for flag in option.opts}
        names = {option.name or "" for option in self.options}
        return flags | names | {"case", "help", "h"}


def _parsed(
    path: PathGraph, preset: str, case: str | None, texts: dict[str, str | None]
) -> dict[str, Any]:
    """Return the values that the options give; all that is wrong with them at once."""
    values: dict[str, Any] = {}
    faults: list[str] = []
    for name, text in texts.items():
        if text is None:
            continue
        parameter = path.parameters[name]
        try:
            values[name] = parameter.parse(text, parameter.unit)
        except OptipathError as error:
            faults += error.faults
    if faults:
        try:
            load_preset(preset, case=case, **values)
        except OptipathError as error:
            faults += error.faults
        raise ParameterError(*faults)
    return values


def _option(parameter: Parameter) -> click.Option:
    words = f"words: {', '.join(parameter.all_words)}" if parameter.all_words else ""
    hints = [parameter.help, words, f"[{parameter.default_text()}]"]
    flag = "--" + parameter.name.replace("_", "-")
    return click.Option(
        [flag, parameter.name],
        metavar=(parameter.unit or "number").upper(),
        help=printable("; ".join(h for h in hints if h)),
    )
