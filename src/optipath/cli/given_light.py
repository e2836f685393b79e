"""A wavelength that is given by an option to a path in which nothing depends on it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath.errors import OptipathError, printable
from optipath.values.axis_texts import AxisValues, IdleValues
from optipath.values.materials import Material
from optipath.values.named_materials import WAVELENGTH

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph


def take_wavelength(preset: str, path: PathGraph, values: dict[str, Any]) -> None:
    """Say where nothing depends on a wavelength that is among some values.

    A single one is taken out of them; of several, all is the same along them.
    """
    name = WAVELENGTH.name
    if name not in values or name in path.parameters:
        return
    media = {given: value for given, value in values.items() if isinstance(value, Material)}
    try:
        needed = name in path.bind(**media).parameters
    except OptipathError:
        return  # Which is told of the material.
    if not needed:
        given = values[name]
        several = isinstance(given, AxisValues)
        WAVELENGTH.resolve(given.given if several else given)
        if several:
            values[name] = IdleValues(*given)
        else:
            del values[name]
        told = "all is the same along it" if several else f"--{name} is not used"
        told = f"optipath: nothing in '{preset}' depends on the wavelength; {told}"
        click.echo(printable(told), err=True)
