"""``optipath plot``: a picture of a preset and its light, in a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath.cli.console import say
from optipath.cli.plot_kinds import KINDS, drawn
from optipath.cli.plot_request import request_of
from optipath.cli.preset_command import READS, PresetGroup
from optipath.cli.text_files import NewFile, check_place
from optipath.errors import OptipathError
from optipath.values.picture_files import check_form

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from optipath.cli.chosen import Chosen

KIND = click.Option(["--kind"], type=click.Choice([*KINDS]), help="What is drawn; needed.")
X = click.Option(
    ["--x"],
    metavar="NAME",
    multiple=True,
    help="Of curve and poincare: the parameter that varies, over its usual range unless its own "
    "option gives several values. Of two, curve draws a map.",
)
Y = click.Option(
    ["--y"],
    metavar="NAME,NAME",
    help="Of curve: what goes up; S0 (by default) to S3, DoP, DoLP, AoP, ellipticity, psi, delta.",
)
DETECTOR = click.Option(
    ["--detector"],
    metavar="NAME",
    help="Of ellipse, stokes, mueller, curve and poincare with --x: at which detector or dump.",
)
OUT = click.Option(
    ["--out"],
    type=NewFile(),
    metavar="FILE",
    help="Draw into this file, which is needed; its ending is .png, .svg or .pdf.",
)


def _plot(chosen: Chosen, *, kind: str, out: Path, **asked: Any) -> None:
    """Draw a preset, or a TOML file, and its light into a file."""
    # Before anything is computed: it tells whether what draws is there.
    from optipath.plots import save  # noqa: PLC0415 - an extra

    save(drawn(request_of(chosen, kind, KINDS[kind].counts, **asked)), out)
    say(f"wrote {out}")


def _faults(*, kind: str | None, out: Path | None, **asked: Any) -> list[str]:
    faults = _kind_faults(kind, asked)
    if out is None:
        return [*faults, "--out is missing, and a picture is drawn into a file; add --out plot.png"]
    try:
        check_form(out)
        check_place(out)
    except OptipathError as error:
        faults += error.faults
    except click.ClickException as error:
        faults.append(error.format_message())
    return faults


def _kind_faults(kind: str | None, asked: Mapping[str, Any]) -> list[str]:
    if kind is None:
        return [f"--kind is missing; say what is drawn, one of {', '.join(KINDS)}"]
    return [
        f"--{option} is of {' or '.join(takers)}, and --kind {kind} has none; leave it out"
        for option in ("x", "y", "detector")
        if asked[option] not in (None, ()) and option not in KINDS[kind].takes
        for takers in [[name for name, one in KINDS.items() if option in one.takes]]
    ]


plot = PresetGroup("plot", _plot, (KIND, X, Y, DETECTOR, READS, OUT), ranges=True, faults=_faults)
