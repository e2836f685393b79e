"""Presets: optical set-ups by name, and files of a user's own by path."""

from __future__ import annotations

import os
from numbers import Integral
from pathlib import Path
from typing import TYPE_CHECKING, Any, Never

from optipath.errors import OptipathError, ParameterError, PresetError
from optipath.faults import closest, shown, there_are
from optipath.paths.files import schema

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping
    from os import PathLike

    from optipath.paths.path_graph import PathGraph


_HERE = Path("presets")
"""Where a user's own presets are looked for first, which need not exist."""


def preset_names() -> list[str]:
    """Return the names that `load_preset` accepts, sorted: the library's and your own.

    Your own presets are the TOML files in ``./presets`` and in the folders that the environment
    variable ``OPTIPATH_PRESETS`` lists, named ``[a-z0-9-]+``. Where several files have a name, the
    library's is used, then that of the first folder.

    Examples
    --------
    >>> "npgr026" in preset_names()
    True
    """
    return sorted(preset_files()[0])


def preset_files() -> tuple[dict[str, Path], list[Path]]:
    """Return the files of presets by name, the library's first, and files that no name finds."""
    files, unnamed = schema.files_in(schema.presets_folder()), []
    for folder in _own_folders():
        for name, file in schema.files_in(folder).items():
            if not schema.is_name(name) or files.setdefault(name, file) != file:
                unnamed.append(file)
    return files, unnamed


def _own_folders() -> list[Path]:
    """Return ``./presets`` and the folders of ``OPTIPATH_PRESETS``, none of them twice."""
    names = [str(_HERE), *os.environ.get("OPTIPATH_PRESETS", "").split(os.pathsep)]
    places: dict[object, Path] = {_place(schema.presets_folder()): _HERE}
    for folder in map(Path, filter(None, names)):
        places.setdefault(_place(folder), folder)
    return [*places.values()][1:]


def _place(folder: Path) -> object:
    """Return what identifies a folder, by whatever way it is reached; itself where it is none."""
    try:
        status = folder.stat()
    except OSError:
        return folder
    return status.st_dev, status.st_ino


def preset_descriptions(files: Mapping[str, Path] | None = None) -> dict[str, str]:
    """Return what each preset is, or what is wrong with its file, without making its path.

    >>> preset_descriptions()["glass-slab"][:15]
    'A slab of glass'
    """
    files = preset_files()[0] if files is None else files
    return {name: _description(files[name]) for name in sorted(files)}


def _description(file: Path) -> str:
    try:
        document = schema.parsed(schema.text_of(file, "preset"), str(file))
        schema.checked_table(document, schema.TOP, ("format", "elements"))
        return str(document.get("description", ""))
    except OptipathError as error:
        return f"faulty: {error.faults[0]}"


def load_preset(
    preset: str | PathLike[str],
    /,
    *unnamed: Never,
    case: str | int | None = None,
    **values: Any,
) -> PathGraph:
    """Return the path of a preset.

    Parameters
    ----------
    preset : str or path
        A name out of `preset_names`, or the path of a TOML file.
    *unnamed
        None: a case and values are given by name.
    case : str or int, optional
        A named set of values of the preset, which become the defaults of its parameters.
    **values : float, str or array_like
        Parameters that are bound to these values, in radians and metres; they take
        precedence over the case. The others stay open, with their defaults.

    Returns
    -------
    PathGraph
        Elements, links and cases, as the file has them.

    Raises
    ------
    PresetError
        If there is no such preset or case, or its file cannot be read.
    PathError
        With the faults of the file.
    ParameterError
        With every parameter that is unknown or has a value that is not allowed.

    Examples
    --------
    >>> path = load_preset("npgr026", case="8")
    >>> path.trace().stokes.round(4)
    array([ 19.1245,  10.9873, -13.0076,  -8.7079])
    >>> path.trace(delta=["30 deg", "48 deg"]).intensity.round(4)
    array([17.9613, 19.1245])
    """
    path = read_preset(locate(preset))
    if unnamed:
        example = f"load_preset({shown(preset)}, case={shown(unnamed[0])})"
        raise ParameterError(f"a case and values are given by name, as in {example}")
    path = preset_of_case(path, preset, case)
    return path.bind(**values) if values else path


def preset_of_case(
    path: PathGraph, preset: str | PathLike[str], case: str | int | None
) -> PathGraph:
    """Return the path of a preset with the values of a case as its defaults."""
    return path if case is None else path.with_defaults(**_values_of(path, preset, case))


def bound_preset(
    path: PathGraph,
    preset: str | PathLike[str],
    case: str | int | None,
    values: Mapping[str, Any],
    varied: Collection[str] = (),
) -> PathGraph:
    """Return the path of a preset, bound to the values of a case and to others."""
    known = {} if case is None else _values_of(path, preset, case)
    known = {name: value for name, value in known.items() if name not in varied}
    values = beside(path, known, values)
    return path.bind(**values) if values else path


def beside(path: PathGraph, known: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values of a case and others, which take precedence: of a `Material`, its k as well."""
    # Not for every import of the library.
    from optipath.paths.binding import from_materials  # noqa: PLC0415

    gone = from_materials(path.graph, values)
    return {name: value for name, value in known.items() if name not in gone} | {**values}


def _values_of(path: PathGraph, preset: str | PathLike[str], case: str | int) -> Mapping[str, Any]:
    """Return the values of a case."""
    if isinstance(case, Integral) and not isinstance(case, bool):
        case = int(case)
    name = case if isinstance(case, str) else shown(case)
    if name in path.cases:
        return path.cases[name].values
    cure = there_are([*path.cases])
    if near := closest(name, path.cases):
        cure += f"; did you mean '{near}'?"
    raise PresetError(f"case '{name}' is unknown in preset '{preset}'{cure}")


def locate(preset: str | PathLike[str]) -> Path:
    """Return the file of a preset, which need not exist if a path is given."""
    own = [
        f"'{folder}'{'' if folder.is_dir() else ' (no folder)'}"
        for folder in _own_folders()
        if folder.is_dir() or folder != _HERE
    ]
    where = f", also in {', '.join(own)}" if own else ""
    return schema.file_of(preset, "preset", preset_files()[0], "`optipath presets`", where)


def read_preset(path: Path) -> PathGraph:
    """Return the path that a file describes."""
    from optipath.paths.files.reader import path_of_text  # noqa: PLC0415 - not for all

    return path_of_text(schema.text_of(path, "preset"), str(path), path.name)
