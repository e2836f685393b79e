"""Where units are written, as on the command line: nobody gives degrees for radians there."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

UNITS_ARE_WRITTEN: ContextVar[bool] = ContextVar("UNITS_ARE_WRITTEN", default=False)


@contextmanager
def units_are_written() -> Iterator[None]:
    """Let no number inside be taken for one of degrees: all come from texts with units.

    Examples
    --------
    >>> with units_are_written():
    ...     print(UNITS_ARE_WRITTEN.get())
    True
    """
    token = UNITS_ARE_WRITTEN.set(True)
    try:
        yield
    finally:
        UNITS_ARE_WRITTEN.reset(token)
