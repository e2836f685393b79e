"""Chosen path: the preset, case and values of a command line."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

import click

from optipath.cli.arguments import axis_argument, axis_faults
from optipath.cli.options import flag
from optipath.composer.path_values import Values
from optipath.errors import (
    Fault,
    OptipathError,
    ParameterError,
    collecting,
    listed,
    printable,
    shown,
    there_are,
)
from optipath.materials.material import Material
from optipath.materials.named_materials import (
    WAVELENGTH,
    extinction_with,
    is_material,
    material_named,
    single_value,
    take_extinctions,
)
from optipath.paths.files.presets import bound_preset
from optipath.values.cases import ALL
from optipath.values.text import AxisValues, IdleValues
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    from optipath.paths.path_graph import PathGraph
    from optipath.values.use import Use


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

    def path(self, reads: str | None = None, others: Collection[str] = ()) -> PathGraph:
        """Return the path, bound to single values, and with other readings if they are given."""
        varied = {*self.axes, *others}
        bound = bound_preset(self.opened, self.preset, self.case, self.values, varied)
        return bound if reads is None else bound.reading(reads)


def chosen_by(
    preset: str,
    path: PathGraph,
    cases: Sequence[str],
    texts: Mapping[str, Sequence[str]],
    of_options: Sequence[str] = (),
) -> list[Chosen]:
    """Return what the options give, for each case that is asked for."""
    faults = [*of_options]
    arguments = {name: several[-1] for name, several in texts.items() if several}
    faults += [
        f"{flag(name)} is given {len(several)} times; give it once"
        for name, several in texts.items()
        if len(several) > 1
    ]
    uses = Values(path.graph).uses if arguments else ()
    values = {name: _value(path, name, arguments, uses, faults) for name in arguments}
    sound = {name: value for name, value in values.items() if value is not None}
    if not faults:
        take_extinctions(uses, sound)
        take_wavelength(preset, path, sound)
    elif WAVELENGTH.name not in path.parameters:
        sound.pop(WAVELENGTH.name, None)  # What it is for may be what is faulty.
    axes = {name: value for name, value in sound.items() if isinstance(value, AxisValues)}
    single = {name: value for name, value in sound.items() if name not in axes}
    results = [Chosen(preset, path, case, single, axes) for case in dict.fromkeys(cases) or [None]]
    if faults or axes or len(results) > 1:
        with collecting(faults):
            of_each(results, Chosen.path)
        faults += axis_faults(path, axes) if faults else []
    if faults:
        raise ParameterError(*dict.fromkeys(faults))
    return results


def of_each(several: Sequence[Chosen], action: Callable[[Chosen], T]) -> dict[str, T]:
    """Return what an action makes of each case, by its name."""
    results: dict[str, T] = {}
    having: dict[Fault, list[str]] = {}
    for chosen in several:
        try:
            results[chosen.case or ""] = action(chosen)
        except OptipathError as error:
            for fault in error.faults:
                having.setdefault(fault, []).append(chosen.case or "")
    if having:
        every = {fault: len(cases) == len(several) for fault, cases in having.items()}
        raise ParameterError(
            *(
                fault if every[fault] else fault.under(f"case{'s' * (len(of) > 1)} {listed(of)}")
                for fault, of in having.items()
            )
        )
    return results


def asks_for_several(cases: Sequence[str]) -> bool:
    """Tell whether several cases are asked for, by their names or by ``all``."""
    return len({*cases}) > 1 or ALL in cases


def cases_of(preset: str, path: PathGraph, cases: Sequence[str]) -> Sequence[str]:
    """Return the names of cases, ``all`` replaced by those that there are."""
    if ALL not in cases:
        return cases
    if not path.cases:
        raise ParameterError(f"preset '{preset}' has no cases; leave --case out")
    return list(path.cases)


def one_case(command: str, path: PathGraph, cases: Sequence[str]) -> str | None:
    """Return the case that is asked for, of a command that can do with one."""
    if asks_for_several(cases):
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
        words = path.choices[name].behind
        if text not in words and any(each in text for each in ",:@"):
            faults.append(
                f"{flag(name)} takes one word of {listed([*words])}, and {shown(text)} is "
                f"several; give one, and write a command for each"
            )
            return None
        return text
    parameter = path.parameters.get(name, WAVELENGTH)
    with collecting(faults):
        if is_material(parameter, text, uses):
            other = extinction_with(uses, name)
            k = _value(path, other, arguments, uses, faults) if other in arguments else None
            option = flag(other) if other else ""
            if isinstance(k, AxisValues):
                faults.append(f"{option} takes one value beside {flag(name)} {text}; give one")
            elif k is not None:
                path.parameters[other].resolve(k)
            return None if faults else material_named(flag(name), text, k)
        if several := axis_argument(parameter, text, uses):
            return several
        # A bare number may be nanometres, micrometres or electronvolts.
        unit = "" if isinstance(parameter, Wavelength) else parameter.unit
        return single_value(parameter, text, uses, unit, flag)
    return None


def take_wavelength(preset: str, path: PathGraph, values: dict[str, Any]) -> None:
    """Say where nothing depends on a wavelength; a single one is taken out of the values."""
    name = WAVELENGTH.name
    if name not in values or name in path.parameters:
        return
    media = {argument: value for argument, value in values.items() if isinstance(value, Material)}
    try:
        needed = name in path.bind(**media).parameters
    except OptipathError:
        return  # Which is told of the material.
    if not needed:
        argument = values[name]
        several = isinstance(argument, AxisValues)
        WAVELENGTH.resolve(argument.given if several else argument)
        if several:
            values[name] = IdleValues(*argument)
        else:
            del values[name]
        message = "all is the same along it" if several else f"--{name} is not used"
        message = f"optipath: nothing in '{preset}' depends on the wavelength; {message}"
        click.echo(printable(message), err=True)
