"""A large job, computed block after block by whatever computes, and kept."""

from __future__ import annotations

from concurrent.futures import FIRST_COMPLETED, CancelledError, wait
from itertools import islice
from typing import TYPE_CHECKING, Any

from optipath.errors import JobError
from optipath.sweeps.blocks.block_store import BlockStore
from optipath.sweeps.blocks.workers import workers_of
from optipath.values.given_files import given_file

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Future
    from os import PathLike
    from pathlib import Path

    from optipath.sweeps.blocks.block_job import BlockJob
    from optipath.sweeps.blocks.workers import Workers


def keep_blocks(
    job: BlockJob,
    store: str | PathLike[str],
    scheduler: Any = None,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Compute those blocks of a job that its store does not hold, and keep each when it is done.

    Parameters
    ----------
    job : BlockJob
        What is computed.
    store : str or PathLike
        The folder of a Zarr group, which `xarray.open_zarr` opens as well; made if it is not
        there. Workers on other machines see it under the same name.
    scheduler : str or distributed.Client, optional
        Who computes: ``"synchronous"``, ``"threads"``, ``"processes"``, a client of a cluster, or
        its address such as ``"tcp://127.0.0.1:8786"``; by default the client that is active,
        else threads.
    progress : callable, optional
        Told how many blocks are done, and of how many: at first, and whenever one is.

    Returns
    -------
    Path
        Of the store.

    Raises
    ------
    JobError
        If the store holds something else, cannot be written, or there is nobody to compute.
    """
    kept = BlockStore.of(job, given_file(store, JobError))
    done = kept.done(job.blocks)
    missing = [number for number in range(job.blocks) if number not in done]
    finished = len(done)
    _tell(progress, finished, job)
    if missing:
        with workers_of(scheduler) as workers:
            for _ in _handed_out(job, kept, missing, workers):
                finished += 1
                _tell(progress, finished, job)
    return kept.folder


def _tell(progress: Callable[[int, int], None] | None, done: int, job: BlockJob) -> None:
    if progress is not None:
        progress(done, job.blocks)


def _handed_out(
    job: BlockJob, kept: BlockStore, numbers: list[int], workers: Workers
) -> Iterator[int]:
    """Yield the numbers of blocks as they are done, of which a few at a time are handed out."""
    ahead = iter(numbers)
    pending: dict[Future[None], int] = {}
    try:
        while True:
            for number in islice(ahead, max(workers.handed_out() - len(pending), 0)):
                pending[workers.executor.submit(_keep_block, job, kept, number)] = number
            if not pending:
                return
            for each in wait(pending, return_when=FIRST_COMPLETED).done:
                number = pending.pop(each)
                _raise_fault(each, number)
                yield number
    finally:
        for each in pending:
            each.cancel()


def _keep_block(job: BlockJob, kept: BlockStore, number: int) -> None:
    # Another run, or a worker that was thought lost, may have done it.
    if not kept.holds(number):
        kept.keep(job, number, job.compute(number))


def _raise_fault(finished: Future[None], number: int) -> None:
    """Raise what went wrong with a block, as it is or, where its worker was lost, in a sentence."""
    try:
        finished.result()
    except CancelledError:
        raise JobError(
            f"the cluster was lost while block {number} was computed; start again when it is "
            f"back, and what is done is not computed again"
        ) from None
    except Exception as fault:
        if type(fault).__name__ != "KilledWorker":
            raise
        raise JobError(
            f"the process that computed block {number} was lost again and again, for want of "
            f"memory perhaps; make blocks smaller or workers fewer and start again, and what is "
            f"done is not computed again"
        ) from None
