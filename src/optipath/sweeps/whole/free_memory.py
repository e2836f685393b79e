"""Whether a sweep fits into the memory that is free, told before anything of it is computed."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ShapeError
from optipath.values.arrays.memory import memory
from optipath.values.cures import cure

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.plan.plan import Plan
    from optipath.sweeps.axes.sweep_grid import SweepGrid

_LITTLE = 2**26
_GROUP_LIMITS = ("memory.max", "memory/memory.limit_in_bytes")
"""Where Linux says how much a container may have."""


def refuse_more_than_free(plan: Plan, grid: SweepGrid) -> None:
    """Refuse a sweep in memory that takes more than there is.

    Examples
    --------
    >>> import optipath as op
    >>> from optipath.sweeps.axes.read_axes import grid_of
    >>> plan = op.load_preset("malus").compose()
    >>> refuse_more_than_free(plan, grid_of(plan.inputs, {"angle": [0.1, 0.2]}))
    """
    needed = grid.points * bytes_of_a_point(plan, grid.points)
    if needed <= _LITTLE or needed <= (free := free_memory()):
        return
    sizes = " x ".join(f"{size:,}" for size in grid.shape)
    instead = cure(
        "give chunks='auto' for Dask arrays, store='sweep.zarr' to keep it on disk, or ",
        "write it to a file by 'optipath sweep ... --out FILE.zarr' (or .nc, .csv), or give ",
    )
    raise ShapeError(
        f"a sweep of {sizes} points needs {_text(needed)}, and {_text(free)} is free; "
        f"{instead}fewer values"
    )


def bytes_of_a_point(plan: Plan, points: int) -> int:
    """Return how many bytes a run takes for each point: its results, and what is made on the way.

    Examples
    --------
    >>> import optipath as op
    >>> bytes_of_a_point(op.load_preset("malus").compose(), 1_000_000)
    32
    """
    # Jones columns keep exponents, as what is run step by step does.
    stepped = plan.composing == "jones" or "step by step" in plan.engine_for(points)
    return plan.answers.question.numbers(stepped=stepped) * np.dtype(plan.dtype).itemsize


def free_memory() -> int:
    """Return how many bytes this process may still take.

    Examples
    --------
    >>> free_memory() > 2**20
    True
    """
    try:
        psutil: Any = import_module("psutil")  # Dask's cluster brings it.
    except ImportError:
        return memory()
    own = psutil.Process().memory_info()
    free: list[int] = [psutil.virtual_memory().available]
    free += [limit - own.rss for limit in _group_limits()]
    with suppress(ImportError):  # Windows has none.
        resource: Any = import_module("resource")
        limit, _ = resource.getrlimit(resource.RLIMIT_AS)
        free += [] if limit == resource.RLIM_INFINITY else [limit - own.vms]
    return max(0, min(free))


def _group_limits() -> Iterator[int]:
    for name in _GROUP_LIMITS:
        with suppress(OSError, ValueError):  # No such file, or "max".
            yield int((Path("/sys/fs/cgroup") / name).read_text("ascii"))


def _text(size: int) -> str:
    return f"{size / 1e9:,.1f} GB"
