"""Workers: a thread, threads, processes or a cluster that compute blocks."""

from __future__ import annotations

import sys
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import cloudpickle
import dask
from dask.system import CPU_COUNT

from optipath.errors import JobError, shown, unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


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
        yield Workers(AtOnce(), lambda: 1)
    elif argument == "threads":
        with ThreadPoolExecutor(CPU_COUNT) as executor:
            yield Workers(executor, lambda: _AHEAD * CPU_COUNT)
    else:
        # It takes a second to import.
        from optipath.sweeps.cluster import client_of, threads_of  # noqa: PLC0415

        with client_of(argument, blocks) as client, dask.config.set(_LARGE_JOBS):
            yield Workers(
                Travelling(client.get_executor(pure=False)),
                lambda: _AHEAD * threads_of(client),
                stay=argument != "processes",
            )


def active_client() -> Any:
    """Return the client of a cluster that is active in this process, or None."""
    result = sys.modules.get("distributed")
    if result is None:
        return None
    try:
        return result.default_client()
    except ValueError:
        return None


class AtOnce(Executor):
    """An executor that does what it is given there and then."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Do it, and return what came of it."""
        done: Future[Any] = Future()
        try:
            done.set_result(fn(*args, **kwargs))
        except Exception as error:  # noqa: BLE001 - whoever asks for the result gets it
            done.set_exception(error)
        return done


class Travelling(Executor):
    """An executor of a cluster that reports why a worker cannot load its task."""

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
