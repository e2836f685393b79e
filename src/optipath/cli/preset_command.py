"""Subcommands that take a preset, with an option for each of its parameters, and what they give."""

from __future__ import annotations

from contextlib import nullcontext, suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

import click

from optipath.cli.arguments import RANGES, axis_argument
from optipath.cli.console import JSON, say, say_json
from optipath.cli.options import StrictCommand, WholeHelp, flag, given_options
from optipath.composer.composer import CHOICES
from optipath.composer.path_values import Values
from optipath.errors import OptipathError, ParameterError, PresetError
from optipath.faults import Fault, listed, printable, shown, there_are
from optipath.kernels.catalog import METHODS
from optipath.materials.material import Material
from optipath.materials.named_materials import (
    WAVELENGTH,
    extinction_with,
    is_material,
    material_named,
    single_value,
)
from optipath.materials.quantities import READINGS
from optipath.paths.binding import from_materials
from optipath.paths.files.presets import (
    bound_preset,
    load_preset,
    preset_descriptions,
    preset_names,
)
from optipath.values.cases import ALL
from optipath.values.text import AxisValues, IdleValues
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use


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
        *,
        several: bool = False,
        ranges: bool = False,
        faults: Callable[..., Sequence[str]] = lambda **_: (),
        **keywords: Any,
    ) -> None:
        usual = {"callback": _refuse_none, "subcommand_metavar": "PRESET [OPTIONS]"}
        keywords = {**usual, "help": action.__doc__, **keywords}
        super().__init__(name, invoke_without_command=True, **keywords)
        self.action, self.several = action, several
        self.options, self.ranges, self.faults = tuple(options), ranges, faults

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the presets."""
        del ctx
        return preset_names()

    def short_helps(self, ctx: click.Context) -> dict[str, str]:
        """Return what each preset is, none of which is made."""
        del ctx
        return {name: printable(about) for name, about in preset_descriptions().items()}

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Return the command of a preset; None while a shell completes words and it is faulty."""
        with suppress(OptipathError) if ctx.resilient_parsing else nullcontext():
            return self._command_of(cmd_name)
        return None

    def _command_of(self, cmd_name: str) -> click.Command:
        """Return the command of a preset, with its parameters as options."""
        path, command = load_preset(cmd_name), self.name or ""
        names = {option.name or "" for option in self.options}
        flags = {each.lstrip("-") for option in self.options for each in option.opts}
        own = {*path.parameters, *path.choices}
        if taken := sorted(own & {*names, *flags, "case", "help", "h"}):
            raise PresetError(
                f"parameter '{taken[0]}' of '{cmd_name}' has the name of an option; rename it there"
            )

        def callback(*, cases: tuple[str, ...], **texts: Any) -> None:
            options = {name: texts.pop(name) for name in names}
            if not self.several:
                one_case(command, path, cases)
            chosen = chosen_by(cmd_name, path, cases, texts, self.faults(**options))
            if not self.ranges and chosen[0].axes:
                raise ParameterError(
                    *[
                        f"{flag(name)} is given several values, {shown(texts[name])}; give one, or "
                        f"write 'optipath run' or 'optipath sweep'"
                        for name in chosen[0].axes
                    ]
                )
            self.action(chosen if self.several else chosen[0], **options)

        several = "; may be given several times, or all" if self.several and path.cases else ""
        known = printable(", ".join(path.cases)) or "none in this preset"
        case = click.Option(
            ["--case", "cases"],
            metavar="NAME",
            multiple=True,
            help=f"Named set of values: {known}{several}.",
        )
        parameters = [each for each in path.parameters.values() if not each.bound]
        if WAVELENGTH.name not in own | names:
            parameters.append(WAVELENGTH)
        of_path = [
            _option(one.name, _metavar(one), one.help, one.all_words, one.default_text())
            for one in parameters
        ]
        of_path += [
            _option(name, "WORD", one.help, one.behind, one.place(path.graph))
            for name, one in path.choices.items()
        ]
        return StrictCommand(
            cmd_name,
            callback=callback,
            params=[*of_path, case, *self.options],
            help=printable(path.description),
            epilog=RANGES if self.ranges else None,
        )

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command of a preset, by a name that help may print."""
        name, command, rest = super().resolve_command(ctx, args)
        return printable(name or ""), command, rest


def _metavar(parameter: Parameter) -> str:
    if isinstance(parameter, Wavelength):  # In one of several kinds of units.
        return "'516 nm'"
    return (parameter.unit or "number").upper()


def _option(
    name: str, metavar: str, about: str, words: Collection[str], default: str
) -> click.Option:
    known = f"words: {', '.join(words)}" if words else ""
    described = printable("; ".join(filter(None, [about, known, f"[{default}]"])))
    return click.Option([flag(name), name], metavar=metavar, help=described)


def is_without_preset() -> bool:
    """Tell whether no preset is given; options then are in its place, and not before it."""
    given = given_options()
    if click.get_current_context().invoked_subcommand is None:
        return True
    if given:
        where = "stands behind the preset, or in its place; move it there, or leave it out"
        raise click.UsageError(f"{given[0]} {where}")
    return False


def no_preset() -> click.UsageError:
    """Return what is raised where no preset is given."""
    return click.UsageError(
        f"PRESET is missing; give a file or one of: {', '.join(preset_names())}"
    )


def _refuse_none() -> None:
    if click.get_current_context().invoked_subcommand is None:
        raise no_preset()


T = TypeVar("T")


@dataclass(frozen=True)
class Chosen:
    """What a command line is about."""

    preset: str
    opened: PathGraph
    case: str | None
    values: Mapping[str, Any]
    axes: Mapping[str, AxisValues] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """The preset and the case."""
        return self.preset + (f", case {self.case}" if self.case else "")

    @property
    def places(self) -> dict[str, str]:
        """The words that were given for choices of places, by name."""
        return {name: self.values[name] for name in self.opened.choices if name in self.values}

    def path(self, reads: Any = None, others: Collection[str] = ()) -> PathGraph:
        """Return the path, bound to single values, and with other readings if they are given."""
        varied = {*self.axes, *others}
        bound = bound_preset(self.opened, self.preset, self.case, self.values, varied)
        return bound if reads is None else bound.reading(reads)


class Cases(list[Chosen]):
    """What a command line is about, for each case that is asked for."""

    together = False
    """Whether several cases are asked for, or all there are."""

    def each(self, action: Callable[[Chosen], T]) -> dict[str, T]:
        """Return what an action makes of each case, by its name."""
        results: dict[str, T] = {}
        having: dict[Fault, list[str]] = {}
        faults: list[Fault] = []
        for chosen in self:
            case = chosen.case or ""
            try:
                results[case] = action(chosen)
            except OptipathError as error:
                for fault in error.faults:
                    having.setdefault(fault, []).append(case)
        for fault, of in having.items():
            where = "" if len(of) == len(self) else f"case{'s' * (len(of) > 1)} {listed(of)}"
            faults.append(fault.under(where))
        ParameterError.raise_for(faults)
        return results

    def say_json(self, results: Mapping[str, T], as_json: Callable[[T], dict[str, Any]]) -> None:
        """Print what was found of the case, or of all of them, as one JSON object."""
        cases = {case: as_json(one) for case, one in results.items()}
        found = {"cases": cases} if self.together else next(iter(cases.values()))
        say_json({"preset": self[0].preset, **found})


def chosen_by(
    preset: str,
    path: PathGraph,
    cases: Sequence[str],
    texts: Mapping[str, str | None],
    of_options: Sequence[str] = (),
) -> Cases:
    """Return what the options give, for each case that is asked for."""
    together = _is_several(cases)
    if ALL in cases:
        if not path.cases:
            raise ParameterError(f"preset '{preset}' has no cases; leave --case out")
        cases = list(path.cases)
    faults = [*of_options]
    arguments = {name: text for name, text in texts.items() if text is not None}
    uses = Values(path.graph).uses if arguments else ()
    values = {name: _value(path, name, arguments, uses, faults) for name in arguments}
    sound = {name: value for name, value in values.items() if value is not None}
    if not faults:
        for k in from_materials(path.graph, sound):
            sound.pop(k, None)
        _take_wavelength(preset, path, sound)
    elif WAVELENGTH.name not in path.parameters:
        sound.pop(WAVELENGTH.name, None)  # What it is for may be what is faulty.
    axes = {name: value for name, value in sound.items() if isinstance(value, AxisValues)}
    single = {name: value for name, value in sound.items() if name not in axes}
    several = dict.fromkeys(cases) or [None]
    results = Cases(Chosen(preset, path, case, single, axes) for case in several)
    results.together = together
    if faults or axes or len(results) > 1:
        with OptipathError.collecting(faults):
            results.each(Chosen.path)
    if faults:
        for name in filter(path.parameters.__contains__, axes):
            with OptipathError.collecting(faults):
                path.bind(**{name: axes[name].given})
        raise ParameterError(*dict.fromkeys(faults))
    return results


def _is_several(cases: Sequence[str]) -> bool:
    return len({*cases}) > 1 or ALL in cases


def one_case(command: str, path: PathGraph, cases: Sequence[str]) -> str | None:
    """Return the case that is asked for, of a command that can do with one."""
    if _is_several(cases):
        raise ParameterError(f"{command} takes one case{there_are([*path.cases])}")
    return cases[0] if cases else None


def _value(
    path: PathGraph,
    name: str,
    arguments: Mapping[str, str],
    uses: Sequence[Use],
    faults: list[str],
) -> Any:
    """Return what the text of an option stands for; None where it is faulty."""
    text = arguments[name]
    if name in path.choices:
        return text
    parameter = path.parameters.get(name, WAVELENGTH)
    with OptipathError.collecting(faults):
        if is_material(parameter, text, uses):
            other = extinction_with(uses, name)
            k = _value(path, other, arguments, uses, faults) if other in arguments else None
            if isinstance(k, AxisValues):
                faults.append(f"{flag(other)} takes one value beside {flag(name)} {text}; give one")
            elif k is not None:
                path.parameters[other].resolve(k)
            return None if faults else material_named(flag(name), text, k)
        if several := axis_argument(parameter, text, uses):
            return several
        # A bare number may be nanometres, micrometres or electronvolts.
        unit = "" if isinstance(parameter, Wavelength) else parameter.unit
        return single_value(parameter, text, uses, unit, flag)
    return None


def _take_wavelength(preset: str, path: PathGraph, values: dict[str, Any]) -> None:
    """Say where nothing depends on a wavelength; a single one is taken out of the values."""
    name = WAVELENGTH.name
    if name not in values or name in path.parameters:
        return
    media = {each: value for each, value in values.items() if isinstance(value, Material)}
    try:
        if name in path.bind(**media).parameters:
            return
    except OptipathError:
        return  # Which is told of the material.
    if isinstance(several := values[name], AxisValues):
        WAVELENGTH.resolve(several.given)
        values[name], message = IdleValues(*several), "all is the same along it"
    else:
        WAVELENGTH.resolve(values.pop(name))
        message = f"--{name} is not used"
    say(f"optipath: nothing in '{preset}' depends on the wavelength; {message}", err=True)
