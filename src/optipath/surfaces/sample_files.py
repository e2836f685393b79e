"""Sample files: rough and layered samples by name or path."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, PresetError, SurfaceError, shown
from optipath.materials.index_domains import INDEX
from optipath.paths.files.schema import FORMAT, Faults, as_meant, joined, readable, type_faults
from optipath.paths.files.toml import file_of, names_in, parsed, presets_folder, text_of
from optipath.paths.files.values import decode, references_in
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.sample import Sample
from optipath.surfaces.sample_layers import SampleLayer

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike
    from pathlib import Path


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

    >>> sample_descriptions()["glass-rough"]
    'A rough face of glass, lit from the air'
    """
    from optipath.paths.files.toml import parsed  # noqa: PLC0415 - not for every import

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
        path = file_of(sample, _WHAT, _folder(), "`optipath surface`")
        text = text_of(path, _WHAT)
    except PresetError as error:
        raise SurfaceError(*error.faults) from None
    # A wrong name is told at once.

    return sample_of_text(text, path)


def _folder() -> Path:
    return presets_folder() / "samples"


TOP: dict[str, Any] = {"format": int, "description": str, "layers": list, "outside": object}
TOP |= {"cells": object, "surfaces": int, "seed": int, "periodic": bool}
LAYER: dict[str, Any] = {"index": object, "alpha": object, "heights": str, "size": object}
LAYER |= {"periodic": bool}

_INDEX, _ROUGHNESS = 1.5, (0.1, 0.1)
"""What takes the place of what is faulty, so that the rest is checked too."""


def sample_of_text(text: str, path: Path) -> Sample:
    """Return the sample that a text describes, as `Sample.to_toml` writes it."""
    try:
        document = parsed(text, str(path))
    except PresetError as error:
        raise SurfaceError(*error.faults) from None
    try:
        return _sample(document, path.parent)
    except OptipathError as error:
        raise SurfaceError(*joined(error.within("file")), about=path.name) from None


def _sample(document: dict[str, Any], folder: Path) -> Sample:
    number = document.get("format", FORMAT)
    if number != FORMAT or isinstance(number, bool):
        raise SurfaceError(f"format is {shown(number)}, but this version reads format {FORMAT}")
    faults = Faults(type_faults("the sample", document, TOP))
    if "format" not in document:
        faults.append(f"the sample: 'format' is missing; add format = {FORMAT}")
    if not as_meant(document, TOP).get("layers"):
        faults.append("the sample has no layers; add a table [[layers]] for each, from the top")
    argument = readable(document, TOP)
    tables = argument.pop("layers", [])
    outside = faults.attempt("outside", _index, argument.pop("outside", 1.0))
    argument |= {"outside": 1.0 if outside is None else outside}
    layers = [_layer(f"layers[{at}]", table, folder, faults) for at, table in enumerate(tables)]
    argument.pop("format", None)
    made = faults.attempt("", Sample, layers or [(_INDEX, _ROUGHNESS)], **argument)
    if made is None or faults:
        raise SurfaceError(*faults)
    return made


def _layer(where: str, table: Any, folder: Path, faults: Faults) -> SampleLayer:
    """Return a layer, in which something else stands for what is faulty."""
    if not isinstance(table, dict):
        faults.append(f"{where} must be a table headed [[layers]], not {shown(table)}")
        return SampleLayer(_INDEX, _ROUGHNESS)
    faults += type_faults(where, table, LAYER)
    argument = readable(table, LAYER)
    if "index" not in argument:
        faults.append(f"{where}: 'index' is missing; write that of the medium below")
    index = faults.attempt(f"{where}.index", _index, argument.get("index", _INDEX))
    rough = None
    if "heights" in argument or "heights" not in as_meant(table, LAYER):
        rough = faults.attempt(where, roughness_of_table, argument, folder)
    return SampleLayer(_INDEX if index is None else index, *(rough or (_ROUGHNESS,)))


def _index(raw: Any) -> Any:
    """Return an index of refraction, as presets write it."""
    if references_in(raw):
        raise SurfaceError("a sample has no parameters; write a number, or a table of a material")
    if isinstance(raw, list):
        raise SurfaceError(
            f"{shown(raw)} is a list; write one index, such as 1.5 or {{ n = 0.5, k = 2.1 }}"
        )
    return decode(raw, INDEX, {})


_LARGEST = 256 * 1024 * 1024
_LONGEST = 200
_NAME = re.compile(r"[\w-][\w. -]*(/[\w-][\w. -]*)*")


def roughness_of_table(table: Mapping[str, Any], folder: Path) -> tuple[Any, str]:
    """Return the roughness of an interface, and the file that it has been read from."""
    if "heights" in table:
        return _heights(table, folder), table["heights"]
    faults = [
        f"'{key}' is of heights out of a file; leave it out"
        for key in ("size", "periodic")
        if key in table
    ]
    if "alpha" not in table:
        faults.append(
            "'alpha' is missing; write alpha = 0.1, alpha = 0 for a flat interface, or heights "
            '= "FILE" with a size'
        )
    if faults:
        raise SurfaceError(*faults)
    return table["alpha"], ""


def _heights(table: Mapping[str, Any], folder: Path) -> HeightField:
    faults = Faults()
    if "alpha" in table:
        faults.append("'alpha' and 'heights' say one thing twice; leave one of them out")
    if "size" not in table:
        faults.append(
            "'size' is missing; write the lengths of the sides along x and y in the unit of the "
            "heights, such as size = [100.0, 80.0]"
        )
    name = table["heights"]
    path = faults.attempt(".heights", _in_folder, folder, name)
    if faults or path is None:
        raise SurfaceError(*faults)
    size, periodic = table["size"], table.get("periodic", False)
    made = faults.attempt(
        f".heights '{name}'", HeightField.from_file, path, size, periodic=periodic
    )
    if faults or made is None:
        raise SurfaceError(*faults)
    return made


def _in_folder(folder: Path, name: str) -> Path:
    """Return the path of a file of heights, which is in the folder of the sample's."""
    if not _NAME.fullmatch(name) or len(name) > _LONGEST:
        raise SurfaceError(
            f"{shown(name)} is no name of a file beside that of the sample; write one such as "
            f'"heights.npy" or "maps/heights.tif"'
        )
    path = folder / name
    try:
        if not path.resolve().is_relative_to(folder.resolve()):
            raise SurfaceError(f"'{name}' leads out of the folder of the sample; put it there")
        if not path.is_file():
            raise SurfaceError(f"'{name}' is no file beside that of the sample")
        size = path.stat().st_size
    except (OSError, RuntimeError) as error:  # A link that leads to itself is the second.
        raise SurfaceError(f"'{name}' cannot be read: {error}") from None
    if size > _LARGEST:
        raise SurfaceError(
            f"'{name}' is larger than {_LARGEST // 1024**2} MiB; cut out a part of it, or give it "
            f"to HeightField.from_file in Python"
        )
    return path
