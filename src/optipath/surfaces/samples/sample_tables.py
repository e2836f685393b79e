"""The sample that the text of a file describes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, SurfaceError, shown
from optipath.paths.format.codec import decode
from optipath.paths.format.faults import Faults, joined
from optipath.paths.format.references import references_in
from optipath.paths.format.schema import FORMAT, as_meant, type_faults
from optipath.paths.presets.toml_text import parsed
from optipath.spelling import few_suggestions
from optipath.surfaces.samples.heights_of_files import roughness_of_table
from optipath.surfaces.samples.sample import Sample
from optipath.surfaces.samples.sample_layer import SampleLayer
from optipath.values.cures import of_files
from optipath.values.domains.indices import INDEX
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    from pathlib import Path

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
        with few_suggestions(), units_are_written(), of_files():
            return _sample(document, path.parent)
    except OptipathError as error:
        about = "" if str(path) in error.faults[0] else path.name
        raise SurfaceError(*joined(error.faults), about=about) from None


def _sample(document: dict[str, Any], folder: Path) -> Sample:
    number = document.get("format", FORMAT)
    if number != FORMAT or isinstance(number, bool):
        raise SurfaceError(f"format is {shown(number)}, but this version reads format {FORMAT}")
    faults = Faults(type_faults("the sample", document, TOP))
    if "format" not in document:
        faults.append(f"the sample: 'format' is missing; add format = {FORMAT}")
    if not as_meant(document, TOP).get("layers"):
        faults.append("the sample has no layers; add a table [[layers]] for each, from the top")
    given = _readable(document, TOP)
    tables = given.pop("layers", [])
    outside = faults.attempt("outside", _index, given.pop("outside", 1.0))
    given |= {"outside": 1.0 if outside is None else outside}
    layers = [_layer(f"layers[{at}]", table, folder, faults) for at, table in enumerate(tables)]
    given.pop("format", None)
    made = faults.attempt("", Sample, layers or [(_INDEX, _ROUGHNESS)], **given)
    if made is None or faults:
        raise SurfaceError(*faults)
    return made


def _layer(where: str, table: Any, folder: Path, faults: Faults) -> SampleLayer:
    """Return a layer, in which something else stands for what is faulty."""
    if not isinstance(table, dict):
        faults.append(f"{where} must be a table headed [[layers]], not {shown(table)}")
        return SampleLayer(_INDEX, _ROUGHNESS)
    faults += type_faults(where, table, LAYER)
    given = _readable(table, LAYER)
    if "index" not in given:
        faults.append(f"{where}: 'index' is missing; write that of the medium below")
    index = faults.attempt(f"{where}.index", _index, given.get("index", _INDEX))
    rough = None
    if "heights" in given or "heights" not in as_meant(table, LAYER):
        rough = faults.attempt(where, roughness_of_table, given, folder)
    return SampleLayer(_INDEX if index is None else index, *(rough or (_ROUGHNESS,)))


def _readable(table: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """Return what a table has by keys that are known or meant, where it is of the right type."""
    meant = as_meant(table, schema)
    return {key: value for key, value in meant.items() if schema[key] in (object, type(value))}


def _index(raw: Any) -> Any:
    """Return an index of refraction, as presets write it."""
    if references_in(raw):
        raise SurfaceError("a sample has no parameters; write a number, or a table of a material")
    if isinstance(raw, list):
        raise SurfaceError(
            f"{shown(raw)} is a list; write one index, such as 1.5 or {{ n = 0.5, k = 2.1 }}"
        )
    return decode(raw, INDEX, {})
