"""What the command line prints: nothing is cut, and no text of a file commands the terminal."""

from __future__ import annotations

import shutil
from typing import Any

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from optipath.quoting import printable

_NARROWEST, _WIDEST = 20, 1000


def say(text: str) -> None:
    """Print lines as they are, control characters by their codes."""
    click.echo(printable(text))


def cell(text: str, style: str = "") -> Text:
    """Return a text for tables and paragraphs, without markup and control characters."""
    return Text(printable(text), style=style)


def headed(*headers: str, **keywords: Any) -> Table:
    """Return a table whose columns have these headers."""
    made = Table(header_style="bold", **keywords)
    for header in headers:
        made.add_column(cell(header))
    return made


class Terminal(Console):
    """A console whose tables are as wide as their longest words, on narrow terminals too."""

    def __init__(self, **keywords: Any) -> None:
        keywords.setdefault("width", _width())
        super().__init__(highlight=False, **keywords)

    def print(self, *objects: Any, **keywords: Any) -> None:
        """Print; what is too long for a line goes on in the next."""
        for shown in (thing for thing in objects if isinstance(thing, Table)):
            for column in shown.columns:
                column.overflow = "fold"
            least = self.measure(shown, options=self.options.update(width=_WIDEST)).minimum
            self.width = max(self.width, least)
        super().print(*objects, **keywords)

    def on_broken_pipe(self) -> None:
        """Leave it to the command, which ends in silence."""
        raise BrokenPipeError


def _width() -> int:
    try:
        columns = shutil.get_terminal_size().columns
    except ValueError:  # COLUMNS may be a number of 5000 digits.
        return 80
    return min(max(columns, _NARROWEST), _WIDEST)
