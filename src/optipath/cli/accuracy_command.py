"""``optipath accuracy``: how far each method is from 50 digits, region by region."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from optipath.cli.console import PlainConsole, cell, headed, say
from optipath.cli.text_files import read_text, write

if TYPE_CHECKING:
    from optipath.lab.accuracy.tables import TextTable


def _style(word: str) -> str:
    return "bold red" if word.startswith("**") else ""


SAMPLES = click.Option(
    ["--samples"],
    type=click.IntRange(1, 100_000),
    default=200,
    show_default=True,
    help="How many boundaries and angles are drawn in each region.",
)
SEARCH = click.Option(
    ["--search", "generations"],
    type=click.IntRange(1, 100_000),
    help="Search for the worst cases instead: so many generations of 1000 boundaries and angles "
    "for each component in each region; 20 take some five minutes.",
)
WRITE = click.Option(
    ["--write", "file"],
    type=click.Path(dir_okay=False, exists=True, path_type=Path),
    help="Put the tables into this file, between the lines that mark their place.",
)


def _accuracy(samples: int, generations: int | None, file: Path | None) -> None:
    from optipath.lab.accuracy.tables import (  # noqa: PLC0415 - an extra
        SAMPLED,
        SEARCHED,
        put_tables,
        searched_tables,
        tables,
    )

    def found() -> list[TextTable]:
        return tables(samples) if generations is None else searched_tables(generations)

    if file is not None:
        text, marks = read_text(file), SAMPLED if generations is None else SEARCHED
        put_tables(text, [], marks)  # A file without a place for them is told of at once.
        write(file, put_tables(text, found(), marks).encode())
        say(f"wrote {file}")
        return
    console = PlainConsole()
    for table in found():
        shown = headed(*table.header, title=table.title, box=None)
        for row in table.rows:
            shown.add_row(*(cell(word.strip("*"), _style(word)) for word in row))
        console.print(shown)


accuracy = click.Command(
    "accuracy",
    callback=_accuracy,
    params=[SAMPLES, SEARCH, WRITE],
    help="Tell how far each method is from 50-digit references, region by region.",
)
