"""Samples that stand ready, by name, and files of one's own, by path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.errors import PresetError, SurfaceError
from optipath.paths.presets.toml_files import file_of, names_in, presets_folder, text_of
from optipath.values.cures import cure

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path

    from optipath.surfaces.samples.sample import Sample

_WHAT = "sample"


def sample_names() -> list[str]:
    """Return the names of the samples that come with the library, sorted.

    Examples
    --------
    >>> "glass-on-glass" in sample_names()
    True
    """
    return names_in(_folder())


def sample_descriptions() -> dict[str, str]:
    """Return what each sample that comes with the library is, by name, without making it.

    Examples
    --------
    >>> sample_descriptions()["glass-rough"]
    'A rough face of glass, lit from the air'
    """
    from optipath.paths.presets.toml_text import parsed  # noqa: PLC0415 - not for every import

    files = {name: _folder() / f"{name}.toml" for name in sample_names()}
    return {name: parsed(text_of(f, _WHAT), str(f))["description"] for name, f in files.items()}


def load_sample(sample: str | PathLike[str]) -> Sample:
    """Return a sample out of its file.

    Parameters
    ----------
    sample : str or path
        A name out of `sample_names`, or the path of a TOML file of one's own.

    Returns
    -------
    Sample

    Raises
    ------
    SurfaceError
        If there is no such sample, or with every fault of its file.

    Examples
    --------
    >>> load_sample("glass-on-glass").layers
    ((1.5, 0.1), (2.4, 0.1))
    """
    try:
        names = cure("op.sample_names()", "`optipath surface`")
        path = file_of(sample, _WHAT, _folder(), names)
        text = text_of(path, _WHAT)
    except PresetError as error:
        raise SurfaceError(*error.faults) from None
    # A wrong name is told at once.
    from optipath.surfaces.samples.sample_tables import sample_of_text  # noqa: PLC0415

    return sample_of_text(text, path)


def _folder() -> Path:
    return presets_folder() / "samples"
