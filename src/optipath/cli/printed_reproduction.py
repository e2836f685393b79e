"""Published numbers beside those that have been measured, as a table and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed, title
from optipath.cli.printed_energy import measured
from optipath.lab.published.measured_quantities import MEASURES
from optipath.values.plain_json import plain

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.table import Table

    from optipath.lab.published.experiment import Experiment
    from optipath.lab.published.reproduction import Reproduced

_COLUMNS = "measured", "incidence", "published", "computed", "agrees", "pixel"
_AGREES = {None: "", True: "yes", False: "no"}


def print_reproduced(
    experiment: Experiment, found: Sequence[Reproduced], *, first: bool = True
) -> None:
    """Print what is published of a sample, and what has been measured."""
    console = PlainConsole()
    if not first:
        console.print()
    console.print(title(experiment.name, experiment.description))
    photons = f"{found[0].photons:,} photons a direction" if found else "nothing measured"
    console.print(cell(f"{experiment.source}; {photons}"))
    for text in dict.fromkeys(one.measurement.text for one in found):
        console.print()
        console.print(cell(f'"{text}"'))
        several = [one for one in found if one.measurement.text == text]
        for mask in dict.fromkeys(one.found.mask for one in several):
            console.print(_table([one for one in several if one.found.mask == mask]))
            if mask:
                console.print(cell(f"of {mask}"))
    console.print()
    for measure in dict.fromkeys(one.measurement.measure for one in found):
        console.print(cell(f"{measure}: {MEASURES[measure].told}"))


def _table(several: Sequence[Reproduced]) -> Table:
    rows = [[*_row(one)] for one in several]
    # Columns without any entry tell nothing.
    kept = [at for at in range(len(_COLUMNS)) if any(row[at] for row in rows)]
    table = headed(*(_COLUMNS[at] for at in kept), box=None)
    for row in rows:
        table.add_row(*(cell(row[at]) for at in kept))
    return table


def _row(one: Reproduced) -> Iterator[str]:
    asked = one.measurement
    mesh = f", {asked.walks.cells} cells" if asked.walks.cells else ""
    yield asked.measure
    yield f"{asked.walks.incidence}{mesh}"
    yield (
        ""
        if asked.published is None
        else " to ".join(dict.fromkeys(f"{number:g}" for number in asked.published))
    )
    yield "none" if np.isnan(one.found.value) else measured(one.found.value, one.found.error)
    yield _AGREES[one.agrees]
    yield one.found.pixel


def reproduced_as_json(experiment: Experiment, found: Sequence[Reproduced]) -> dict[str, Any]:
    """Return what has been measured as JSON can hold it, with all digits."""
    return {
        "experiment": experiment.name,
        "description": experiment.description,
        "source": experiment.source,
        "measurements": [_as_json(one) for one in found],
    }


def _as_json(one: Reproduced) -> dict[str, Any]:
    asked = one.measurement
    return {
        "measure": asked.measure,
        "text": asked.text,
        "incidence": asked.walks.incidence,
        "wavelengths": [*asked.walks.wavelengths],
        "cells": asked.walks.cells,
        "stokes": [*asked.stokes],
        "published": None if asked.published is None else [*asked.published],
        "within": asked.within,
        "value": plain(np.asarray(one.found.value)),
        "standard_error": plain(np.asarray(one.found.error)),
        "agrees": one.agrees,
        "mask": one.found.mask,
        "pixel": one.found.pixel,
        "photons": one.photons,
    }
