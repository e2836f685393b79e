"""A large job, computed block after block by whatever computes, and kept."""

from __future__ import annotations

from concurrent.futures import FIRST_COMPLETED, CancelledError, wait
from contextlib import closing
from itertools import islice
from typing import TYPE_CHECKING, Any

from optipath.errors import JobError, OptipathError
from optipath.sweeps.store import BlockStore
from optipath.sweeps.workers import check_scheduler, workers_of
from optipath.values.files import input_file

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from concurrent.futures import Future
    from os import PathLike
    from pathlib import Path

    from optipath.sweeps.jobs import BlockJob, BlockPart
    from optipath.sweeps.workers import Workers


def keep_blocks(
    job: BlockJob,
    store: str | PathLike[str],
    scheduler: Any = None,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Compute those blocks of a job that its store does not hold, and keep each when it is done.

    The store is removed after an error that left no block, unless cluster workers may still write
    to it. Every block that is done stays, whatever ends the rest, and two runs may share a store.
    Sums over blocks are made from the store in the order of blocks, so they do not depend on the
    order of computing.

    >>> from tempfile import TemporaryDirectory
    >>> from types import SimpleNamespace
    >>> import numpy as np
    >>> import xarray as xr
    >>> from optipath.sweeps.jobs import StoredArray
    >>> job = SimpleNamespace(
    ...     identity="squares of 0 to 5, in blocks of 2",
    ...     blocks=3,
    ...     arrays={"square": StoredArray(("number",), (6,), (2,))},
    ...     coords={},
    ...     attrs={"title": "squares"},
    ... )
    >>> def compute(block):
    ...     region = slice(2 * block, 2 * block + 2)
    ...     return {"square": ((region,), np.arange(6.0)[region] ** 2)}
    >>> job.compute = compute
    >>> with TemporaryDirectory() as folder:
    ...     with xr.open_zarr(keep_blocks(job, f"{folder}/squares.zarr")) as found:
    ...         print(found.square.values)
    [ 0.  1.  4.  9. 16. 25.]
    """
    check_scheduler(scheduler)
    stored = BlockStore.of(job, input_file(store, JobError))
    done = stored.done(job)
    missing = [number for number in range(job.blocks) if number not in done]
    _tell(progress, len(done), job)
    if missing:
        are_at_work = False
        try:
            with (
                workers_of(scheduler, len(missing)) as workers,
                closing(_handed_out(job, stored, missing, workers)) as result,
            ):
                are_at_work = workers.stay
                for finished, _ in enumerate(result, len(done) + 1):
                    _tell(progress, finished, job)
        except KeyboardInterrupt:
            # Blocks that were in work have come to their end meanwhile.
            _tell(progress, sum(map(stored.holds, range(job.blocks))), job)
            raise
        except OptipathError:
            if not are_at_work:  # They might write into another job's store of the same name.
                stored.discard_unused()
            raise
    return stored.folder


def _tell(progress: Callable[[int, int], None] | None, done: int, job: BlockJob) -> None:
    if progress is not None:
        progress(done, job.blocks)


def _handed_out(
    job: BlockJob, stored: BlockStore, numbers: list[int], workers: Workers
) -> Generator[int]:
    """Yield the numbers of blocks as they are done, of which a few at a time are handed out."""
    ahead = iter(numbers)
    pending: dict[Future[OptipathError | None], int] = {}
    try:
        while True:
            for number in islice(ahead, max(workers.handed_out() - len(pending), 0)):
                part = _sent(job, number)
                pending[workers.executor.submit(_keep_block, part, stored, number)] = number
            if not pending:
                return
            for each in wait(pending, return_when=FIRST_COMPLETED).done:
                number = pending.pop(each)
                _raise_fault(each, number)
                yield number
    finally:
        for each in pending:
            each.cancel()


def _sent(job: BlockJob, number: int) -> BlockPart:
    """Return what of a job is sent for a block."""
    part: Callable[[int], BlockPart] | None = getattr(job, "part", None)
    return job if part is None else part(number)


def _keep_block(job: BlockPart, stored: BlockStore, number: int) -> OptipathError | None:
    """Compute a block and keep it; return what is wrong, which clusters log where it is raised."""
    try:
        # Another run, or a worker that was thought lost, may have done it.
        if not stored.holds(number):
            stored.keep(number, job.compute(number))
    except OptipathError as fault:
        return fault
    return None


def _raise_fault(finished: Future[OptipathError | None], number: int) -> None:
    """Raise what went wrong with a block, as it is or, where its worker was lost, in a sentence."""
    try:
        message = finished.result()
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
    if message is not None:
        raise message
