"""The text of the file of a sample."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError
from optipath.paths.files.schema import FORMAT, Faults
from optipath.paths.files.values import encode
from optipath.paths.files.writer import toml_lines
from optipath.surfaces.height_field import HeightField

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.surfaces.sample_layers import SampleLayer


def toml_of(options: Mapping[str, Any], layers: Sequence[SampleLayer]) -> str:
    """Return the text of the file of a sample."""
    faults = Faults()
    top = {"format": FORMAT} | {
        name: value if isinstance(value, bool) else faults.attempt(name, encode, value, "")
        for name, value in options.items()
    }
    rows = [faults.attempt(f"layers[{at}]", _row, layer) for at, layer in enumerate(layers)]
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
            "its heights are in no file that it knows of; save them by numpy.save('heights.npy', "
            'field.heights), and load a sample whose file has heights = "heights.npy"'
        )
    row = index | {"heights": layer.file, "size": [*rough.size]}
    return row | ({"periodic": True} if rough.periodic else {})
