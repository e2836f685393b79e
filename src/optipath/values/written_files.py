"""Files that are there whole or not at all: written beside their place, and then moved into it."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import shutil
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import IO, TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator


def write_file(file: Path, content: bytes) -> None:
    """Write a file, so that what was there stays until all of the new one is on the disk.

    A new file has the permissions that the umask leaves, one that is replaced keeps its own. A
    link is followed; what is no ordinary file, such as ``/dev/stdout``, is written to directly.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_file(Path(folder, "a.txt"), b"light")
    ...     [(file.name, file.read_bytes()) for file in Path(folder).iterdir()]
    [('a.txt', b'light')]
    """
    with written_whole(file) as stream:
        stream.write(content)


@contextmanager
def written_whole(file: Path) -> Iterator[IO[bytes]]:
    """Let a file be written part by part, which is in its place once all is written."""
    # The real path of a pipe is none.
    if file.exists() and not file.is_file():
        with file.open("wb") as stream:
            yield stream
        return
    place = _place_of(file)
    with _draft(place, 0o666, place if place.exists() else None) as stream:
        yield stream


@contextmanager
def drafted(file: Path) -> Iterator[Path]:
    """Let a file be written by others under the name of a draft, which is then moved to its place.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with drafted(Path(folder, "a.txt")) as draft:
    ...         _ = draft.write_text("light")
    ...     [(file.name, file.read_text()) for file in Path(folder).iterdir()]
    [('a.txt', 'light')]
    """
    place = _place_of(file)
    draft = place.with_name(f".{secrets.token_hex(8)}.draft")
    try:
        yield draft
        with draft.open("rb") as stream:
            os.fsync(stream.fileno())
        if place.exists():
            shutil.copymode(place, draft)
        draft.replace(place)
    except BaseException:
        with contextlib.suppress(OSError):
            draft.unlink()
        raise


def write_own_file(file: Path, content: bytes, mode: int = 0o600) -> None:
    """Write a file in place of whatever stood there, a link too; by default for its owner alone."""
    with _draft(file, mode) as stream:
        stream.write(content)


def _place_of(file: Path) -> Path:
    """Return where a file is, behind all links, if it can be written there."""
    place = Path(os.path.realpath(file))
    if place.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    if place.exists() and not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return place


@contextmanager
def _draft(place: Path, mode: int, alike: Path | None = None) -> Iterator[IO[bytes]]:
    draft = place.with_name(f".{secrets.token_hex(8)}.draft")
    try:
        with open(draft, "xb", opener=partial(os.open, mode=mode)) as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        if alike:
            shutil.copymode(alike, draft)
        draft.replace(place)
    except BaseException:
        with contextlib.suppress(OSError):
            draft.unlink()
        raise
