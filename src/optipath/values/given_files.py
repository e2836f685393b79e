"""Files to be read: their names, as they are given, and what is in them."""

from __future__ import annotations

import os
import stat
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from optipath.errors import OptipathError, ValueFault, shown

LARGEST = 64 * 1024 * 1024
"""How many bytes a file of text may have."""


def given_file(path: Any, error: type[OptipathError] = ValueFault) -> Path:
    """Return the path of a file that is to be read.

    Examples
    --------
    >>> given_file("lamp.csv").stem
    'lamp'
    """
    name = fspath(path) if isinstance(path, (str, PathLike)) else path
    if not isinstance(name, str):
        raise error(
            f"the name of a file must be a text or a pathlib.Path, not {shown(path)}; write one "
            f"such as 'folder/file.csv'"
        )
    if not name or "\0" in name:
        raise error(f"{shown(name)} is no name of a file; write one such as 'folder/file.csv'")
    return Path(name)


def bytes_of(file: Path, most: int = LARGEST) -> bytes:
    """Return what is in a file, or what comes out of a pipe that somebody writes to."""
    # A named pipe that nobody writes to is empty, and not waited for.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    with open(file, "rb", opener=lambda name, _: os.open(name, flags)) as stream:
        kind = os.fstat(stream.fileno()).st_mode
        if not (stat.S_ISREG(kind) or stat.S_ISFIFO(kind)):
            raise OSError(0, "it is no file")
        if stat.S_ISFIFO(kind):
            os.set_blocking(stream.fileno(), True)
        found = stream.read(most + 1)
    if len(found) > most:
        raise OSError(0, f"it is larger than {most // 1024**2} MiB")
    return found
