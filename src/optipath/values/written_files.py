"""Files that are there whole or not at all: written beside their place, and then moved into it."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import shutil
from functools import partial
from pathlib import Path


def write_file(file: Path, content: bytes) -> None:
    """Write a file, so that what was there stays until all of the new one is on the disk.

    A new file has the permissions that the umask leaves, one that is replaced keeps its own. A
    link is followed; what is no ordinary file, such as ``/dev/stdout``, is written to directly.

    Parameters
    ----------
    file : Path
        Where it is to be.
    content : bytes
        All that is in it.

    Raises
    ------
    OSError
        If the folder takes no file, or the disk is full. No draft is left behind.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_file(Path(folder, "a.txt"), b"light")
    ...     [(file.name, file.read_bytes()) for file in Path(folder).iterdir()]
    [('a.txt', b'light')]
    """
    # The real path of a pipe is none.
    if file.exists() and not file.is_file():
        file.write_bytes(content)
        return
    place = Path(os.path.realpath(file))
    if place.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    there = place.exists()
    if there and not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    _put(place, content, 0o666, place if there else None)


def write_own_file(file: Path, content: bytes) -> None:
    """Write a file for its owner alone, in place of whatever stood there, a link too.

    Parameters
    ----------
    file : Path
        Its place.
    content : bytes
        What it is to hold.
    """
    _put(file, content, 0o600)


def _put(place: Path, content: bytes, mode: int, alike: Path | None = None) -> None:
    draft = place.with_name(f".{secrets.token_hex(8)}.draft")
    try:
        with open(draft, "xb", opener=partial(os.open, mode=mode)) as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        if alike:
            shutil.copymode(alike, draft)
        draft.replace(place)
    except BaseException:
        with contextlib.suppress(OSError):
            draft.unlink()
        raise
