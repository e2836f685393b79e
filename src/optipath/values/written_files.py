"""Files that are there whole or not at all: written beside their place, and then moved into it."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import shutil
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
    if place.exists() and not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    draft = place.with_name(f".{secrets.token_hex(8)}.draft")
    try:
        with draft.open("xb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        if place.exists():
            shutil.copymode(place, draft)
        draft.replace(place)
    except BaseException:
        with contextlib.suppress(OSError):
            draft.unlink()
        raise
