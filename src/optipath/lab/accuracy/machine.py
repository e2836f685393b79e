"""The limits of this machine: what a path costs at least, whatever the software."""

from __future__ import annotations

import platform
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.lab.bench.timing import seconds_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

_INNER, _OUTER = 2048, 4_000_000


def processor() -> str:
    """Return what the processor calls itself."""
    told = Path("/proc/cpuinfo")
    lines = told.read_text(encoding="utf-8").splitlines() if told.exists() else []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor() or platform.machine())


def throughput() -> dict[str, float]:
    """Return the ns of a square root and a division in cache, and the ns a byte from memory.

    float64, one thread, through NumPy's compiled loops.

    Examples
    --------
    >>> sorted(throughput())
    ['byte', 'div', 'sqrt']
    """
    x, y = np.full(_INNER, 1.5), np.empty(_INNER)
    many, copy = np.ones(_OUTER), np.ones(_OUTER)
    return {
        "sqrt": _least_ns(partial(np.sqrt, x, out=y), 200) / _INNER,
        "div": _least_ns(partial(np.divide, x, x, out=y), 200) / _INNER,
        # A copy reads and writes every byte once.
        "byte": _least_ns(partial(np.copyto, copy, many)) / (2 * many.nbytes),
    }


def _least_ns(action: Callable[[], Any], calls: int = 1) -> float:
    return 1e9 * min(seconds_of(action, calls) for _ in range(9))


def limits(numbers: int, counts: Mapping[str, int]) -> dict[str, float]:
    """Return the least ns a path: its roots and divisions, and its numbers in and out."""
    unit = throughput()
    found = {
        "sqrt and division": counts["sqrt"] * unit["sqrt"] + counts["div"] * unit["div"],
        "memory": 8 * numbers * unit["byte"],
    }
    return {name: ns for name, ns in found.items() if ns > 0.0}
