"""The client of a cluster: of one that is there, or of processes of this machine."""

from __future__ import annotations

import asyncio
import logging
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from multiprocessing import resource_tracker
from typing import TYPE_CHECKING

from dask.system import CPU_COUNT
from distributed import Client, LocalCluster, Security
from distributed.comm import connect

from optipath.errors import JobError

if TYPE_CHECKING:
    from collections.abc import Iterator


_PATIENCE = 10.0
"""How many seconds a cluster has to answer."""


def threads_of(client: Client) -> int:
    """Return how many threads a cluster has now; one if it waits for work to have any."""
    try:
        threads: int = sum(client.nthreads().values())
    except (OSError, AttributeError):  # a client that is closed meanwhile has no scheduler
        raise JobError(
            "the cluster was lost; start again when it is back, and what is done is not computed "
            "again"
        ) from None
    return max(threads, 1)


@contextmanager
def client_of(argument: str | Client, blocks: int) -> Iterator[Client]:
    """Have a client; what is made for it is closed afterwards."""
    if argument == "processes":
        with _processes(min(CPU_COUNT, blocks)) as client:
            yield client
    elif isinstance(argument, str):
        with _reached(argument) as client:
            yield client
    else:
        if argument.asynchronous:
            raise JobError(
                "the client is asynchronous, and blocks are waited for; give "
                "distributed.Client(client.scheduler.address)"
            )
        if argument.status != "running":
            raise JobError(
                f"the client of the cluster is {argument.status}; give one that is connected, such "
                f"as distributed.Client(address)"
            )
        yield argument


def _reached(address: str) -> Client:
    try:
        # A client that waits in vain cannot be closed, so that somebody else asks first.
        with ThreadPoolExecutor(1) as elsewhere:
            elsewhere.submit(asyncio.run, _knock(address)).result()
        return Client(address, set_as_default=False)
    except TypeError as fault:
        raise JobError(
            f"'{address}' cannot be reached ({fault}); give a client that has the certificates, "
            f"distributed.Client('{address}', security=distributed.Security(...))"
        ) from None
    except (OSError, ValueError, ImportError) as fault:
        raise JobError(
            f"no cluster answers at '{address}' ({fault}); see that its scheduler runs and that "
            f"the address is as it prints it"
        ) from None


async def _knock(address: str) -> None:
    certificates = Security().get_connection_args("client")
    comm = await connect(address, timeout=_PATIENCE, **certificates)
    await comm.close()


@contextmanager
def _processes(count: int) -> Iterator[Client]:
    """Have processes of this machine, which never hear Ctrl-C: who made them ends them."""
    try:
        with ExitStack() as stack:
            with _interrupts_put_off():
                cluster = stack.enter_context(_local_cluster(count))
                client = stack.enter_context(Client(cluster, set_as_default=False))
                client.run(_ignore_interrupts)
                # What was put off is raised where all that is made here is closed in good order.
            closing = stack.pop_all()
    except (RuntimeError, OSError) as fault:
        raise JobError(
            f"no processes can be started ({fault}); in a script, put what is run under if "
            f"__name__ == '__main__':, since each process imports it, or give scheduler='threads'"
        ) from None
    with closing:
        yield client


def _local_cluster(count: int) -> LocalCluster:
    return LocalCluster(
        n_workers=count,
        threads_per_worker=1,
        host="127.0.0.1",
        dashboard_address=None,
        # It has an HTTP server all the same, by default at one port for all.
        scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},
        # What goes wrong with a block comes back, and is told by who waits for it.
        silence_logs=logging.CRITICAL,
    )


def _ignore_interrupts() -> None:
    # Ctrl-C comes to all processes of a terminal.
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextmanager
def _interrupts_put_off() -> Iterator[None]:
    """Let Ctrl-C wait inside, and never come to processes that are started there."""
    if sys.platform == "win32":
        yield
        return
    # Were it started inside, it would let Ctrl-C through again.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
