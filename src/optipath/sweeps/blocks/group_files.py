"""The files of a store that are there before its blocks: whether they are whole."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from optipath.errors import JobError
from optipath.sweeps.blocks.job_record import OTHER_PLACE

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.sweeps.blocks.block_job import BlockJob

_ALL = ".zmetadata"


def check_group(folder: Path, job: BlockJob) -> None:
    """Refuse a store of which a file is damaged or gone that no block writes again.

    Parameters
    ----------
    folder : Path
        Where it is.
    job : BlockJob
        What is kept in it.

    Raises
    ------
    JobError
        Naming the file; nothing of it is changed.
    """
    told = _read(folder, _ALL).get("metadata")
    needed = [".zgroup", *(f"{name}/.zarray" for name in (*job.arrays, *job.coords))]
    if not isinstance(told, dict) or not {*needed} <= told.keys():
        raise _damaged(folder, _ALL)
    for name, content in told.items():
        if name.startswith("blocks/"):  # Who reads marks tells of them.
            continue
        found = _read(folder, name)
        # Attributes may have been added by hand, and a group may list what is in it.
        if name.endswith(".zarray") and found != content:
            raise _damaged(folder, name)
    for name, whole in job.coords.items():
        file = f"{name}/{'.'.join('0' * whole.values.ndim) or '0'}"
        if not ((folder / file).is_file() and (folder / file).stat().st_size):
            raise _damaged(folder, file)


def _read(folder: Path, name: str) -> dict[str, Any]:
    try:
        found = json.loads((folder / name).read_bytes())
    except (OSError, ValueError):
        found = None
    if not isinstance(found, dict):
        raise _damaged(folder, name)
    return found


def _damaged(folder: Path, name: str) -> JobError:
    return JobError(f"the file '{folder / name}' is damaged or gone; {OTHER_PLACE}: '{folder}'")
