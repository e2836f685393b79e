"""``optipath surface reproduce``: published experiments on rough surfaces, done again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath.cli.console import JSON, PlainConsole, cell, headed, say_json
from optipath.cli.misplaced import StrictCommand
from optipath.cli.surface_options import SEED, THREADS, whole
from optipath.errors import SurfaceError
from optipath.lab.published.experiment_files import experiment_names, load_experiment
from optipath.paths.format.faults import Faults

if TYPE_CHECKING:
    from optipath.lab.published.experiment import Experiment
    from optipath.lab.published.reproduction import Reproduced


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
    # Neither a list nor a wrong name needs numbers.
    from optipath.cli.printed_reproduction import (  # noqa: PLC0415
        print_reproduced,
        reproduced_as_json,
    )

    done: list[tuple[Experiment, list[Reproduced]]] = []
    try:
        for experiment in experiments:
            done.append((experiment, []))
            try:
                _run(*done[-1], **options)
            finally:
                if done[-1][1] and not as_json:
                    print_reproduced(*done[-1], first=len(done) == 1)
    finally:
        if as_json and done and done[0][1]:
            whole = len(done) == len(experiments) and all(
                len(found) == len(experiment.measurements) for experiment, found in done
            )
            several = [reproduced_as_json(*one) for one in done if one[1]]
            say_json({"experiments": several, "interrupted": not whole})


def _run(experiment: Experiment, found: list[Reproduced], **options: Any) -> None:
    """Do an experiment again; what has been found stays where Ctrl-C comes."""
    from optipath.cli.photon_bar import photon_bar  # noqa: PLC0415
    from optipath.lab.published.reproduction import reproduce  # noqa: PLC0415

    with photon_bar(experiment.name) as progress:
        for one in reproduce(experiment, progress=progress, **options):
            found += [one]


def _list(experiments: list[Experiment], *, as_json: bool) -> None:
    if as_json:
        say_json({one.name: one.description for one in experiments})
        return
    table = headed("experiment", "what it is", box=None)
    for one in experiments:
        table.add_row(cell(one.name), cell(f"{one.description} ({one.source})"))
    PlainConsole().print(table)


reproduce = click.command(
    "reproduce", cls=StrictCommand, params=[NAMES, LISTED, PHOTONS, SEED, THREADS, JSON]
)(_reproduce)
