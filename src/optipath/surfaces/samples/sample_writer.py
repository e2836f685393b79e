"""Writing a sample as the text of a file."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError
from optipath.paths.format.codec import encode
from optipath.paths.format.faults import Faults
from optipath.paths.format.schema import FORMAT
from optipath.paths.format.writer import toml_lines
from optipath.surfaces.fields.height_field import HeightField

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.samples.sample_layer import SampleLayer


def toml_of(sample: Sample) -> str:
    """Return the text of the file of a sample.

    Parameters
    ----------
    sample : Sample
        What is written.

    Returns
    -------
    str
        In TOML.

    Raises
    ------
    SurfaceError
        With every layer that has no form in a file.
    """
    faults = Faults()
    top: dict[str, Any] = {"format": FORMAT, "description": sample.description}
    for field in fields(sample):
        value = getattr(sample, field.name)
        if field.name in ("layers", "description") or value == field.default:
            continue
        as_it_is = isinstance(value, bool)
        top[field.name] = value if as_it_is else faults.attempt(field.name, encode, value, "")
    rows = [
        faults.attempt(f"layers[{place}]", _row, layer) for place, layer in enumerate(sample.layers)
    ]
    if faults:
        raise SurfaceError(*faults)
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
            "has heights that are in no file; save them by numpy.save('heights.npy', "
            'field.heights), and load a sample whose file has heights = "heights.npy"'
        )
    row = index | {"heights": layer.file, "size": [*rough.size]}
    return row | ({"periodic": True} if rough.periodic else {})
