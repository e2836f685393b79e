"""``optipath bench``: how fast a preset, or a path of one's own, is on this machine."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import click
from rich.table import Table

from optipath.cli.console import PlainConsole
from optipath.cli.preset_command import JSON, PresetGroup
from optipath.cli.progress_bar import progress_bar
from optipath.paths.presets.loader import load_preset, with_values
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    from optipath.cli.preset_command import Chosen
    from optipath.lab.bench import Report
    from optipath.paths.path_graph import PathGraph

ENGINES = ("numpy", "numba", "jax")
LARGEST = click.Option(
    ["--largest"],
    type=click.IntRange(1, 10**8),
    default=1_000_000,
    show_default=True,
    help="The largest batch; batches grow by tens from 1.",
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
    show_default=True,
    help="How many threads share a batch of more than 65,536 paths.",
)


def _bench(
    chosen: Chosen,
    *,
    largest: int,
    engines: tuple[str, ...],
    threads: int,
    as_json: bool,
) -> None:
    from optipath.lab.bench import bench  # noqa: PLC0415 - not for every command

    def load() -> Any:
        return load_preset(chosen.preset, case=chosen.case, **chosen.values)

    steps = 5 + len(engines or ENGINES) * (4 * len(str(largest)) + 4)
    with progress_bar(steps) as tell:
        report = bench(
            _opened(chosen),
            load,
            largest=largest,
            engines=engines,
            threads=threads,
            progress=lambda what: tell(what, advance=1),
        )
    if as_json:
        click.echo(json.dumps({"preset": chosen.preset, **asdict(report)}))
        return
    for table in _tables(report):
        PlainConsole().print(table)


def _opened(chosen: Chosen) -> PathGraph:
    """Return the path with what was given, the angles of a case left open."""
    path, case = chosen.opened, chosen.case
    if case not in path.cases:
        return chosen.path()  # None is given, or one that is refused.
    angles = [
        name
        for name, p in path.parameters.items()
        if dimension_of(p.unit) == "angle" and not p.optional
    ]
    kept = {name: value for name, value in path.cases[case].values.items() if name not in angles}
    return with_values(path, chosen.preset, None, {**kept, **chosen.values})


def _tables(report: Report) -> list[Table]:
    software = ", ".join(f"{name} {number}" for name, number in report.software.items())
    once = _table("done once", "", "ms")
    for name, milliseconds in report.single.items():
        once.add_row(name, f"{milliseconds:.3g}")
    once.caption, once.caption_justify = software, "left"
    return [once, _batch_table(report), _method_table(report)]


def _batch_table(report: Report) -> Table:
    sizes = list(dict.fromkeys(row["paths"] for row in report.batches))
    table = _table("ns a path, by the number of paths", "", *(f"{size:,}" for size in sizes))
    rows: dict[str, list[str]] = {}
    for row in report.batches:
        name = f"{row['engine']} {row['dtype']} {row['output']}"
        rows.setdefault(name, []).append(_short(row["ns_least"]))
    for name, cells in rows.items():
        table.add_row(name, *cells)
    return table


def _method_table(report: Report) -> Table:
    paths = report.methods[0]["paths"] if report.methods else 0
    table = _table(f"methods, {paths:,} paths", "", "ns a path", "first call, s")
    for row in report.methods:
        name = f"{row['engine']} {row['method']}"
        table.add_row(name, _short(row["ns_least"]), f"{row['first_s']:.2g}")
    return table


def _table(title: str, *header: str) -> Table:
    table = Table(title=title, title_justify="left", box=None, header_style="bold")
    for place, name in enumerate(header):
        table.add_column(name, justify="right" if place else "left", no_wrap=True)
    return table


def _short(number: float) -> str:
    return f"{number:,.0f}" if number >= 100.0 else f"{number:.3g}"


bench = PresetGroup(
    "bench",
    action=_bench,
    options=(LARGEST, ENGINE, THREADS, JSON),
    help="Time a preset or a TOML file: one run, batches by every engine, and the methods.",
)
