"""Marks: which files were written, with their sizes and digests, so that any damage is found."""

from __future__ import annotations

import json
import shutil
from hashlib import sha256
from stat import S_ISREG
from typing import TYPE_CHECKING, Any

from optipath.values.written_files import write_own_file

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

_MOST = 1 << 26
"""How many bytes a mark or a file of metadata may have; that of a chunk is known."""


def mark_of(about: str, stamps: Mapping[str, list[Any]]) -> bytes:
    """Return the content of a mark."""
    content = json.dumps(stamps, sort_keys=True).encode()  # Chunks come in any order.
    return _seal(about, content) + b"\n" + content


def damaged_files(folder: Path, mark: str, about: str) -> Iterator[str]:
    """Yield the names of files that are not as a mark says; its own name where it is damaged.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     place = Path(folder)
    ...     put_file(place / "mark", mark_of("block 0", {"S0": stamp_of(b"light")}))
    ...     put_file(place / "S0", b"night")
    ...     print(*damaged_files(place, "mark", "block 0"), *damaged_files(place, "mark", "1"))
    S0 mark
    """
    seal, _, stamps = content_of(folder / mark).partition(b"\n")
    if seal != _seal(about, stamps):
        yield mark
        return
    for name, stamp in json.loads(stamps).items():
        if stamp_of(content_of(folder / name, stamp[0])) != stamp:
            yield name


def _seal(about: str, stamps: bytes) -> bytes:
    return sha256(f"{about}\n".encode() + stamps).hexdigest().encode()


def stamp_of(content: bytes) -> list[Any]:
    """Return the size and the digest of what a file is to hold."""
    return [len(content), sha256(content).hexdigest()]


def content_of(file: Path, most: int = _MOST) -> bytes:
    """Return what is in a file; nothing of what is no regular file, or a larger one.

    Pipes and devices are not opened: they may never end.
    """
    try:
        about = file.stat()
        if S_ISREG(about.st_mode) and 0 < about.st_size <= most:
            with file.open("rb") as stream:
                return stream.read(about.st_size)
    except PermissionError:
        raise
    except OSError:
        pass
    return b""


def object_of(file: Path) -> dict[str, Any]:
    """Return the JSON object that is in a file; an empty one where there is none."""
    try:
        found = json.loads(content_of(file))
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def put_file(file: Path, content: bytes) -> None:
    """Write a file, whole or not at all, in place of whatever is there."""
    if file.is_dir():
        clear(file)
    write_own_file(file, content, 0o666)


def clear(place: Path) -> None:
    """Remove a file, a folder, or what else may be at a place; a link, and not what it leads to."""
    if place.is_dir() and not place.is_symlink():
        shutil.rmtree(place)
    else:
        place.unlink(missing_ok=True)
