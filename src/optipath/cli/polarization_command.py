"""``optipath polarization``: what polarisation does to the intensities of a preset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import DIGITS, JSON, PlainConsole, cell, headed, title
from optipath.cli.preset_command import PresetGroup
from optipath.faults import listed
from optipath.materials.quantities import plain
from optipath.paths.polarization import polarization as polarization_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rich.table import Table

    from optipath.cli.preset_command import Cases
    from optipath.paths.path_graph import PathGraph
    from optipath.paths.polarization import Polarization


_PATHS = 5

_SMALL = 1e-12
"""Which share of the intensity is no more than rounding."""


def _polarization(cases: Cases, *, as_json: bool, digits: int) -> None:
    """Show what polarisation does to the intensity, beside the scalar result."""
    results = cases.each(lambda one: _polarizations(one.path()))
    if as_json:
        cases.say_json(results, _as_json)
        return
    console = PlainConsole()
    for chosen, result in zip(cases, results.values(), strict=True):
        console.print(title(chosen.title, chosen.opened.description))
        for name, one in result.items():
            console.print(_table(name, one, digits))
            console.print(cell(_verdict(one)))


polarization = PresetGroup("polarization", _polarization, (JSON, DIGITS), several=True)


def _polarizations(path: PathGraph) -> dict[str, Polarization]:
    """Return what polarisation does at every detector."""
    ends = [name for name, end in path.graph.nodes(data="element") if end.kind == "detector"]
    return {name: polarization_of(path, name) for name in ends}


def _as_json(results: Mapping[str, Polarization]) -> dict[str, Any]:
    return {"detectors": {name: _one_as_json(one) for name, one in results.items()}}


def _one_as_json(result: Polarization) -> dict[str, Any]:
    numbers = {name: plain(getattr(result, name)) for name in ("exact", "scalar", "difference")}
    bounds = {name: plain(getattr(result.certificate, name)) for name in ("lower", "upper")}
    elements = {name: plain(share) for name, share in result.elements.items()}
    return {**numbers, **bounds, "elements": elements, "culprits": list(result.culprits)}


def _table(name: str, result: Polarization, digits: int) -> Table:
    """Return the numbers of each path, a column each."""
    indices = list(np.ndindex(result.exact.shape))
    shown = indices[:_PATHS]
    bounds = {"at least": result.certificate.lower - 1.0, "at most": result.certificate.upper - 1.0}
    shares = {"difference": result.difference, **bounds}
    for element, share in result.elements.items():
        if np.any(np.abs(share) > _SMALL):
            shares[f"by {element}"] = share
    powers = {"exact": result.exact, "scalar: without polarisation": result.scalar}
    rows = [[h, *(f"{one[index]:.{digits}g}" for index in shown)] for h, one in powers.items()]
    rows += [[h, *(_percent(float(one[index])) for index in shown)] for h, one in shares.items()]
    if len(indices) > len(shown):
        rows.append([f"{len(indices) - len(shown)} more paths"])
    heads = [str(list(index)) if index else "" for index in shown]
    return headed(f"S0 at {name}", *heads, rows=rows)


def _verdict(result: Polarization) -> str:
    if not np.any(result.scalar > 0.0):
        return "dark: there is nothing to compare"
    largest = float(np.max(np.abs(result.difference), initial=0.0))
    text = f"polarisation changes S0 by up to {100.0 * largest:.3g} %"
    if largest >= _SMALL:
        return f"{text}, most of it by {listed(result.culprits)}"
    if not result.elements:
        return "polarisation changes nothing"
    lower, upper = np.min(result.certificate.lower) - 1.0, np.max(result.certificate.upper) - 1.0
    if upper - lower < _SMALL:
        return "polarisation changes nothing"
    return (
        f"{text} here, but could by {_percent(lower)} .. {_percent(upper)} if the elements stood "
        f"otherwise"
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:+.3g} %" if abs(share) > _SMALL else "0 %"
