"""A large job, computed block after block by whatever computes, and kept."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
from concurrent.futures import (
    FIRST_COMPLETED,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from contextlib import closing, contextmanager, suppress
from functools import partial
from itertools import islice
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import TYPE_CHECKING, Any, NamedTuple

import cloudpickle
import dask
from dask.local import SynchronousExecutor
from dask.system import CPU_COUNT

from optipath.errors import JobError, OptipathError
from optipath.faults import shown, unknown
from optipath.sweeps.store import BlockStore

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator, Mapping
    from os import PathLike

    from optipath.sweeps.store import BlockJob


def keep_blocks(
    job: BlockJob,
    store: str | PathLike[str],
    scheduler: Any = None,
    progress: Callable[[int, int], None] | None = None,
) -> BlockStore:
    """Compute those blocks of a job that its store does not hold, and keep each when it is done.

    After an error the store stays, unless it is empty and no worker of a cluster may still write to
    it; two runs may share one. Sums over blocks are made from it in the order of blocks.

    >>> from tempfile import TemporaryDirectory
    >>> from types import SimpleNamespace
    >>> import numpy as np
    >>> import xarray as xr
    >>> job = SimpleNamespace(
    ...     identity="squares of 0 to 5, in blocks of 2",
    ...     blocks=3,
    ...     dataset=xr.Dataset({"square": ("number", np.zeros(6))}, attrs={"title": "squares"}),
    ...     chunks={"square": (2,)},
    ... )
    >>> job.places = lambda block: {"square": (slice(2 * block, 2 * block + 2),)}
    >>> job.task = lambda block: lambda: {"square": np.arange(2.0 * block, 2 * block + 2) ** 2}
    >>> with TemporaryDirectory() as folder:
    ...     print(keep_blocks(job, f"{folder}/squares.zarr").arrays["square"][:])
    [ 0.  1.  4.  9. 16. 25.]
    """
    check_scheduler(scheduler)
    stored = BlockStore.of(job, os.fspath(store))
    done = stored.done(job)
    missing = [number for number in range(job.blocks) if number not in done]
    tell = progress or (lambda *_: None)
    tell(len(done), job.blocks)
    if missing:
        are_at_work = False
        try:
            with (
                workers_of(scheduler, len(missing)) as workers,
                closing(_handed_out(job, stored, missing, workers)) as result,
            ):
                are_at_work = workers.stay
                for finished, _ in enumerate(result, len(done) + 1):
                    tell(finished, job.blocks)
        except KeyboardInterrupt:
            # Blocks that were in work have come to their end meanwhile.
            tell(sum(map(stored.holds, range(job.blocks))), job.blocks)
            raise
        except OptipathError:
            if not are_at_work:  # They might write into another job's store of the same name.
                stored.discard_unused()
            raise
    return stored


def _handed_out(
    job: BlockJob, stored: BlockStore, numbers: list[int], workers: Workers
) -> Generator[int]:
    """Yield the numbers of blocks as they are done, of which a few at a time are handed out."""
    ahead = iter(numbers)
    pending: dict[Future[OptipathError | None], int] = {}
    try:
        while True:
            for number in islice(ahead, max(workers.handed_out() - len(pending), 0)):
                arguments = job.task(number), stored, number, job.places(number)
                pending[workers.executor.submit(_keep_block, *arguments)] = number
            if not pending:
                return
            for each in wait(pending, return_when=FIRST_COMPLETED).done:
                number = pending.pop(each)
                _raise_fault(each, number)
                yield number
    finally:
        for each in pending:
            each.cancel()


def _keep_block(
    task: Callable[[], Mapping[str, Any]],
    stored: BlockStore,
    number: int,
    places: Mapping[str, tuple[slice, ...]],
) -> OptipathError | None:
    """Compute a block and keep it; return what is wrong, which clusters log where it is raised."""
    try:
        # Another run, or a worker that was thought lost, may have done it.
        if not stored.holds(number):
            stored.keep(number, places, task())
    except OptipathError as fault:
        return fault
    return None


_LOST = "the cluster was lost; start again when it is back, and what is done is not computed again"


def _raise_fault(finished: Future[OptipathError | None], number: int) -> None:
    """Raise what went wrong with a block, as it is or, where its worker was lost, in a sentence."""
    try:
        message = finished.result()
    except CancelledError:
        raise JobError(_LOST) from None
    except Exception as fault:
        if type(fault).__name__ not in ("KilledWorker", "BrokenProcessPool"):
            raise
        raise JobError(
            f"a process was lost while block {number} was computed, for want of memory perhaps, or "
            f"since a script starts processes outside of if __name__ == '__main__':; make blocks "
            f"smaller or workers fewer and start again, and what is done is not computed again"
        ) from None
    if message is not None:
        raise message


SCHEDULERS = ("synchronous", "threads", "processes")

# A block with long axes is what is sent; there is nothing that a user could do about it.
_LARGE_JOBS = {"distributed.admin.large-graph-warning-threshold": "1 PiB"}

_AHEAD = 2
"""How many blocks a worker is given at a time, so that it need not wait for the next."""


class Workers(NamedTuple):
    """Those who compute."""

    executor: Executor
    handed_out: Callable[[], int]
    stay: bool = False


def check_scheduler(scheduler: Any) -> None:
    """Refuse what is no scheduler."""
    if scheduler is None:
        return
    if isinstance(scheduler, str):
        if "://" not in scheduler and (faults := unknown("scheduler", scheduler, SCHEDULERS)):
            raise JobError(f"{faults[0]}; the address of a cluster begins with 'tcp://'")
        return
    result = sys.modules.get("distributed")
    if result is None or not isinstance(scheduler, result.Client):
        raise JobError(
            f"a scheduler is one of {', '.join(SCHEDULERS)}, a distributed.Client or the address "
            f"of a cluster, not {shown(scheduler)}; of a cluster, give cluster.get_client()"
        )


@contextmanager
def workers_of(scheduler: Any, blocks: int) -> Iterator[Workers]:
    """Have those at work whom a scheduler stands for; those who are made for it go afterwards."""
    argument = active_client() or "threads" if scheduler is None else scheduler
    if argument == "synchronous":
        yield Workers(SynchronousExecutor(), lambda: 1)
    elif argument == "threads":
        with ThreadPoolExecutor(CPU_COUNT) as threads:
            yield Workers(threads, lambda: _AHEAD * CPU_COUNT)
    elif argument == "processes":
        count = min(CPU_COUNT, blocks)
        with ProcessPoolExecutor(count, get_context("spawn"), _obey_parent) as processes:
            yield Workers(Travelling(processes), lambda: _AHEAD * count)
    else:
        with _client_of(argument) as client, dask.config.set(_LARGE_JOBS):
            executor = Travelling(client.get_executor(pure=False))
            yield Workers(executor, lambda: _AHEAD * _threads_of(client), stay=True)


_PATIENCE = 10.0
"""How many seconds a cluster has to answer."""


@contextmanager
def _client_of(argument: Any) -> Iterator[Any]:
    """Have the client of a cluster; what is made for an address is closed afterwards."""
    if not isinstance(argument, str):
        if argument.asynchronous or argument.status != "running":
            how = "asynchronous" if argument.asynchronous else argument.status
            raise JobError(
                f"the client of the cluster is {how}; give one that is connected and waits for "
                f"results, such as distributed.Client(address)"
            )
        yield argument
        return
    from distributed import Client  # noqa: PLC0415 - it takes a second

    try:
        # A client that waits in vain cannot be closed, so that somebody else asks first.
        with ThreadPoolExecutor(1) as elsewhere:
            elsewhere.submit(asyncio.run, _knock(argument)).result()
        client = Client(argument, set_as_default=False)
    except (OSError, ValueError, ImportError, TypeError) as fault:
        raise JobError(
            f"no cluster answers at '{argument}' ({fault}); see that its scheduler runs and that "
            f"the address is as it prints it; where it asks for certificates, give a "
            f"distributed.Client that has them"
        ) from None
    with client:
        yield client


async def _knock(address: str) -> None:
    from distributed import Security  # noqa: PLC0415
    from distributed.comm import connect  # noqa: PLC0415

    certificates = Security().get_connection_args("client")
    await (await connect(address, timeout=_PATIENCE, **certificates)).close()


def _threads_of(client: Any) -> int:
    """Return how many threads a cluster has now; one if it waits for work to have any."""
    try:
        threads: int = sum(client.nthreads().values())
    except (OSError, AttributeError):  # a client that is closed meanwhile has no scheduler
        raise JobError(_LOST) from None
    return max(threads, 1)


def _obey_parent() -> None:
    """Let the process that has started this one, alone, hear Ctrl-C and end it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)


def active_client() -> Any:
    """Return the client of a cluster that is active in this process, or None."""
    with suppress(KeyError, ValueError):
        return sys.modules["distributed"].default_client()
    return None


class Travelling(Executor):
    """An executor of other processes that reports why a worker cannot load its task."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Have it done by a worker, and return what will come of it, or a `JobError`."""
        return self._executor.submit(_unpacked, cloudpickle.dumps(partial(fn, *args, **kwargs)))


def _unpacked(packed: bytes) -> Any:
    try:
        work = cloudpickle.loads(packed)
    except (ImportError, AttributeError) as fault:
        return JobError(
            f"a worker cannot load the job: {fault}; see that what defines it is a module that "
            f"the workers can import, too"
        )
    return work()
