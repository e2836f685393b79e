"""``optipath polarization``: what polarisation does to the intensities of a preset."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click
import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from optipath.cli.preset_command import JSON, PresetGroup
from optipath.polarization_matters import polarization as found_for
from optipath.presets import load_preset

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.polarization_matters import Polarization

_PATHS = 5


def _polarization(preset: str, case: str | None, values: dict[str, Any], *, as_json: bool) -> None:
    path = load_preset(preset, case=case, **values)
    ends = [name for name, end in path.graph.nodes(data="element") if end.kind == "detector"]
    found = {name: found_for(path, name) for name in ends}
    if as_json:
        detectors = {name: _as_json(one) for name, one in found.items()}
        click.echo(json.dumps({"preset": preset, "detectors": detectors}))
        return
    console = Console()
    console.print(Text(preset, style="bold"), Text(path.description))
    for name, one in found.items():
        console.print(_table(name, one))
        console.print(Text(_verdict(one)))


polarization = PresetGroup(
    "polarization",
    action=_polarization,
    options=(JSON,),
    help="Show what polarisation does to the intensity, beside the scalar result.",
)


def _as_json(found: Polarization) -> dict[str, Any]:
    certificate = found.certificate
    return {
        "exact": found.exact.tolist(),
        "scalar": found.scalar.tolist(),
        "difference": found.difference.tolist(),
        "lower": certificate.lower.tolist(),
        "upper": certificate.upper.tolist(),
        "elements": {name: share.tolist() for name, share in found.elements.items()},
        "culprit": found.culprit or None,
    }


def _table(name: str, found: Polarization) -> Table:
    """Return the numbers of each path, a column each."""
    indices = list(np.ndindex(found.exact.shape))
    shown = indices[:_PATHS]
    table = Table(escape(f"S0 at {name}"), header_style="bold")
    for index in shown:
        table.add_column(escape(str(list(index))) if index else "")
    bounds = (part - 1.0 for part in (found.certificate.lower, found.certificate.upper))
    rows: list[tuple[str, Any, Callable[[Any], str]]] = [
        ("exact", found.exact, "{:.6g}".format),
        ("scalar: without polarisation", found.scalar, "{:.6g}".format),
        ("difference", found.difference, _percent),
        *zip(("at least", "at most"), bounds, (_percent, _percent), strict=True),
        *((f"by {element}", share, _percent) for element, share in found.elements.items()),
    ]
    for head, numbers, written in rows:
        table.add_row(*map(Text, [head, *(written(float(numbers[index])) for index in shown)]))
    if len(indices) > len(shown):
        table.add_row(f"{len(indices) - len(shown)} more paths")
    return table


def _verdict(found: Polarization) -> str:
    largest = float(np.max(np.abs(found.difference), initial=0.0))
    if not found.culprit:
        return "no element makes the intensity depend on polarisation"
    return (
        f"polarisation changes S0 by up to {100.0 * largest:.3g} %; {found.culprit} brings the "
        f"most of it in"
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:+.3g} %"
