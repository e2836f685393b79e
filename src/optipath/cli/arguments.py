"""Arguments of commands: ranges, lists, columns and files."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np

from optipath.cli.options import flag
from optipath.errors import OptipathError, ParameterError
from optipath.faults import shown
from optipath.values.files import message_of, write_file
from optipath.values.text import read_axis_text
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from optipath.plan.inputs import Inputs
    from optipath.values.parameters import Parameter
    from optipath.values.text import AxisValues
    from optipath.values.use import Use


RANGES = (
    "Several values: 0:90:91 (start:stop:count), 10,20,30, or @FILE.csv for a column of a file."
)
"""How an option takes more than one value, for help."""


def axis_argument(parameter: Parameter, text: str, uses: Sequence[Use]) -> AxisValues | None:
    """Return the values that the text of an option stands for."""
    # A bare wavelength may be nanometres, micrometres or electronvolts; a file says its units.
    is_shown = isinstance(parameter, Wavelength) or text.lstrip().startswith("@")
    unit = "" if is_shown else parameter.unit
    with ParameterError.wrapping():
        return read_axis_text(text, parameter, unit, uses)


def array_faults(inputs: Inputs, axes: Collection[str] = ()) -> list[str]:
    """Return which parameters have several values in the file, which none of an axis go with."""
    return [
        f"parameter '{name}' has several values in the file; give one by {flag(name)}"
        for name, parameter in {**inputs.open, **inputs.bound}.items()
        if name not in axes and np.ndim(parameter.default) > len(inputs.tails.get(name, ()))
    ]


OLD_FILE = click.Path(dir_okay=False, exists=True, path_type=Path)
NEW_FILE = click.Path(dir_okay=False, path_type=Path)
"""The name of a file to be written, which `check_place` looks at."""


def check_place(file: Path) -> None:
    """Refuse a file that cannot be written, before the work for it is done."""
    folder = file.absolute().parent
    if not (file.name and folder.is_dir()):
        raise OptipathError(f"'{file}' cannot be written: there is no such folder or file name")
    if not all(os.access(place, os.W_OK) for place in (folder, file) if place.exists()):
        raise OptipathError(f"'{file}' cannot be written: permission denied")


def write(file: Path, content: bytes) -> None:
    """Write a file, whole or not at all."""
    with message_of(file, click.ClickException, ""):
        write_file(file, content)


def number(text: str) -> int:
    """Return a whole number, which may be written as 1e6."""
    with suppress(ValueError):
        return int(text)
    with suppress(ValueError):
        if float(text).is_integer():
            return int(float(text))
    raise click.BadParameter(f"{shown(text)} is no whole number; write one such as 1000, or 1e6")


SEED = click.Option(["--seed"], type=number, default=0, help="Of the photons.")
THREADS = click.Option(
    ["--threads"], type=number, help="How many walk at a time; by default one a processor."
)
