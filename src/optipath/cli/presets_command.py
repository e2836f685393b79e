"""``optipath presets``: what there is."""

from __future__ import annotations

import filecmp
from contextlib import suppress
from itertools import groupby
from typing import TYPE_CHECKING

import click

from optipath.cli.console import JSON, say, say_descriptions, say_json, say_wrapped
from optipath.cli.options import StrictCommand
from optipath.paths.files.presets import preset_descriptions, preset_files

if TYPE_CHECKING:
    from pathlib import Path


_MOST = 4
"""How many files that have no name are listed."""


@click.command(cls=StrictCommand, params=[JSON])
def presets(*, as_json: bool) -> None:
    """List the presets: the library's, and yours in ./presets and OPTIPATH_PRESETS."""
    files, unnamed = preset_files()
    descriptions = preset_descriptions(files)
    if as_json:
        say_json(descriptions)
        return
    for number, (folder, names) in enumerate(groupby(files, lambda name: files[name].parent)):
        if number:
            say_wrapped(f"\nyour presets in '{folder}':")
        say_descriptions("preset", {name: descriptions[name] for name in names}, as_json=False)
    if unnamed := [file for file in unnamed if not _is_copy(file, files.get(file.stem))]:
        some = ", ".join(f"'{file}'" for file in unnamed[:_MOST])
        more = f" and {len(unnamed) - _MOST} more" if unnamed[_MOST:] else ""
        why = "the name is not of a-z, 0-9 and -, or that of a preset above; give the path"
        say(f"optipath: not found by name: {some}{more}; {why}", err=True)


def _is_copy(file: Path, named: Path | None) -> bool:
    """Tell whether a file is the same as that of its name, as in a copy of the sources."""
    with suppress(OSError):
        return named is not None and filecmp.cmp(file, named, shallow=False)
    return False
