"""The roughness of an interface as a file of a sample says it: alpha, or a file of heights."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError, shown
from optipath.paths.format.faults import Faults
from optipath.surfaces.fields.height_field import HeightField

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

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
    path = faults.attempt(".heights", _beside, folder, name)
    if faults or path is None:
        raise SurfaceError(*faults)
    size, periodic = table["size"], table.get("periodic", False)
    made = faults.attempt(
        f".heights '{name}'", HeightField.from_file, path, size, periodic=periodic
    )
    if faults or made is None:
        raise SurfaceError(*faults)
    return made


def _beside(folder: Path, name: str) -> Path:
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
