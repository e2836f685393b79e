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
    """Return the path that a text describes, as `PathGraph.to_toml` writes it.

    Parameters
    ----------
    text : str
        TOML of format 1.
    source : str
        Where it comes from, as sentences about its format say it.
    about : str, optional
        The same for sentences about its path.

    Returns
    -------
    PathGraph

    Raises
    ------
    PresetError
        If it is not TOML, or not format 1.
    PathError
        With every fault of what it says.
    """
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
