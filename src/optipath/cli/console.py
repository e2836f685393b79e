"""What the command line prints: nothing is cut, and no text of a file commands the terminal."""

from __future__ import annotations

import json
import shutil
from typing import Any

import click
from rich.console import Console
from rich.table import Column, Table
from rich.text import Text

from optipath.errors import printable

_NARROWEST, _WIDEST = 20, 1000
_COLUMN = 30
"""How wide a column that needs it is on the narrowest terminal."""


def say(text: str) -> None:
    """Print lines as they are, control characters by their codes."""
    click.echo(printable(text))


def say_json(found: dict[str, Any]) -> None:
    """Print one JSON object."""
    click.echo(json.dumps(found, allow_nan=False))


def cell(text: str, style: str = "") -> Text:
    """Return a text for tables and paragraphs, without markup and control characters.

    Parameters
    ----------
    text : str
        What anybody may have written.
    style : str, optional
        As rich writes it, such as ``"bold"``.

    Returns
    -------
    rich.text.Text
        What rich prints as it is.
    """
    return Text(printable(text), style=style)


def headed(*headers: str, **keywords: Any) -> Table:
    """Return a table whose columns have these headers.

    Parameters
    ----------
    *headers : str
        What anybody may have written.
    **keywords : Any
        As rich's `Table` takes them.

    Returns
    -------
    rich.table.Table
        Without rows.
    """
    made = Table(header_style="bold", **keywords)
    for header in headers:
        made.add_column(cell(header))
    return made


class PlainConsole(Console):
    """A console that leaves it to a narrow terminal to break lines, rather than to cut them."""

    def __init__(self, **keywords: Any) -> None:
        # With both told, rich does not read them from the environment, where anything may stand.
        width = keywords.pop("width", None) or _width()
        super().__init__(width=width, height=25, highlight=False, **keywords)

    def print(self, *objects: Any, **keywords: Any) -> None:
        """Print; what is too long for a line goes on in the next.

        Parameters
        ----------
        *objects, **keywords : Any
            As rich's `Console` takes them.
        """
        for shown in (thing for thing in objects if isinstance(thing, Table)):
            for column in shown.columns:
                column.overflow = "fold"
                column.min_width = min(_COLUMN, self._widest(column))
        super().print(*objects, **{"crop": False, **keywords})

    def on_broken_pipe(self) -> None:
        """Leave it to the command, which ends in silence."""
        raise BrokenPipeError

    def _widest(self, column: Column) -> int:
        options = self.options.update(width=_COLUMN)
        parts = (column.header, *column.cells)
        return max(self.measure(part, options=options).maximum for part in parts)


def _width() -> int:
    try:
        columns = shutil.get_terminal_size().columns
    except ValueError:  # COLUMNS may be a number of 5000 digits.
        return 80
    return min(max(columns, _NARROWEST), _WIDEST)
