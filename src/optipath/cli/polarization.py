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
    from optipath.polarization_matters import Polarization

_ROWS = 20


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
    """Return the numbers of each path, a row each."""
    heads = ["exact", "scalar", "difference", "it can be", *found.elements]
    table = Table(escape(f"S0 at {name}"), *map(escape, heads), header_style="bold")
    indices = list(np.ndindex(found.exact.shape))
    bounds = found.certificate.lower - 1.0, found.certificate.upper - 1.0
    for index in indices[:_ROWS]:
        lower, upper = (_percent(part[index]) for part in bounds)
        row = [
            str(list(index)) if index else "",
            f"{found.exact[index]:.6g}",
            f"{found.scalar[index]:.6g}",
            _percent(found.difference[index]),
            f"{lower} .. {upper}",
            *(_percent(share[index]) for share in found.elements.values()),
        ]
        table.add_row(*map(Text, row))
    if len(indices) > _ROWS:
        table.add_row(f"{len(indices) - _ROWS} more")
    return table


def _verdict(found: Polarization) -> str:
    largest = float(np.max(np.abs(found.difference), initial=0.0))
    if not found.culprit:
        return "no element makes the intensity depend on polarisation"
    return (
        f"without polarisation S0 is wrong by up to {100.0 * largest:.3g} % of the scalar result; "
        f"most of it comes in by {found.culprit}"
    )


def _percent(share: Any) -> str:
    return f"{100.0 * float(share):+.3g} %"
