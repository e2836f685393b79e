"""What the file system refuses, told in a sentence."""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING

from optipath.errors import OptipathError, SurfaceError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@contextmanager
def told_of(place: Path, error: type[OptipathError] = SurfaceError) -> Iterator[None]:
    """Tell what the file system refuses while a file is written.

    Examples
    --------
    >>> from pathlib import Path
    >>> with told_of(Path("nowhere/a.nc")):
    ...     raise FileNotFoundError(2, "")
    Traceback (most recent call last):
    optipath.errors.SurfaceError: 'nowhere/a.nc' cannot be written: No such file or directory; \
    give a name in a folder that takes files
    """
    try:
        yield
    except OSError as fault:
        why = os.strerror(fault.errno) if fault.errno else fault
        raise error(
            f"'{place}' cannot be written: {why}; give a name in a folder that takes files"
        ) from None
