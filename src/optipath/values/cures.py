"""Cures as they are written where the fault is: in a preset file, or in Python."""

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
