"""Subcommands that take a preset, with an option for each of its parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from optipath.composer.composer import CHOICES
from optipath.errors import OptipathError, ParameterError, PresetError, printable
from optipath.kernels.catalogue import METHODS
from optipath.paths.presets.loader import load_preset, preset_names, with_values
from optipath.values.domains.quantities import READINGS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter

METHOD = click.Option(
    ["--method"],
    type=click.Choice(METHODS),
    default=METHODS[0],
    help="How Fresnel's equations are computed.",
)
MODEL = click.Option(
    ["--model"],
    type=click.Choice(CHOICES["model"]),
    default="auto",
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


@dataclass(frozen=True)
class Chosen:
    """What a command line is about.

    Attributes
    ----------
    preset : str
        The name of a preset, or a file.
    opened : PathGraph
        The path that it describes, which is read once.
    case : str, optional
        A named set of its values.
    values : mapping of str to Any
        Values that take precedence over the case.
    """

    preset: str
    opened: PathGraph
    case: str | None
    values: Mapping[str, Any]

    @property
    def title(self) -> str:
        """The preset and the case."""
        return self.preset + (f", case {self.case}" if self.case else "")

    def path(self, reads: str | None = None) -> PathGraph:
        """Return the path, bound to what is given, and with other readings if they are."""
        bound = with_values(self.opened, self.preset, self.case, self.values)
        return bound if reads is None else bound.reading(reads)


class PresetGroup(click.Group):
    """A group whose subcommands are the presets, and files of the user's own.

    Parameters
    ----------
    name : str
        Its name.
    action : callable
        ``action(chosen, **options)``; its docstring is the help of the group.
    options : sequence of click.Option, optional
        What can be given besides the parameters and the case.
    **keywords : Any
        As `click.Group` takes them.
    """

    def __init__(
        self,
        name: str,
        action: Callable[..., None],
        options: Sequence[click.Option] = (METHOD, MODEL, TOLERANCE, READS, JSON),
        **keywords: Any,
    ) -> None:
        usual = {"callback": _refuse_none, "subcommand_metavar": "PRESET [OPTIONS]"}
        keywords = {**usual, "help": action.__doc__, **keywords}
        super().__init__(name, invoke_without_command=True, **keywords)
        self.action = action
        self.options = tuple(options)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the presets."""
        del ctx
        return preset_names()

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        """Return the command of a preset, with its parameters as options.

        Parameters
        ----------
        ctx : click.Context
            Of the group.
        cmd_name : str
            The preset.

        Returns
        -------
        click.Command
            What calls the action.
        """
        del ctx
        path = load_preset(cmd_name)
        parameters = path.parameters
        names = {option.name or "" for option in self.options}
        flags = {flag.lstrip("-") for option in self.options for flag in option.opts}
        if taken := sorted(parameters.keys() & {*names, *flags, "case", "help", "h"}):
            raise PresetError(
                f"parameter '{taken[0]}' of '{cmd_name}' has the name of an option of the "
                f"command line; rename it in the file"
            )

        def callback(*, case: str | None, **given: Any) -> None:
            options = {name: given.pop(name) for name in names}
            self.action(_chosen(cmd_name, path, case, given), **options)

        cases = printable(", ".join(path.cases)) or "none in this preset"
        case = click.Option(["--case"], metavar="NAME", help=f"Named set of values: {cases}.")
        options = [_option(parameter) for parameter in parameters.values() if not parameter.bound]
        return click.Command(
            cmd_name,
            callback=callback,
            params=[*options, case, *self.options],
            help=printable(path.description),
        )

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command of a preset, by a name that help may print.

        Parameters
        ----------
        ctx, args
            As `click.Group` takes them.

        Returns
        -------
        tuple
            The name, the command, and the arguments behind it.
        """
        name, command, rest = super().resolve_command(ctx, args)
        return printable(name or ""), command, rest


def _refuse_none() -> None:
    if click.get_current_context().invoked_subcommand is None:
        names = ", ".join(preset_names())
        raise click.UsageError(f"PRESET is missing; give a file or one of: {names}")


def _chosen(
    preset: str, path: PathGraph, case: str | None, texts: Mapping[str, str | None]
) -> Chosen:
    """Return what the options give; all that is wrong with them at once."""
    parameters = path.parameters
    values: dict[str, Any] = {}
    faults: list[str] = []
    for name, text in texts.items():
        if text is None:
            continue
        try:
            values[name] = parameters[name].parse(text, parameters[name].unit)
        except OptipathError as error:
            faults += error.faults
    chosen = Chosen(preset, path, case, values)
    if faults:
        try:
            chosen.path()
        except OptipathError as error:
            faults += error.faults
        raise ParameterError(*faults)
    return chosen


def _option(parameter: Parameter) -> click.Option:
    words = f"words: {', '.join(parameter.all_words)}" if parameter.all_words else ""
    hints = [parameter.help, words, f"[{parameter.default_text()}]"]
    flag = "--" + parameter.name.replace("_", "-")
    return click.Option(
        [flag, parameter.name],
        metavar=(parameter.unit or "number").upper(),
        help=printable("; ".join(h for h in hints if h)),
    )
