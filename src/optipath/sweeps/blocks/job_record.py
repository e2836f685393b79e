"""What a store of blocks says of the job that it is of."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from optipath.errors import JobError, shown

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.sweeps.blocks.block_job import BlockJob

FORMAT = 1
"""That of stores as they are written now."""

OTHER_PLACE = "take another name, or delete it"


def record_of(job: BlockJob) -> dict[str, Any]:
    """Return all that two jobs have in common if blocks of one may stand for those of the other."""
    arrays = {
        name: [[*each.dims], [*map(int, each.shape)], [*map(int, each.chunks)], each.dtype]
        for name, each in job.arrays.items()
    }
    return {"format": FORMAT, "identity": job.identity, "blocks": job.blocks, "arrays": arrays}


def check_record(folder: Path, file: Path, job: BlockJob) -> None:
    """Refuse a folder that is not the store of a job.

    Parameters
    ----------
    folder : Path
        What is there where the job would be kept.
    file : Path
        Where its record would be.
    job : BlockJob
        What is to be kept.

    Raises
    ------
    JobError
        If it is something else; nothing of it is changed.
    """
    if not folder.is_dir():
        raise JobError(f"'{folder}' is there, and is no folder; {OTHER_PLACE}")
    if not file.is_file():
        raise JobError(f"'{folder}' is there, and is no store of blocks; {OTHER_PLACE}")
    try:
        found = json.loads(file.read_bytes())
        version, identity = found["format"], found["identity"]
    except (ValueError, KeyError, TypeError):
        raise JobError(f"the record '{file}' is damaged; {OTHER_PLACE}: '{folder}'") from None
    if version != FORMAT:
        raise JobError(
            f"'{folder}' has format {shown(version)}, and this version of optipath knows {FORMAT}; "
            f"use the version that made it, or {OTHER_PLACE}"
        )
    if found != record_of(job):
        difference = _difference(str(identity), job.identity) or _layout(found, record_of(job))
        raise JobError(f"'{folder}' holds blocks of another job{difference}; {OTHER_PLACE}")


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
