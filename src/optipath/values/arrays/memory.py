"""Memory: whether a machine has what a batch takes, told before anything of it is made."""

from __future__ import annotations

import os
from contextlib import contextmanager
from math import prod
from typing import TYPE_CHECKING

from optipath.errors import ShapeError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.errors import OptipathError

UNTOLD = 16 * 2**30
"""How many bytes of memory a machine is taken to have that does not tell."""

CURE = "give fewer values at a time"

PATHS = "batch of {:.3g} paths"
"""What takes memory, with a place for how many there are."""

_LITTLE = 2**26


def refuse_too_large(
    batch: tuple[int, ...],
    each: int,
    cure: str = CURE,
    error: type[OptipathError] = ShapeError,
    what: str = PATHS,
) -> None:
    """Refuse a batch that takes more memory than the machine has.

    Examples
    --------
    >>> refuse_too_large((1000, 1000), 32)
    """
    needed = prod(batch) * each
    if needed > _LITTLE and needed > memory():
        raise error(_too_much(batch, each, cure, what))


@contextmanager
def enough_for(
    batch: tuple[int, ...],
    each: int,
    cure: str = CURE,
    error: type[OptipathError] = ShapeError,
    what: str = PATHS,
) -> Iterator[None]:
    """Do what takes memory for each path of a batch, if there is enough of it.

    Examples
    --------
    >>> with enough_for((1000, 1000), 32):
    ...     pass
    """
    refuse_too_large(batch, each, cure, error, what)
    try:
        yield
    except MemoryError:
        raise error(_too_much(batch, each, cure, what)) from None


def memory() -> int:
    """Return how many bytes of memory the machine has, or how many a process may take.

    Examples
    --------
    >>> memory() > 2**20
    True
    """
    try:
        import resource  # noqa: PLC0415 - Windows has none

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ImportError, AttributeError, ValueError, OSError):
        return UNTOLD
    return there if limit == resource.RLIM_INFINITY else min(there, limit)


def _too_much(batch: tuple[int, ...], each: int, cure: str, what: str) -> str:
    needed, there = (f"{size / 1e9:,.1f} GB" for size in (prod(batch) * each, memory()))
    return (
        f"a {what.format(prod(batch))}, of shape {batch}, takes {needed} of memory or more, "
        f"and this machine has {there}; {cure}"
    )
