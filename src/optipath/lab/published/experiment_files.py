"""Experiments that stand ready, by name, and files of one's own, by path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import PresetError, SurfaceError
from optipath.paths.presets.toml_files import file_of, names_in, presets_folder, text_of

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path

    from optipath.lab.published.experiment import Experiment

_WHAT = "experiment"


def experiment_names() -> list[str]:
    """Return the names of the experiments that come with the library, sorted.

    Examples
    --------
    >>> experiment_names()[0]
    'wang-2017-figure-4'
    """
    return names_in(_folder())


def load_experiment(experiment: str | PathLike[str]) -> Experiment:
    """Return an experiment out of its file.

    Examples
    --------
    >>> print(load_experiment("wang-2017-table-1").source)
    M. Wang et al., Optics Express 25(19), 2017, table 1
    """
    try:
        path = file_of(experiment, _WHAT, _folder(), "`optipath surface reproduce --list`")
        text = text_of(path, _WHAT)
    except PresetError as error:
        raise SurfaceError(*error.faults) from None
    # A wrong name is told at once.
    from optipath.lab.published.experiment_tables import experiment_of_text  # noqa: PLC0415

    return experiment_of_text(text, path, str(experiment))


def _folder() -> Path:
    return presets_folder() / "experiments"
