"""Files of rough and layered samples: found by name or path, read and written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from optipath.errors import OptipathError, PresetError, SurfaceError
from optipath.faults import shown
from optipath.materials.index_domains import INDEX
from optipath.paths.files.schema import (
    FORMAT,
    Faults,
    checked_table,
    file_of,
    files_in,
    parsed,
    presets_folder,
    text_of,
)
from optipath.paths.files.values import decode, encode, references_in
from optipath.paths.files.writer import toml_lines
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.sample import Sample, SampleLayer

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from os import PathLike
    from pathlib import Path


_FOLDER = presets_folder() / "samples"

T = TypeVar("T")


def sample_names() -> list[str]:
    """Return the names of the samples that come with the library, sorted.

    Examples
    --------
    >>> "glass-on-glass" in sample_names()
    True
    """
    return [*files_in(_FOLDER)]


def sample_descriptions() -> dict[str, str]:
    """Return what each sample that comes with the library is, by name, without making it."""
    files = files_in(_FOLDER).items()
    return {name: parsed(text_of(f, "sample"), str(f))["description"] for name, f in files}


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
    return sample_of_text(*text_and_file(sample, "sample", _FOLDER, "`optipath surface`"))


def text_and_file(argument: Any, what: str, folder: Path, see: str) -> tuple[str, Path]:
    """Return the text of the file that a name or a path stands for, and where it is."""
    try:
        path = file_of(argument, what, files_in(folder), see)
        return text_of(path, what), path
    except PresetError as error:
        raise SurfaceError(*error.faults) from None


def described(
    text: str,
    path: Path,
    known: Mapping[str, Any],
    needed: Sequence[str],
    made: Callable[[dict[str, Any], Path], T],
) -> T:
    """Return what is made of a text and of the folder of its file, which all faults name."""
    try:
        document = parsed(text, str(path))
    except PresetError as error:
        raise SurfaceError(*error.faults) from None
    try:
        checked_table(document, known, ("format", *needed))
        if (number := document["format"]) != FORMAT:
            raise SurfaceError(f"format is {number}, but this version reads format {FORMAT}")
        return made(document, path.parent)
    except OptipathError as error:
        raise SurfaceError(*error.within("file"), about=path.name) from None


_TOP: dict[str, Any] = {"format": int, "description": str, "layers": list, "outside": object}
_TOP |= {"cells": object, "surfaces": int, "seed": int, "periodic": bool}
_LAYER: dict[str, Any] = {"index": object, "alpha": object, "heights": str, "size": object}
_LAYER |= {"periodic": bool}


def sample_of_text(text: str, path: Path) -> Sample:
    """Return the sample that a text describes, as `Sample.to_toml` writes it."""
    return described(text, path, _TOP, ["layers"], _sample)


def _sample(document: dict[str, Any], folder: Path) -> Sample:
    faults = Faults()
    tables = enumerate(document["layers"])
    layers = [faults.attempt(f"layers[{at}]", _layer, each, folder) for at, each in tables]
    others = {key: value for key, value in document.items() if key not in ("format", "layers")}
    if "outside" in others:
        others["outside"] = faults.attempt("outside", _index, others["outside"])
    SurfaceError.raise_for(faults)
    return Sample(layers, **others)


def _layer(table: Any, folder: Path) -> SampleLayer:
    checked_table(table, _LAYER, ["index"])
    faults = Faults()
    index: Any = faults.attempt(".index", _index, table["index"])
    if ("heights" in table) != ("size" in table) or ("heights" in table) == ("alpha" in table):
        faults.append(
            "an interface is rough by its 'alpha' (0 is flat), or by 'heights' with a 'size' and, "
            'if it is, periodic = true; write alpha = 0.1, or heights = "FILE" and size = [X, Y]'
        )
    name, rough = table.get("heights", ""), table.get("alpha")
    if not faults and rough is None:
        rough = faults.attempt(f".heights {shown(name)}", _heights, table, folder)
    SurfaceError.raise_for(faults)
    return SampleLayer(index, rough, name)


def _index(raw: Any) -> Any:
    """Return an index of refraction, as presets write it."""
    if references_in(raw):
        raise SurfaceError("a sample has no parameters; write a number, or a table of a material")
    if isinstance(raw, list):
        raise SurfaceError(
            f"{shown(raw)} is a list; write one index, such as 1.5 or {{ n = 0.5, k = 2.1 }}"
        )
    return decode(raw, INDEX, {})


def _heights(table: Mapping[str, Any], folder: Path) -> HeightField:
    """Return the heights of a file in the folder of the sample's, or below it."""
    path = folder / table["heights"]
    try:
        if not path.resolve().is_relative_to(folder.resolve()):
            raise SurfaceError("leads out of the folder of the sample; put it there")
    except (OSError, RuntimeError, ValueError) as error:  # A link to itself, or no name at all.
        raise SurfaceError(f"cannot be read: {error}") from None
    return HeightField.from_file(path, table["size"], periodic=table.get("periodic", False))


def toml_of(options: Mapping[str, Any], layers: Sequence[SampleLayer]) -> str:
    """Return the text of the file of a sample."""
    faults = Faults()
    top = {"format": FORMAT} | {
        name: value if isinstance(value, bool) else faults.attempt(name, encode, value, "")
        for name, value in options.items()
    }
    rows = [faults.attempt(f"layers[{at}]", _row, layer) for at, layer in enumerate(layers)]
    SurfaceError.raise_for(faults)
    return "\n".join([toml_lines("", top), *[toml_lines("[[layers]]", row or {}) for row in rows]])


def _row(layer: SampleLayer) -> dict[str, Any]:
    index, rough = {"index": encode(layer.index, "")}, layer.roughness
    if not isinstance(rough, HeightField):
        along_x, along_y = rough
        return index | {"alpha": along_x if along_x == along_y else [along_x, along_y]}
    if rough.is_flat:
        return index | {"alpha": 0.0}
    if not layer.file:
        raise SurfaceError(
            "its heights are in no file that it knows of; save them by numpy.save('heights.npy', "
            'field.heights), and load a sample whose file has heights = "heights.npy"'
        )
    row = index | {"heights": layer.file, "size": [*rough.size]}
    return row | ({"periodic": True} if rough.periodic else {})
