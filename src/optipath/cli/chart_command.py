"""``optipath chart``: speed against accuracy, measured on this machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath import plots
from optipath.cli.arguments import NEW_FILE, OLD_FILE, check_place, write
from optipath.cli.console import reported_progress, say
from optipath.cli.options import given_options
from optipath.cli.plot_command import title_of
from optipath.cli.preset_command import PresetGroup, is_without_preset
from optipath.paths.files.presets import preset_names
from optipath.values.files import check_form, text_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from optipath.cli.preset_command import Chosen
    from optipath.paths.path_graph import PathGraph


EVERYWHERE = "all"
NEAR = ("brewster", "critical", "grazing", "normal")
"""The places of the lab, which is not imported for help; a test compares them."""

OUT = click.Option(
    ["--out"], type=NEW_FILE, default="chart.png", help="Draw into this file (png, svg, pdf)."
)
DATA = click.Option(
    ["--data"], type=NEW_FILE, help="Write what was measured into this file, as JSON."
)
ENGINE = click.Option(
    ["--engine", "engines"],
    type=click.Choice(["numpy", "numba"]),
    multiple=True,
    help="Measure this engine; may be given twice. By default all that are installed.",
)
QUICK = click.Option(
    ["--quick"], is_flag=True, help="Measure fewer samples, and compiled engines by one method."
)
AT = click.Option(
    ["--near"],
    type=click.Choice([*NEAR, EVERYWHERE]),
    multiple=True,
    help="Measure errors against the distance from this place, and no times; may be given again.",
)
PEERS = click.Option(
    ["--peers"],
    type=OLD_FILE,
    help="Draw other software beside: what benchmarks/peers/race.py --json wrote.",
)
INTERFACE = click.Option(
    ["--interface"], is_flag=True, help="Measure one interface instead of a path."
)
REDRAW = click.Option(
    ["--from", "source"],
    type=OLD_FILE,
    help="Draw what was measured before: a file that --data wrote.",
)


_CLASHES = {
    "--near": ("--engine", "--quick", "--peers"),
    "--from": ("--interface", "--near", "--quick"),
    "--interface": ("--peers",),
}
"""Options of which each excludes others: what is measured, and where from."""


def _faults(**_options: Any) -> list[str]:
    """Return which of the options do not go together, a sentence each."""
    given = given_options()
    return [
        f"{one} and {other} do not go together; leave one of them out"
        for one, others in _CLASHES.items()
        for other in others
        if one in given and other in given
    ]


def _chart(chosen: Chosen, **options: Any) -> None:
    """Measure speed against accuracy, for a preset, a TOML file or one interface, and draw it."""
    _measure_and_draw(chosen.path(), title_of(chosen), **options)


def _without_preset(*, interface: bool, source: Path | None, **options: Any) -> None:
    if not is_without_preset():
        return
    if not interface and source is None:
        names = ", ".join(preset_names())
        raise click.UsageError(
            f"PRESET is missing; give a file, one of {names}, --interface, or --from"
        )
    if faults := _faults():
        raise click.UsageError("; ".join(faults))
    _measure_and_draw(None, "one interface", source=source, **options)


def _measure_and_draw(
    path: PathGraph | None, title: str, *, out: Path, data: Path | None, **options: Any
) -> None:
    check_form(out)
    if data is not None and data.absolute() == out.absolute():
        raise click.UsageError(f"--out and --data both write '{out}'; give two files")
    for file in (out, data):
        if file is not None:
            check_place(file)
    # Before anything is measured: they tell whether what draws is there.
    draw, save, interrupted = plots.chart, plots.save, False
    stored: dict[str, Any] = {}
    try:
        with reported_progress() as tell:
            stored.update(_measured(path, title, tell, stored.update, **options))
    except KeyboardInterrupt:
        if not stored:
            raise
        interrupted = True
        done = stored["regions"]
        say(f"interrupted: {done['measured']} of {done['of']} steps are measured, and are kept")
    if data is not None:
        from optipath.lab.chart_file import chart_text  # noqa: PLC0415 - an extra

        write(data, chart_text(stored).encode())
        say(f"wrote {data}")
    save(draw(stored, peers=options["peers"]), out, _DOTS)
    say(f"wrote {out}")
    if interrupted:
        raise KeyboardInterrupt


_DOTS = 120.0


def _measured(
    path: PathGraph | None,
    title: str,
    tell: Callable[[str, float], object],
    keep: Callable[[dict[str, Any]], object],
    *,
    near: tuple[str, ...],
    quick: bool,
    peers: Path | None,
    engines: tuple[str, ...] = (),
    source: Path | None = None,
) -> Mapping[str, Any]:
    """Return a chart of a path, or of one interface without a path, or out of a file."""
    if source is not None:
        from optipath.lab.chart_file import read_chart  # noqa: PLC0415 - an extra

        return read_chart(text_of(source), str(source))
    from optipath.lab import chart as lab  # noqa: PLC0415 - an extra
    from optipath.lab.chart_file import check_race  # noqa: PLC0415 - ditto

    if near:
        places = NEAR if EVERYWHERE in near else near
        return lab.critical_chart(path, title, places, progress=tell, keep=keep)
    effort = lab.QUICK if quick else lab.FULL
    if path is None:
        return lab.interface_chart(effort, tell, keep)
    if peers is not None:
        check_race(text_of(peers), str(peers))
    effort = effort._replace(engines=engines) if engines else effort
    click.echo(lab.expected(effort), err=True)
    return lab.path_chart(path, title, effort, tell, keep)


chart = PresetGroup(
    "chart",
    _chart,
    (OUT, DATA, ENGINE, QUICK, AT, PEERS),
    callback=_without_preset,
    faults=_faults,
    params=[INTERFACE, REDRAW, OUT, DATA, QUICK, AT, PEERS],
    subcommand_metavar="[PRESET] [OPTIONS]",
)
