"""The path that the text of a preset describes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import OptipathError, PathError, PresetError, shown
from optipath.paths.format.schema import FORMAT
from optipath.paths.presets.reader.document import read
from optipath.paths.presets.toml_text import parsed
from optipath.spelling import few_suggestions
from optipath.values.cures import of_files
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph


def path_of_text(text: str, source: str, about: str = "") -> PathGraph:
    """Return the path that a text describes, as `PathGraph.to_toml` writes it."""
    document = parsed(text, source)
    number = document.get("format", FORMAT)
    if number != FORMAT or isinstance(number, bool):
        raise PresetError(
            f"'{source}' has format {shown(number)}, but this version reads format {FORMAT}"
        )
    try:
        with few_suggestions(), units_are_written(), of_files():
            return read(document)
    except OptipathError as error:
        raise PathError(*error.faults, about=about or source) from None
