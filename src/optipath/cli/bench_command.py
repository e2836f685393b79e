"""``optipath bench`` and ``optipath accuracy``: how fast and how exact this is."""

from __future__ import annotations

from collections import defaultdict
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from optipath.cli.arguments import OLD_FILE, write
from optipath.cli.console import JSON, PlainConsole, cell, headed, progress_bar, say, say_json
from optipath.cli.options import StrictCommand
from optipath.cli.preset_command import PresetGroup
from optipath.paths.files.presets import beside, bound_preset, load_preset
from optipath.values.files import text_of
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from rich.table import Table

    from optipath.cli.preset_command import Chosen
    from optipath.lab.bench import Report
    from optipath.paths.path_graph import PathGraph


ENGINES = ("numpy", "numba", "jax")
LARGEST = click.Option(
    ["--largest"],
    type=click.IntRange(1, 10**8),
    help="The largest batch, by default 100,000 paths, or 1,000,000 with --long.",
)
LONG = click.Option(
    ["--long"],
    is_flag=True,
    help="Add batches of 1, 10 and so on, float32, Mueller matrices, methods; takes minutes.",
)
ENGINE = click.Option(
    ["--engine", "engines"],
    type=click.Choice(ENGINES),
    multiple=True,
    help="Measure this engine; may be given several times. By default all that are installed.",
)
THREADS = click.Option(
    ["--threads"],
    type=click.IntRange(1, 256),
    default=1,
    help="How many threads share a batch of more than 65,536 paths.",
)


def _bench(chosen: Chosen, *, as_json: bool, **options: Any) -> None:
    """Time a preset or a TOML file: one run, and batches by every engine. Ends within 30 s."""
    from optipath.lab.bench import bench  # noqa: PLC0415 - not for every command

    def load() -> Any:
        return bound_preset(load_preset(chosen.preset), chosen.preset, chosen.case, chosen.values)

    path = _opened(chosen)
    options["largest"] = options["largest"] or (1_000_000 if options["long"] else 100_000)
    each = 4 * len(str(options["largest"])) + 4 if options["long"] else 3
    steps = 5 + each * len(options["engines"] or ENGINES)
    with progress_bar(steps) as tell:
        report = bench(path, load, progress=lambda what: tell(what, advance=1), **options)
    if as_json:
        say_json({"preset": chosen.preset, **report._asdict()})
        return
    for table in _tables(report):
        PlainConsole().print(table)


def _opened(chosen: Chosen) -> PathGraph:
    """Return the path with what was given, the angles of a case left open."""
    path, case = chosen.opened, chosen.case
    if case not in path.cases:
        return chosen.path()  # None is given, or one that is refused.
    known = path.parameters
    stored = {
        name: value
        for name, value in path.cases[case].values.items()
        if dimension_of(known[name].unit) != "angle" or known[name].optional
    }
    return bound_preset(path, chosen.preset, None, beside(chosen.opened, stored, chosen.values))


def _tables(report: Report) -> list[Table]:
    from optipath.lab.bench import duration  # noqa: PLC0415 - not for every command

    single = {name: [duration(1e-3 * time)] for name, time in report.single.items()}
    times = defaultdict(list)
    for row in report.batches:
        name = f"{row['engine']} {row['dtype']} {row['output']}"
        times[name].append(duration(1e-9 * row["ns_least"]))
    methods = {
        f"{row['engine']} {row['method']}": [
            duration(1e-9 * row["ns_least"]),
            duration(row["first_s"]),
        ]
        for row in report.methods
    }
    once = _table("done once", ["time"], single)
    once.caption = ", ".join(f"{name} {number}" for name, number in report.software.items())
    once.caption_justify = "left"
    sizes = [f"{size:,}" for size in dict.fromkeys(row["paths"] for row in report.batches)]
    paths = report.methods[0]["paths"]
    return [
        once,
        _table("time a path, by the number of paths", sizes, times),
        _table(f"methods, {paths:,} paths", ["time a path", "first call"], methods),
    ]


def _table(title: str, heads: list[str], rows: Mapping[str, list[str]]) -> Table:
    labelled = [[name, *times] for name, times in rows.items()]
    table = headed("", *heads, rows=labelled, right=1, title=title, box=None)
    for column in table.columns:
        column.no_wrap = True
    return table


bench = PresetGroup("bench", _bench, (LARGEST, LONG, ENGINE, THREADS, JSON))


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
