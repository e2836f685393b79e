"""``optipath surface reproduce``: published experiments on rough surfaces, done again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click
import numpy as np

from optipath.cli import console
from optipath.cli.arguments import SEED, THREADS, number
from optipath.cli.console import JSON, PlainConsole, cell, headed, say_json, title
from optipath.cli.options import StrictCommand, completed_by
from optipath.cli.surface_output import measured
from optipath.errors import SurfaceError
from optipath.materials.quantities import plain
from optipath.paths.files.schema import Faults
from optipath.surfaces import reproduction
from optipath.surfaces.reproduction import experiment_names, load_experiment

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from optipath.surfaces.reproduction import Experiment, Reproduced


NAMES = click.Argument(
    ["names"], nargs=-1, metavar="[NAME]...", shell_complete=completed_by(experiment_names)
)
LISTED = click.Option(["--list", "listed"], is_flag=True, help="List the experiments, run none.")
PHOTONS = click.Option(
    ["--photons"],
    type=number,
    help="Photons from each direction; by default as the experiment says.",
)


def _reproduce(names: tuple[str, ...], *, listed: bool, as_json: bool, **options: Any) -> None:
    """Do published experiments again: those that are named, by name or file, or all of them.

    Prints what is published beside what is computed, with its standard error and the pixels that
    it is of.
    """
    faults = Faults()
    loaded = [faults.attempt("", load_experiment, name) for name in names or experiment_names()]
    SurfaceError.raise_for(faults)
    experiments = [one for one in loaded if one is not None]
    if listed and as_json:
        say_json({one.name: one.description for one in experiments})
    elif listed:
        rows = [(one.name, f"{one.description} ({one.source})") for one in experiments]
        PlainConsole().print(headed("experiment", "what it is", rows=rows, box=None))
    else:
        _run(experiments, as_json=as_json, **options)


def _run(experiments: Sequence[Experiment], *, as_json: bool, **options: Any) -> None:
    """Do experiments; print each at once, or all in one JSON object, also where Ctrl-C comes."""
    done: list[dict[str, Any]] = []
    interrupted = True
    try:
        for number, experiment in enumerate(experiments):
            results: list[Reproduced] = []
            try:
                with console.photon_bar(experiment.name) as progress:
                    for one in reproduction.reproduce(experiment, progress=progress, **options):
                        results.append(one)  # noqa: PERF402 - each stays where Ctrl-C comes
            finally:
                if results:
                    done.append(reproduced_as_json(experiment, results))
                if results and not as_json:
                    _print(experiment, results, first=number == 0)
        interrupted = False
    finally:
        if as_json and done:
            say_json({"experiments": done, "interrupted": interrupted})


reproduce = click.command(
    "reproduce", cls=StrictCommand, params=[NAMES, LISTED, PHOTONS, SEED, THREADS, JSON]
)(_reproduce)


_COLUMNS = "measured", "incidence", "published", "computed", "agrees", "pixel"
_AGREES = {None: "", True: "yes", False: "no"}


def _print(experiment: Experiment, results: Sequence[Reproduced], *, first: bool) -> None:
    """Print what is published of a sample, and what has been measured."""
    page = PlainConsole()
    if not first:
        page.print()
    page.print(title(experiment.name, experiment.description))
    page.print(cell(f"{experiment.source}; {results[0].photons:,} photons a direction"))
    tables: dict[str, dict[str, list[Reproduced]]] = {}
    for one in results:
        tables.setdefault(one.measurement.text, {}).setdefault(one.found.mask, []).append(one)
    for text, by_mask in tables.items():
        page.print()
        page.print(cell(f'"{text}"'))
        for mask, several in by_mask.items():
            # Columns without any entry tell nothing.
            columns = zip(_COLUMNS, *map(_row, several), strict=True)
            heads, *rows = zip(*[one for one in columns if any(one[1:])], strict=True)
            page.print(headed(*heads, rows=rows, box=None))
            if mask:
                page.print(cell(f"of {mask}"))
    page.print()
    for measure in dict.fromkeys(one.measurement.measure for one in results):
        page.print(cell(f"{measure}: {reproduction.MEASURES[measure].told}"))


def _row(one: Reproduced) -> Iterator[str]:
    request, found = one.measurement, one.found
    yield request.measure
    yield request.incidence + (f", {request.cells} cells" if request.cells else "")
    yield " to ".join(dict.fromkeys(f"{number:g}" for number in request.published or ()))
    yield "none" if np.isnan(found.value) else measured(found.value, found.error)
    yield _AGREES[one.agrees]
    yield found.pixel


def reproduced_as_json(experiment: Experiment, results: Sequence[Reproduced]) -> dict[str, Any]:
    """Return what has been measured as JSON can hold it, with all digits."""
    return {
        "experiment": experiment.name,
        "description": experiment.description,
        "source": experiment.source,
        "measurements": [_as_json(experiment, one) for one in results],
    }


def _as_json(experiment: Experiment, one: Reproduced) -> dict[str, Any]:
    request, found = one.measurement, one.found
    return {
        "measure": request.measure,
        "text": request.text,
        "incidence": request.incidence,
        "wavelengths": [*experiment.wavelengths],
        "cells": request.cells,
        "stokes": [*request.stokes],
        "published": None if request.published is None else [*request.published],
        "within": request.within,
        "value": plain(np.asarray(found.value)),
        "standard_error": plain(np.asarray(found.error)),
        "agrees": one.agrees,
        "mask": found.mask,
        "pixel": found.pixel,
        "photons": one.photons,
    }
