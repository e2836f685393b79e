"""Cures as they are written where the fault is: in Python, a preset file, or a command line."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_IN_FILE: ContextVar[bool] = ContextVar("_IN_FILE", default=False)


@contextmanager
def of_files() -> Iterator[None]:
    """Let all cures inside be written as preset files write them."""
    token = _IN_FILE.set(True)
    try:
        yield
    finally:
        _IN_FILE.reset(token)


def cure(python: str, file: str) -> str:
    """Return a cure as it is written where the fault is.

    Parameters
    ----------
    python, file : str
        In both ways of writing it.

    Returns
    -------
    str

    Examples
    --------
    >>> cure("op.FOLLOWS", '"follows"')
    'op.FOLLOWS'
    >>> with of_files():
    ...     print(cure("op.FOLLOWS", '"follows"'))
    "follows"
    """
    return file if _IN_FILE.get() else python


def how_to_give(name: str) -> str:
    """Return how a value is given for a parameter, where files are run at the command line.

    Examples
    --------
    >>> how_to_give("n_1")
    'n_1=...'
    >>> with of_files():
    ...     print(how_to_give("n_1"))
    --n-1 ...
    """
    return cure(f"{name}=...", f"--{name.replace('_', '-')} ...")
