"""``optipath bench`` and ``optipath accuracy``: how fast and how exact this is."""

from __future__ import annotations

from functools import partial
from itertools import groupby
from typing import TYPE_CHECKING, Any

import click

from optipath import plots
from optipath.cli.arguments import NEW_FILE, OLD_FILE, check_place, write
from optipath.cli.console import JSON, PlainConsole, cell, headed, progress_bar, say, say_json
from optipath.cli.options import StrictCommand
from optipath.cli.preset_command import PresetGroup, is_without_preset
from optipath.values.files import check_form, text_of
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from rich.table import Table

    from optipath.cli.preset_command import Chosen
    from optipath.lab.composition import Rates
    from optipath.paths.path_graph import PathGraph


ENGINES = ("numpy", "numba", "jax")
ELEMENTS = click.Option(
    ["--elements"],
    type=click.IntRange(3, 100_000),
    default=1000,
    help="How many elements the long path has that is composed.",
)
LARGEST = click.Option(
    ["--largest"],
    type=click.IntRange(1, 10**8),
    help="The largest batch, by default 10,000 values, or 1,000,000 with --long.",
)
LONG = click.Option(
    ["--long"],
    is_flag=True,
    help="Add batches of 10, 100 and so on, and paths of 100 and 10,000 elements; takes minutes.",
)
ENGINE = click.Option(
    ["--engine", "engines"],
    type=click.Choice(ENGINES),
    multiple=True,
    help="Measure this engine; may be repeated. By default numpy, and numba if it is installed.",
)
THREADS = click.Option(
    ["--threads"],
    type=click.IntRange(1, 256),
    default=1,
    help="How many threads share a batch of more than 65,536 values.",
)
OUT = click.Option(["--out"], type=NEW_FILE, help="Draw it into this file, too (png, svg, pdf).")


def _bench(chosen: Chosen, **options: Any) -> None:
    """Time composing and tracing, of mixed paths and of a preset or file. Ends within 30 s."""
    _measure({chosen.preset: _opened(chosen)}, **options)


def _without_preset(**options: Any) -> None:
    if is_without_preset():
        _measure({}, **options)


def _measure(
    paths: dict[str, PathGraph], *, out: Path | None, as_json: bool, **effort: Any
) -> None:
    from optipath.lab import bench, composition  # noqa: PLC0415 - not for every command

    if out is not None:
        check_form(out)
        check_place(out)
        plots.check_matplotlib()
    with progress_bar() as tell:
        rates = composition.measured(paths, progress=tell, **effort)
    about = {"processor": bench.processor(), **bench.software(("numpy", "networkx", *ENGINES))}
    if as_json:
        say_json({"rates": [each._asdict() for each in rates], "about": about})
    else:
        for path, several in groupby(rates, lambda each: each.path):
            PlainConsole().print(_table(path, several))
        say(", ".join(f"{name} {number}" for name, number in about.items()))
    if out is not None:
        from optipath.plots.charts import throughput  # noqa: PLC0415 - an extra

        plots.save(throughput(rates), out)
        say(f"wrote {out}", err=as_json)


def _table(path: str, rates: Iterable[Rates]) -> Table:
    from optipath.lab.bench import rate  # noqa: PLC0415 - not for every command

    heads, rows = ["per second", "median"], []
    for each in rates:
        rows.append([each.work, *(rate(number) for number in each[2:] if number)])
        if each.by_hand:
            heads[2:] = ["by hand", "median", "ratio"]
            rows[-1].append(f"{each.best / each.by_hand:.3g}")
    table = headed("", *heads, rows=rows, right=1, title=path, box=None)
    for column in table.columns:
        column.no_wrap = True
    return table


def _opened(chosen: Chosen) -> PathGraph:
    """Return the path with what was given, the angles of a case left open."""
    known = chosen.opened.parameters.items()
    angles = [name for name, one in known if dimension_of(one.unit) == "angle" and not one.optional]
    return chosen.path(others=angles)


_OPTIONS = (ELEMENTS, LARGEST, LONG, ENGINE, THREADS, OUT, JSON)

bench = PresetGroup(
    "bench",
    _bench,
    _OPTIONS,
    callback=_without_preset,
    params=[*_OPTIONS],
    subcommand_metavar="[PRESET] [OPTIONS]",
)


SAMPLES = click.Option(
    ["--samples"], type=click.IntRange(1, 100_000), default=200, help="Samples in each region."
)
SEARCH = click.Option(
    ["--search", "generations"],
    type=click.IntRange(1, 100_000),
    help="Search for the worst cases instead: so many generations of 1000 boundaries and angles "
    "for each component in each region; 1000 take about a quarter of an hour.",
)
WRITE = click.Option(
    ["--write", "file"], type=OLD_FILE, help="Put the tables into this file, between their marks."
)


def _accuracy(samples: int, generations: int | None, file: Path | None) -> None:
    """Tell how far each method is from 50-digit references, region by region."""
    from optipath.lab import tables  # noqa: PLC0415 - an extra

    if generations is None:
        measure, marks = partial(tables.tables, samples), tables.SAMPLED
    else:
        measure, marks = partial(tables.searched_tables, generations), tables.SEARCHED
    if file is not None:
        text = text_of(file)
        # A file without a place for them is told of at once.
        tables.put_tables(text, [], marks)
        write(file, tables.put_tables(text, measure(), marks).encode())
        say(f"wrote {file}")
        return
    console = PlainConsole()
    for table in measure():
        shown = headed(*table.header, title=table.title, box=None)
        for row in table.rows:
            styles = ["bold red" if word.startswith("**") else "" for word in row]
            shown.add_row(*map(cell, [word.strip("*") for word in row], styles))
        console.print(shown)


accuracy = click.command("accuracy", cls=StrictCommand, params=[SAMPLES, SEARCH, WRITE])(_accuracy)
