"""Subcommands that take a preset, with an option for each of its parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath.cli.arguments import RANGES, refuse_axes
from optipath.cli.chosen import asks_for_several, cases_of, chosen_by, one_case
from optipath.cli.console import JSON
from optipath.cli.options import StrictCommand, WholeHelp, flag
from optipath.composer.composer import CHOICES
from optipath.errors import PresetError, printable
from optipath.kernels.catalog import METHODS
from optipath.materials.named_materials import WAVELENGTH
from optipath.materials.quantities import READINGS
from optipath.paths.files.presets import load_preset, preset_names
from optipath.values.cases import ALL
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.paths.place_choice import PlaceChoice
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

COMPOSING = (METHOD, MODEL, TOLERANCE, READS, JSON)
"""What can be given to commands that compose and run."""


class PresetGroup(WholeHelp):
    """A group whose subcommands are the presets, and files of the user's own."""

    def __init__(
        self,
        name: str,
        action: Callable[..., None],
        options: Sequence[click.Option] = COMPOSING,
        several: Callable[..., None] | None = None,
        *,
        ranges: bool = False,
        faults: Callable[..., Sequence[str]] | None = None,
        **keywords: Any,
    ) -> None:
        usual = {"callback": _refuse_none, "subcommand_metavar": "PRESET [OPTIONS]"}
        keywords = {**usual, "help": action.__doc__, **keywords}
        super().__init__(name, invoke_without_command=True, **keywords)
        self.action = action
        self.options = tuple(options)
        self.several = several
        self.ranges = ranges
        self.faults = faults or (lambda **_: ())

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the presets."""
        del ctx
        return preset_names()

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        """Return the command of a preset, with its parameters as options."""
        del ctx
        path = load_preset(cmd_name)
        parameters = path.parameters
        names = {option.name or "" for option in self.options}
        flags = {each.lstrip("-") for option in self.options for each in option.opts}
        if taken := sorted({*parameters, *path.choices} & {*names, *flags, "case", "help", "h"}):
            raise PresetError(
                f"parameter '{taken[0]}' of '{cmd_name}' has the name of an option of the "
                f"command line; rename it in the file"
            )

        def callback(*, cases: tuple[str, ...], **argument: Any) -> None:
            options = {name: argument.pop(name) for name in names}
            if self.several is None:
                one_case(self.name or "", path, cases)
            request = cases_of(cmd_name, path, cases)
            chosen = chosen_by(cmd_name, path, request, argument, self.faults(**options))
            if not self.ranges:
                refuse_axes(self.name or "", argument, chosen[0].axes)
            if self.several is not None and asks_for_several(cases):
                self.several(chosen, **options)
            else:
                self.action(chosen[0], **options)

        case = case_option(path, several=self.several is not None)
        options = [_option(parameter) for parameter in parameters.values() if not parameter.bound]
        if WAVELENGTH.name not in {*parameters, *path.choices, *names}:
            options.append(_option(WAVELENGTH))
        options += [_place(name, choice, path) for name, choice in path.choices.items()]
        return StrictCommand(
            cmd_name,
            callback=callback,
            params=[*options, case, *self.options],
            help=printable(path.description),
            epilog=RANGES if self.ranges else None,
        )

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command of a preset, by a name that help may print."""
        name, command, rest = super().resolve_command(ctx, args)
        return printable(name or ""), command, rest


def case_option(path: PathGraph, *, several: bool) -> click.Option:
    """Return the option of the cases of a path."""
    cases = printable(", ".join(path.cases))
    more = f"; may be given several times, or {ALL}" if several and cases else ""
    message = f"Named set of values: {cases or 'none in this preset'}{more}."
    return click.Option(["--case", "cases"], metavar="NAME", multiple=True, help=message)


def no_preset() -> click.UsageError:
    """Return what is raised where no preset is given."""
    return click.UsageError(
        f"PRESET is missing; give a file or one of: {', '.join(preset_names())}"
    )


def _refuse_none() -> None:
    if click.get_current_context().invoked_subcommand is None:
        raise no_preset()


def _option(parameter: Parameter) -> click.Option:
    words = f"words: {', '.join(parameter.all_words)}" if parameter.all_words else ""
    hints = [parameter.help, words, f"[{parameter.default_text()}]"]
    of_light = isinstance(parameter, Wavelength)  # In one of several kinds of units.
    return click.Option(
        [flag(parameter.name), parameter.name],
        multiple=True,
        metavar="'516 nm'" if of_light else (parameter.unit or "number").upper(),
        help=printable("; ".join(h for h in hints if h)),
    )


def _place(name: str, choice: PlaceChoice, path: PathGraph) -> click.Option:
    hints = [choice.help, f"words: {', '.join(choice.behind)}", f"[{choice.place(path.graph)}]"]
    described = printable("; ".join(hint for hint in hints if hint))
    return click.Option([flag(name), name], multiple=True, metavar="WORD", help=described)
