"""``optipath accuracy``: how far each method is from 50 digits, region by region."""

from __future__ import annotations

from pathlib import Path

import click
from rich.table import Table

from optipath.cli.terminal import Terminal, cell, say
from optipath.cli.text_files import read_text, write


def _style(word: str) -> str:
    return "bold red" if word.startswith("**") else ""


@click.command()
@click.option(
    "--samples",
    type=click.IntRange(1, 100_000),
    default=200,
    show_default=True,
    help="How many boundaries and angles are drawn in each region.",
)
@click.option(
    "--write",
    "file",
    type=click.Path(dir_okay=False, exists=True, path_type=Path),
    help="Put the tables into this file, between the lines that mark their place.",
)
def accuracy(samples: int, file: Path | None) -> None:
    """Tell how far each method is from 50-digit references, region by region."""
    from optipath.accuracy.tables import put_tables, tables  # noqa: PLC0415 - an extra

    if file is not None:
        text = read_text(file)
        put_tables(text, [])  # A file without a place for them is told of at once.
        write(file, put_tables(text, tables(samples)).encode())
        say(f"wrote {file}")
        return
    console = Terminal()
    for table in tables(samples):
        shown = Table(*table.header, title=table.title, box=None, header_style="bold")
        for row in table.rows:
            shown.add_row(*(cell(word.strip("*"), _style(word)) for word in row))
        console.print(shown)
