"""The client of a cluster."""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING

from distributed import Client, Security
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
def client_of(argument: str | Client) -> Iterator[Client]:
    """Have a client; what is made for it is closed afterwards."""
    if isinstance(argument, str):
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
