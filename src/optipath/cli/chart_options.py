"""The options of ``optipath chart``."""

from __future__ import annotations

from pathlib import Path

import click

from optipath.cli.text_files import NewFile

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


def places_near(near: tuple[str, ...]) -> tuple[str, ...]:
    """Return the places that are asked for."""
    return NEAR if EVERYWHERE in near else near


def option_faults(
    *, near: tuple[str, ...], engines: tuple[str, ...] = (), quick: bool, peers: Path | None
) -> list[str]:
    """Return what does not go with ``--near``, a sentence each."""
    if not near:
        return []
    given = {"--engine": bool(engines), "--quick": quick, "--peers": peers is not None}
    return [
        f"{name} is for times, and --near measures none; leave one of them out"
        for name, is_given in given.items()
        if is_given
    ]
