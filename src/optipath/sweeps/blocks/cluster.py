"""The client of a cluster: of one that is there, or of processes of this machine."""

from __future__ import annotations

import asyncio
import logging
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

import cloudpickle
from dask.system import CPU_COUNT
from distributed import Client, LocalCluster
from distributed.comm import connect

from optipath.errors import JobError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Future

_PATIENCE = 10.0
"""How many seconds a cluster has to answer."""


class Travelling(Executor):
    """An executor of a cluster that says what is wrong where a worker cannot load what it gets.

    Of what distributed loads itself, nobody is told more than that the worker was lost.

    Parameters
    ----------
    executor : Executor
        Of a client.
    """

    def __init__(self, executor: Executor) -> None:
        self._executor = executor

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Have it done by a worker, and return what will come of it.

        Parameters
        ----------
        fn : callable
            What is done.
        *args, **kwargs : Any
            What it is given.

        Returns
        -------
        Future
        """
        return self._executor.submit(_unpacked, cloudpickle.dumps(partial(fn, *args, **kwargs)))


def _unpacked(packed: bytes) -> Any:
    try:
        work = cloudpickle.loads(packed)
    except (ImportError, AttributeError) as fault:
        raise JobError(
            f"a worker cannot load the job: {fault}; see that what defines it is a module that "
            f"the workers can import, too"
        ) from None
    return work()


@contextmanager
def client_of(given: str | Client) -> Iterator[Client]:
    """Have a client; what is made for it is closed afterwards.

    Parameters
    ----------
    given : str or distributed.Client
        One, the address of a cluster, or ``"processes"``.

    Yields
    ------
    distributed.Client

    Raises
    ------
    JobError
        If it is closed, or nothing answers.
    """
    if given == "processes":
        with _processes() as cluster, Client(cluster, set_as_default=False) as client:
            yield client
    elif isinstance(given, str):
        with _reached(given) as client:
            yield client
    else:
        if given.asynchronous:
            raise JobError(
                "the client is asynchronous, and blocks are waited for; give "
                "distributed.Client(client.scheduler.address)"
            )
        if given.status != "running":
            raise JobError(
                f"the client of the cluster is {given.status}; give one that is connected, such "
                f"as distributed.Client(address)"
            )
        yield given


def _reached(address: str) -> Client:
    try:
        # A client that waits in vain cannot be closed, so that somebody else asks first.
        with ThreadPoolExecutor(1) as elsewhere:
            elsewhere.submit(asyncio.run, _knock(address)).result()
        return Client(address, set_as_default=False)
    except (OSError, ValueError, ImportError) as fault:
        raise JobError(
            f"no cluster answers at {address!r} ({fault}); see that its scheduler runs and that "
            f"the address is as it prints it"
        ) from None


async def _knock(address: str) -> None:
    comm = await connect(address, timeout=_PATIENCE)
    await comm.close()


def _processes() -> LocalCluster:
    try:
        return LocalCluster(
            n_workers=CPU_COUNT,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address=None,
            # It has an HTTP server all the same, by default at one port for all.
            scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},
            silence_logs=logging.ERROR,
        )
    except RuntimeError as fault:
        raise JobError(
            f"no processes can be started ({fault}); in a script, put what is run under if "
            f"__name__ == '__main__':, since each process imports it, or give scheduler='threads'"
        ) from None
