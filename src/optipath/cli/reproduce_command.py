"""``optipath surface reproduce``: published experiments on rough surfaces, done again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click
import numpy as np

from optipath.cli import console
from optipath.cli.arguments import SEED, THREADS, whole
from optipath.cli.console import JSON, PlainConsole, cell, headed, say_json, title
from optipath.cli.options import StrictCommand
from optipath.cli.surface_output import measured
from optipath.errors import SurfaceError
from optipath.materials.quantities import plain
from optipath.paths.files.schema import Faults
from optipath.surfaces import reproduction
from optipath.surfaces.reproduction import experiment_names, load_experiment

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.table import Table

    from optipath.surfaces.reproduction import Experiment, Reproduced


def _names(_ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[str]:
    """Return the experiments whose names begin so, for shells."""
    return [name for name in experiment_names() if name.startswith(incomplete)]


NAMES = click.Argument(
    ["names"], nargs=-1, required=False, metavar="[NAME]...", shell_complete=_names
)
LISTED = click.Option(["--list", "listed"], is_flag=True, help="List the experiments, run none.")
PHOTONS = click.Option(
    ["--photons"],
    type=whole,
    metavar="NUMBER",
    help="How many photons are walked from each direction; by default as the experiment says.",
)


def _reproduce(names: tuple[str, ...], *, listed: bool, as_json: bool, **options: Any) -> None:
    """Do published experiments again: those that are named, by name or file, or all of them.

    Prints what is published beside what is computed, with its standard error and the pixels that
    it is of.
    """
    faults = Faults()
    loaded = [faults.attempt("", load_experiment, name) for name in names or experiment_names()]
    if faults:
        raise SurfaceError(*faults)
    experiments = [one for one in loaded if one is not None]
    if listed:
        _list(experiments, as_json=as_json)
        return
    done: list[tuple[Experiment, list[Reproduced]]] = []
    try:
        for experiment in experiments:
            results: list[Reproduced] = []
            done.append((experiment, results))
            try:
                with console.photon_bar(experiment.name) as progress:
                    for one in reproduction.reproduce(experiment, progress=progress, **options):
                        results.append(one)  # noqa: PERF402 - each stays where Ctrl-C comes
            finally:
                if results and not as_json:
                    print_reproduced(experiment, results, first=len(done) == 1)
    finally:
        if as_json and done and done[0][1]:
            whole = len(done) == len(experiments) and all(
                len(result) == len(experiment.measurements) for experiment, result in done
            )
            several = [reproduced_as_json(*one) for one in done if one[1]]
            say_json({"experiments": several, "interrupted": not whole})


def _list(experiments: list[Experiment], *, as_json: bool) -> None:
    if as_json:
        say_json({one.name: one.description for one in experiments})
        return
    rows = [(one.name, f"{one.description} ({one.source})") for one in experiments]
    PlainConsole().print(headed("experiment", "what it is", rows=rows, box=None))


reproduce = click.command(
    "reproduce", cls=StrictCommand, params=[NAMES, LISTED, PHOTONS, SEED, THREADS, JSON]
)(_reproduce)


_COLUMNS = "measured", "incidence", "published", "computed", "agrees", "pixel"
_AGREES = {None: "", True: "yes", False: "no"}


def print_reproduced(
    experiment: Experiment, results: Sequence[Reproduced], *, first: bool = True
) -> None:
    """Print what is published of a sample, and what has been measured."""
    page = PlainConsole()
    if not first:
        page.print()
    page.print(title(experiment.name, experiment.description))
    photons = f"{results[0].photons:,} photons a direction" if results else "nothing measured"
    page.print(cell(f"{experiment.source}; {photons}"))
    for text in dict.fromkeys(one.measurement.text for one in results):
        page.print()
        page.print(cell(f'"{text}"'))
        several = [one for one in results if one.measurement.text == text]
        for mask in dict.fromkeys(one.found.mask for one in several):
            page.print(_table([one for one in several if one.found.mask == mask]))
            if mask:
                page.print(cell(f"of {mask}"))
    page.print()
    for measure in dict.fromkeys(one.measurement.measure for one in results):
        page.print(cell(f"{measure}: {reproduction.MEASURES[measure].told}"))


def _table(several: Sequence[Reproduced]) -> Table:
    rows = [[*_row(one)] for one in several]
    # Columns without any entry tell nothing.
    stored = [at for at in range(len(_COLUMNS)) if any(row[at] for row in rows)]
    shown = [[row[at] for at in stored] for row in rows]
    return headed(*[_COLUMNS[at] for at in stored], rows=shown, box=None)


def _row(one: Reproduced) -> Iterator[str]:
    request = one.measurement
    mesh = f", {request.walks.cells} cells" if request.walks.cells else ""
    yield request.measure
    yield f"{request.walks.incidence}{mesh}"
    yield (
        ""
        if request.published is None
        else " to ".join(dict.fromkeys(f"{number:g}" for number in request.published))
    )
    yield "none" if np.isnan(one.found.value) else measured(one.found.value, one.found.error)
    yield _AGREES[one.agrees]
    yield one.found.pixel


def reproduced_as_json(experiment: Experiment, results: Sequence[Reproduced]) -> dict[str, Any]:
    """Return what has been measured as JSON can hold it, with all digits."""
    return {
        "experiment": experiment.name,
        "description": experiment.description,
        "source": experiment.source,
        "measurements": [_as_json(one) for one in results],
    }


def _as_json(one: Reproduced) -> dict[str, Any]:
    request = one.measurement
    return {
        "measure": request.measure,
        "text": request.text,
        "incidence": request.walks.incidence,
        "wavelengths": [*request.walks.wavelengths],
        "cells": request.walks.cells,
        "stokes": [*request.stokes],
        "published": None if request.published is None else [*request.published],
        "within": request.within,
        "value": plain(np.asarray(one.found.value)),
        "standard_error": plain(np.asarray(one.found.error)),
        "agrees": one.agrees,
        "mask": one.found.mask,
        "pixel": one.found.pixel,
        "photons": one.photons,
    }
