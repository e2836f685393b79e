"""``optipath accuracy``: how far each method is from 50 digits, region by region."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click

from optipath.cli.arguments import read_text, write
from optipath.cli.console import PlainConsole, cell, headed, say
from optipath.cli.options import StrictCommand

SAMPLES = click.Option(
    ["--samples"],
    type=click.IntRange(1, 100_000),
    default=200,
    help="How many boundaries and angles are drawn in each region.",
)
SEARCH = click.Option(
    ["--search", "generations"],
    type=click.IntRange(1, 100_000),
    help="Search for the worst cases instead: so many generations of 1000 boundaries and angles "
    "for each component in each region; 1000 take about a quarter of an hour.",
)
WRITE = click.Option(
    ["--write", "file"],
    type=click.Path(dir_okay=False, exists=True, path_type=Path),
    help="Put the tables into this file, between the lines that mark their place.",
)


def _accuracy(samples: int, generations: int | None, file: Path | None) -> None:
    """Tell how far each method is from 50-digit references, region by region."""
    from optipath.lab import tables  # noqa: PLC0415 - an extra

    if generations is None:
        measure, marks = partial(tables.tables, samples), tables.SAMPLED
    else:
        measure, marks = partial(tables.searched_tables, generations), tables.SEARCHED
    if file is not None:
        text = read_text(file)
        # A file without a place for them is told of at once.
        tables.put_tables(text, [], marks)
        write(file, tables.put_tables(text, measure(), marks).encode())
        say(f"wrote {file}")
        return
    console = PlainConsole()
    for table in measure():
        shown = headed(*table.header, title=table.title, box=None)
        for row in table.rows:
            styles = ("bold red" if word.startswith("**") else "" for word in row)
            words = (word.strip("*") for word in row)
            shown.add_row(*map(cell, words, styles))
        console.print(shown)


accuracy = click.command("accuracy", cls=StrictCommand, params=[SAMPLES, SEARCH, WRITE])(_accuracy)
