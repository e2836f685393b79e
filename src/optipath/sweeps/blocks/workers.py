"""Who computes blocks: this thread, threads, processes, or a cluster, all as one executor."""

from __future__ import annotations

import sys
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

import dask
from dask.system import CPU_COUNT

from optipath.errors import JobError, shown, unknown
from optipath.sweeps.blocks.executors import AtOnce, Travelling

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
    found = sys.modules.get("distributed")
    if found is None or not isinstance(scheduler, found.Client):
        raise JobError(
            f"a scheduler is one of {', '.join(SCHEDULERS)}, a distributed.Client or the address "
            f"of a cluster, not {shown(scheduler)}; of a cluster, give cluster.get_client()"
        )


@contextmanager
def workers_of(scheduler: Any, blocks: int) -> Iterator[Workers]:
    """Have those at work whom a scheduler stands for; those who are made for it go afterwards."""
    given = active_client() or "threads" if scheduler is None else scheduler
    if given == "synchronous":
        yield Workers(AtOnce(), lambda: 1)
    elif given == "threads":
        with ThreadPoolExecutor(CPU_COUNT) as executor:
            yield Workers(executor, lambda: _AHEAD * CPU_COUNT)
    else:
        # It takes a second to import.
        from optipath.sweeps.blocks.cluster import client_of, threads_of  # noqa: PLC0415

        with client_of(given, blocks) as client, dask.config.set(_LARGE_JOBS):
            yield Workers(
                Travelling(client.get_executor(pure=False)),
                lambda: _AHEAD * threads_of(client),
                stay=given != "processes",
            )


def active_client() -> Any:
    """Return the client of a cluster that is active in this process, or None."""
    found = sys.modules.get("distributed")
    if found is None:
        return None
    try:
        return found.default_client()
    except ValueError:
        return None
