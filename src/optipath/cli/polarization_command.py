"""``optipath polarization``: what polarisation does to the intensities of a preset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed, say_json
from optipath.cli.plain_json import plain
from optipath.cli.preset_command import JSON, PresetGroup
from optipath.errors import listed
from optipath.paths.polarization_matters import polarization as found_for

if TYPE_CHECKING:
    from rich.table import Table

    from optipath.cli.preset_command import Chosen
    from optipath.paths.polarization_matters import Polarization

_PATHS = 5

_SMALL = 1e-12
"""Which share of the intensity is no more than rounding."""


def _polarization(chosen: Chosen, *, as_json: bool) -> None:
    """Show what polarisation does to the intensity, beside the scalar result."""
    path, preset = chosen.path(), chosen.preset
    ends = [name for name, end in path.graph.nodes(data="element") if end.kind == "detector"]
    found = {name: found_for(path, name) for name in ends}
    if as_json:
        detectors = {name: _as_json(one) for name, one in found.items()}
        say_json({"preset": preset, "detectors": detectors})
        return
    console = PlainConsole()
    console.print(cell(preset, style="bold"), cell(path.description))
    for name, one in found.items():
        console.print(_table(name, one))
        console.print(cell(_verdict(one)))


polarization = PresetGroup("polarization", _polarization, [JSON])


def _as_json(found: Polarization) -> dict[str, Any]:
    numbers = {name: plain(getattr(found, name)) for name in ("exact", "scalar", "difference")}
    bounds = {name: plain(getattr(found.certificate, name)) for name in ("lower", "upper")}
    elements = {name: plain(share) for name, share in found.elements.items()}
    return {**numbers, **bounds, "elements": elements, "culprits": list(found.culprits)}


def _table(name: str, found: Polarization) -> Table:
    """Return the numbers of each path, a column each."""
    indices = list(np.ndindex(found.exact.shape))
    shown = indices[:_PATHS]
    table = headed(f"S0 at {name}")
    for index in shown:
        table.add_column(cell(str(list(index))) if index else "")
    for head, powers in (("exact", found.exact), ("scalar: without polarisation", found.scalar)):
        table.add_row(head, *(f"{powers[index]:.6g}" for index in shown))
    shares = {
        "difference": found.difference,
        "at least": found.certificate.lower - 1.0,
        "at most": found.certificate.upper - 1.0,
    }
    for element, share in found.elements.items():
        if np.any(np.abs(share) > _SMALL):
            shares[f"by {element}"] = share
    for head, share in shares.items():
        table.add_row(cell(head), *(_percent(float(share[index])) for index in shown))
    if len(indices) > len(shown):
        table.add_row(f"{len(indices) - len(shown)} more paths")
    return table


def _verdict(found: Polarization) -> str:
    if not np.any(found.scalar > 0.0):
        return "dark: there is nothing to compare"
    largest = float(np.max(np.abs(found.difference), initial=0.0))
    certificate = found.certificate
    lower, upper = np.min(certificate.lower) - 1.0, np.max(certificate.upper) - 1.0
    if largest < _SMALL and upper - lower < _SMALL:
        return "polarisation changes nothing"
    text = f"polarisation changes S0 by up to {100.0 * largest:.3g} %"
    if largest < _SMALL:
        return (
            f"{text} here, but could by {_percent(lower)} .. {_percent(upper)} if the elements "
            f"stood otherwise"
        )
    return f"{text}, most of it by {listed(found.culprits)}"


def _percent(share: float) -> str:
    return f"{100.0 * share:+.3g} %"
