"""``optipath chart``: speed against accuracy, measured on this machine."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from optipath.cli.arguments import NewFile, check_place, read_text, write
from optipath.cli.console import reported_progress, say
from optipath.cli.plot_command import title_of
from optipath.cli.preset_command import PresetGroup
from optipath.paths.files.presets import preset_names
from optipath.values.files import check_form

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.cli.chosen import Chosen

    Chart: TypeAlias = Mapping[str, Any]
    Tell: TypeAlias = Callable[[str, float], object]
    Keep: TypeAlias = Callable[[dict[str, Any]], object]
    Measure: TypeAlias = Callable[[Tell, Keep], Chart]


EVERYWHERE = "all"
NEAR = ("brewster", "critical", "grazing", "normal")
"""The places of the lab, which is not imported for help; a test compares them."""

OUT = click.Option(
    ["--out"],
    type=NewFile(),
    default="chart.png",
    help="Draw into this file; its ending says in which form (png, svg, pdf).",
)
DATA = click.Option(
    ["--data"], type=NewFile(), help="Write what was measured into this file, as JSON."
)
ENGINE = click.Option(
    ["--engine", "engines"],
    type=click.Choice(["numpy", "numba"]),
    multiple=True,
    help="Measure this engine; may be given twice. By default all that are installed.",
)
QUICK = click.Option(
    ["--quick"],
    is_flag=True,
    help="Measure fewer samples, and of engines that compile the default method alone.",
)
AT = click.Option(
    ["--near"],
    type=click.Choice([*NEAR, EVERYWHERE]),
    multiple=True,
    help="Measure errors against the distance from this place, and no times; may be given again.",
)
PEERS = click.Option(
    ["--peers"],
    type=click.Path(dir_okay=False, exists=True, path_type=Path),
    help="Draw other software beside: what benchmarks/peers/race.py --json wrote.",
)
INTERFACE = click.Option(
    ["--interface"], is_flag=True, help="Measure one interface instead of a path."
)
REDRAW = click.Option(
    ["--from", "source"],
    type=click.Path(dir_okay=False, exists=True, path_type=Path),
    help="Draw what was measured before: a file that --data wrote.",
)


def _faults(
    *,
    near: tuple[str, ...],
    quick: bool,
    peers: Path | None,
    engines: tuple[str, ...] = (),
    **_others: Any,
) -> list[str]:
    """Return what does not go with ``--near``, a sentence each."""
    arguments = {"--engine": bool(engines), "--quick": quick, "--peers": peers is not None}
    return [
        f"{name} is for times, and --near measures none; leave one of them out"
        for name, is_given in arguments.items()
        if is_given and near
    ]


def _places(near: tuple[str, ...]) -> tuple[str, ...]:
    return NEAR if EVERYWHERE in near else near


_DOTS = 120.0


def _chart(
    chosen: Chosen,
    *,
    out: Path,
    data: Path | None,
    engines: tuple[str, ...],
    quick: bool,
    near: tuple[str, ...],
    peers: Path | None,
) -> None:
    """Measure speed against accuracy, for a preset, a TOML file or one interface, and draw it."""
    path, title = chosen.path(), title_of(chosen)

    def measure(tell: Tell, keep: Keep) -> Chart:
        # The extra 'chart'.
        from optipath.lab import chart as lab  # noqa: PLC0415
        from optipath.lab.peer_times import check_race  # noqa: PLC0415

        if near:
            return lab.critical_chart(path, title, _places(near), progress=tell, keep=keep)
        if peers is not None:
            check_race(read_text(peers), str(peers))
        effort = lab.QUICK if quick else lab.FULL
        effort = effort._replace(engines=engines) if engines else effort
        click.echo(lab.expected(effort), err=True)
        return lab.path_chart(path, title, effort, tell, keep)

    _measure_and_draw(measure, out, data, peers)


def _without_preset(
    *,
    interface: bool,
    source: Path | None,
    out: Path,
    data: Path | None,
    quick: bool,
    near: tuple[str, ...],
    peers: Path | None,
) -> None:
    context = click.get_current_context()
    if context.invoked_subcommand is not None:
        if interface or source:
            raise click.UsageError("--interface and --from stand for the preset; leave it out")
        for name in ("out", "data", "quick", "near", "peers"):
            if context.get_parameter_source(name) is not click.core.ParameterSource.DEFAULT:
                raise click.UsageError(f"--{name} stands behind the preset; move it there")
        return
    if interface and source:
        raise click.UsageError("--interface measures and --from does not; give one of them")
    if not interface and source is None:
        names = ", ".join(preset_names())
        raise click.UsageError(
            f"PRESET is missing; give a file, one of {names}, --interface, or --from"
        )
    if source and (quick or near):
        raise click.UsageError("--quick and --near say what is measured; leave them out of --from")
    if interface and peers:
        raise click.UsageError("--peers stand beside a path; leave them out of --interface")
    if faults := _faults(near=near, quick=quick, peers=peers):
        raise click.UsageError("; ".join(faults))

    def measure(tell: Tell, keep: Keep) -> Chart:
        if source:
            from optipath.lab.chart_file import read_chart  # noqa: PLC0415

            return read_chart(read_text(source), str(source))
        from optipath.lab import chart as lab  # noqa: PLC0415

        if near:
            places = _places(near)
            return lab.critical_chart(None, "one interface", places, progress=tell, keep=keep)
        return lab.interface_chart(lab.QUICK if quick else lab.FULL, tell, keep)

    _measure_and_draw(measure, out, data, peers)


def _measure_and_draw(measure: Measure, out: Path, data: Path | None, peers: Path | None) -> None:
    check_form(out)
    if data is not None and data.absolute() == out.absolute():
        raise click.UsageError(f"--out and --data both write '{out}'; give two files")
    for file in (out, data):
        if file is not None:
            check_place(file)
    from optipath import plots  # noqa: PLC0415 - an extra
    from optipath.lab.chart_file import chart_text  # noqa: PLC0415

    draw, save, interrupted = plots.chart, plots.save, False
    stored: dict[str, Any] = {}
    try:
        with reported_progress() as tell:
            stored.update(measure(tell, stored.update))
    except KeyboardInterrupt:
        if not stored:
            raise
        interrupted = True
        done = stored["regions"]
        say(f"interrupted: {done['measured']} of {done['of']} steps are measured, and are kept")
    if data is not None:
        write(data, chart_text(stored).encode())
        say(f"wrote {data}")
    picture = draw(stored, peers=peers)
    save(picture, out, _DOTS)
    say(f"wrote {out}")
    if interrupted:
        raise KeyboardInterrupt


chart = PresetGroup(
    "chart",
    _chart,
    (OUT, DATA, ENGINE, QUICK, AT, PEERS),
    callback=_without_preset,
    faults=_faults,
    params=[INTERFACE, REDRAW, OUT, DATA, QUICK, AT, PEERS],
    subcommand_metavar="[PRESET] [OPTIONS]",
)
