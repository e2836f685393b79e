"""A large job, computed block after block by whatever computes, and kept."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike
    from pathlib import Path

    from optipath.sweeps.blocks.block_job import BlockJob


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
    raise NotImplementedError
