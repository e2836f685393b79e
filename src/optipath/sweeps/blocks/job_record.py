"""What a store of blocks says of the job that it is of, and whether it is damaged."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import JobError, shown
from optipath.sweeps.blocks.block_marks import damaged_files, object_of

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.sweeps.blocks.block_job import BlockJob

FORMAT = 2
"""That of stores as they are written now."""

OTHER_PLACE = "take another name, or delete it"
RECORD = "blocks/.zattrs"
FILES = "blocks/files"
"""The mark of the files that are there before any block."""

_METADATA = (".zarray", ".zattrs")


def record_of(job: BlockJob) -> dict[str, Any]:
    """Return all that two jobs have in common if blocks of one may stand for those of the other."""
    arrays = {
        name: [[*each.dims], [*map(int, each.shape)], [*map(int, each.chunks)], each.dtype]
        for name, each in job.arrays.items()
    }
    return {"format": FORMAT, "identity": job.identity, "blocks": job.blocks, "arrays": arrays}


def check_record(folder: Path, record: dict[str, Any]) -> None:
    """Refuse a folder that is not the store of a job."""
    if not folder.is_dir():
        raise JobError(f"'{folder}' is there, and is no folder; {OTHER_PLACE}")
    if not (folder / RECORD).exists():
        raise JobError(f"'{folder}' is there, and is no store of blocks; {OTHER_PLACE}")
    found = object_of(folder / RECORD)
    version, identity = found.get("format"), found.get("identity")
    if version is None or not isinstance(identity, str):
        raise JobError(f"the record '{folder / RECORD}' is damaged; {OTHER_PLACE}: '{folder}'")
    if version != FORMAT:
        raise JobError(
            f"'{folder}' has format {shown(version)}, and this version of optipath knows {FORMAT}; "
            f"use the version that made it, or {OTHER_PLACE}"
        )
    if found != record:
        difference = _difference(identity, record["identity"]) or _layout(found, record)
        raise JobError(f"'{folder}' holds blocks of another job{difference}; {OTHER_PLACE}")


def group_attrs(job: BlockJob) -> dict[str, Any]:
    """Return the attributes of the group of a job."""
    # Coordinates that do not bear the name of a dimension are told apart by this attribute.
    others = [name for name, each in job.coords.items() if each.dims != (name,)]
    return {**job.attrs, **({"coordinates": " ".join(others)} if others else {})}


def check_files(folder: Path, about: str, job: BlockJob) -> None:
    """Refuse a store of which a file is damaged or gone that no block writes again."""
    damaged = [*damaged_files(folder, FILES, about)]
    if damaged and not ({*damaged} <= {".zattrs", ".zmetadata"} and _has_notes(folder, job)):
        raise JobError(
            f"the file '{folder / damaged[0]}' is damaged or gone; {OTHER_PLACE}: '{folder}'"
        )


def _has_notes(folder: Path, job: BlockJob) -> bool:
    """Tell whether attributes were added by hand to the group, and nothing else is changed.

    Zarr writes them into both of its files: what is in one alone is damage.
    """
    attrs, found = group_attrs(job), object_of(folder / ".zattrs")
    told = object_of(folder / ".zmetadata").get("metadata")
    needed = {f"{name}/{each}" for name in (*job.arrays, *job.coords) for each in _METADATA}
    return (
        isinstance(told, dict)
        and {".zgroup", ".zattrs", *needed} <= told.keys()
        and attrs.items() < found.items()
        and all(content == object_of(folder / name) for name, content in told.items())
    )


def _difference(there: str, here: str) -> str:
    """Return where two identities begin to differ, ready to be put behind a fault."""
    for line_there, line_here in zip(there.splitlines(), here.splitlines(), strict=False):
        if line_there != line_here:
            return f": it has {shown(line_there)}, where this one has {shown(line_here)}"
    return ""


def _layout(there: dict[str, Any], here: dict[str, Any]) -> str:
    """Return what else of two records differs, ready to be put behind a fault."""
    for name, value in here.items():
        if there.get(name) != value:
            return f": it has {name} {shown(there.get(name))}, where this one has {shown(value)}"
    return ""
