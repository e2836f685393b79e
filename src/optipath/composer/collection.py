"""Python's collection of garbage, put off while many small values are made and none is lost."""

from __future__ import annotations

import gc
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def put_off() -> Iterator[None]:
    """Collect no garbage for a while: each time, all elements of a long path are looked at.

    Examples
    --------
    >>> import gc
    >>> with put_off():
    ...     print(gc.isenabled())
    False
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
