"""``optipath chart``: speed against accuracy, measured on this machine."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from optipath.cli.console import say
from optipath.cli.preset_command import PresetGroup
from optipath.cli.progress_bar import progress_bar
from optipath.cli.text_files import NewFile, check_place, read_text, told_of, write
from optipath.paths.presets.loader import preset_names
from optipath.values.picture_files import check_form

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.cli.chosen import Chosen

    Tell: TypeAlias = Callable[[str, float], object]
    Chart: TypeAlias = Mapping[str, Any]

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
INTERFACE = click.Option(
    ["--interface"], is_flag=True, help="Measure one interface instead of a path."
)
REDRAW = click.Option(
    ["--from", "source"],
    type=click.Path(dir_okay=False, exists=True, path_type=Path),
    help="Draw what was measured before: a file that --data wrote.",
)


def _chart(chosen: Chosen, *, out: Path, data: Path | None, engines: tuple[str, ...]) -> None:
    """Measure speed against accuracy, for a preset, a TOML file or one interface, and draw it."""
    path = chosen.path()

    def measure(progress: Tell) -> Chart:
        from optipath.lab.accuracy.chart import Effort, path_chart  # noqa: PLC0415 - an extra

        effort = Effort(engines=engines) if engines else Effort()
        return path_chart(path, chosen.title, effort, progress)

    _measure_and_draw(measure, out, data)


def _without_preset(*, interface: bool, source: Path | None, out: Path, data: Path | None) -> None:
    context = click.get_current_context()
    if context.invoked_subcommand is not None:
        if interface or source:
            raise click.UsageError("--interface and --from stand for the preset; leave it out")
        for name in ("out", "data"):
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

    def measure(progress: Tell) -> Chart:
        from optipath.lab.accuracy.chart import interface_chart  # noqa: PLC0415 - ditto
        from optipath.lab.accuracy.chart_file import read_chart  # noqa: PLC0415 - ditto

        if source:
            return read_chart(read_text(source), str(source))
        return interface_chart(progress=progress)

    _measure_and_draw(measure, out, data)


def _measure_and_draw(measure: Callable[[Tell], Chart], out: Path, data: Path | None) -> None:
    from optipath.lab.accuracy.chart_drawing import draw  # noqa: PLC0415 - ditto
    from optipath.lab.accuracy.chart_file import chart_text  # noqa: PLC0415 - an extra

    check_form(out)
    if data is not None and data.absolute() == out.absolute():
        raise click.UsageError(f"--out and --data both write '{out}'; give two files")
    for file in (out, data):
        if file is not None:
            check_place(file)
    with progress_bar(1.0) as tell:
        chart = measure(lambda what, done: tell(what, completed=done))
    if data is not None:
        write(data, chart_text(chart).encode())
        say(f"wrote {data}")
    with told_of(out):
        draw(chart, out)
    say(f"wrote {out}")


chart = PresetGroup(
    "chart",
    _chart,
    (OUT, DATA, ENGINE),
    callback=_without_preset,
    params=[INTERFACE, REDRAW, OUT, DATA],
    subcommand_metavar="[PRESET] [OPTIONS]",
)
