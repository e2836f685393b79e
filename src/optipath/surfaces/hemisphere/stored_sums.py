"""Sums over photons, of which each chunk is kept as soon as it is walked."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from optipath.surfaces.energy_shares import processors
from optipath.surfaces.hemisphere.beam import CHUNK, PartSums
from optipath.sweeps.blocks import active_client, keep_blocks

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.surfaces.hemisphere.chunks import ChunkJob


def sums_in_store(
    job: ChunkJob,
    store: str,
    scheduler: Any,
    threads: Any,
    progress: Callable[[int, int], None] | None,
) -> PartSums:
    """Walk those chunks that a store does not hold, and add up all of them in their order."""
    if scheduler is None:
        scheduler = active_client() or "synchronous"
    if threads is None:
        threads = processors() if scheduler == "synchronous" else 1

    def tell(chunks: int, _: int) -> None:
        if progress is not None:
            progress(min(CHUNK * chunks, job.photons), job.photons)

    # Whoever asks is warned of coarse meshes, and not workers.
    job.seen.beam.sample.fields()
    group = keep_blocks(replace(job, threads=int(threads)), store, scheduler, tell)
    there = [group[name] for name in PartSums._fields]
    result = PartSums.none(job.seen.shape)
    for number in range(job.blocks):
        result.add(PartSums(*(each[number] for each in there)))  # type: ignore[arg-type, index]
    return result
