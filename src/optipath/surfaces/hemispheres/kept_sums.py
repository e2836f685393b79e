"""Sums over photons, of which each chunk is kept as soon as it is walked."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import zarr

from optipath.errors import JobError
from optipath.surfaces.energies.given_run import processors
from optipath.surfaces.hemispheres.part_sums import PartSums
from optipath.surfaces.hemispheres.sensed_beam import CHUNK
from optipath.sweeps.blocks.keep_blocks import keep_blocks
from optipath.sweeps.blocks.workers import active_client

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from optipath.surfaces.hemispheres.chunk_job import ChunkJob


def kept_sums(
    job: ChunkJob,
    store: Path,
    scheduler: Any,
    threads: Any,
    progress: Callable[[int, int], None] | None,
) -> PartSums:
    """Walk those chunks that a store does not hold, and add up all of them in their order.

    Parameters
    ----------
    job : ChunkJob
        What is measured.
    store, scheduler, threads, progress
        As `measure` takes them.

    Returns
    -------
    PartSums

    Raises
    ------
    JobError
        If the store holds something else, or cannot be written or read.
    """
    if scheduler is None:
        scheduler = active_client() or "synchronous"
    if threads is None:
        threads = processors() if scheduler == "synchronous" else 1

    def tell(chunks: int, _: int) -> None:
        if progress is not None:
            progress(min(CHUNK * chunks, job.photons), job.photons)

    # Whoever asks is warned of coarse meshes, and not workers.
    job.seen.beam.sample.fields()
    folder = keep_blocks(replace(job, threads=int(threads)), store, scheduler, tell)
    there = [zarr.open_array(str(folder / name), mode="r") for name in PartSums._fields]
    found = PartSums.none(job.seen.shape)
    for number in range(job.blocks):
        found.add(_read(folder, there, number))
    return found


def _read(folder: Path, there: Iterable[zarr.Array[Any]], number: int) -> PartSums:
    """Return the sums of a chunk."""
    try:
        return PartSums(*(each[number] for each in there))  # type: ignore[arg-type]
    except (OSError, RuntimeError, ValueError, KeyError, TypeError) as fault:
        raise JobError(
            f"chunk {number} of '{folder}' cannot be read ({fault}); delete "
            f"'{folder / 'blocks' / 'done' / f'{number}.0'}' and start again, and this chunk alone "
            f"is walked once more"
        ) from None
