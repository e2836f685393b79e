"""Presets: optical set-ups by name, and files of a user's own by path."""

from __future__ import annotations

from numbers import Integral
from typing import TYPE_CHECKING, Any, Never

from optipath.errors import ParameterError, PresetError
from optipath.faults import closest, shown, there_are
from optipath.paths.files.schema import file_of, names_in, parsed, presets_folder, text_of

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping
    from os import PathLike
    from pathlib import Path

    from optipath.paths.path_graph import PathGraph


def preset_names() -> list[str]:
    """Return the names of the presets that come with the library, sorted.

    Examples
    --------
    >>> "npgr026" in preset_names()
    True
    """
    return names_in(presets_folder())


def preset_descriptions() -> dict[str, str]:
    """Return what each preset is, by name, without making its path.

    >>> preset_descriptions()["glass-slab"][:15]
    'A slab of glass'
    """
    files = {name: locate(name) for name in preset_names()}
    return {name: parsed(text_of(f, "preset"), str(f))["description"] for name, f in files.items()}


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
        A name out of `preset_names`, or the path of a TOML file of one's own.
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
    return file_of(preset, "preset", presets_folder(), "`optipath presets`")


def read_preset(path: Path) -> PathGraph:
    """Return the path that a file describes."""
    from optipath.paths.files.reader import path_of_text  # noqa: PLC0415 - not for all

    return path_of_text(text_of(path, "preset"), str(path), path.name)
