"""The limits of this machine: what a path costs at least, whatever the software."""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

_INNER, _OUTER = 2048, 4_000_000


def fastest(action: Callable[[], Any], repeats: int = 9) -> float:
    """Return the smallest time of an action in seconds."""
    times = []
    for _ in range(repeats):
        begin = perf_counter()
        action()
        times.append(perf_counter() - begin)
    return min(times)


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
    loops = 200

    def repeated(function: Callable[..., Any], *given: Any) -> Callable[[], None]:
        def action() -> None:
            for _ in range(loops):
                function(*given, out=y)

        return action

    per = 1e9 / (loops * _INNER)
    return {
        "sqrt": fastest(repeated(np.sqrt, x)) * per,
        "div": fastest(repeated(np.divide, x, x)) * per,
        # A copy reads and writes every byte once.
        "byte": fastest(lambda: np.copyto(copy, many)) * 1e9 / (2 * many.nbytes),
    }


def limits(numbers: int, counts: Mapping[str, int]) -> dict[str, float]:
    """Return the least ns a path: its roots and divisions, and its numbers in and out.

    Parameters
    ----------
    numbers : int
        How many float64 a path is given and gives.
    counts : mapping
        What `operations` has counted.
    """
    unit = throughput()
    found = {
        "sqrt and division": counts["sqrt"] * unit["sqrt"] + counts["div"] * unit["div"],
        "memory": 8 * numbers * unit["byte"],
    }
    return {name: ns for name, ns in found.items() if ns > 0.0}
