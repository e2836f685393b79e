"""The folder of the cache: where it is, and that nobody but its owner may change what is in it."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from optipath.errors import CacheError, shown

if TYPE_CHECKING:
    from collections.abc import Iterator

CURE = "set OPTIPATH_CACHE to a folder of your own"


class Entry(NamedTuple):
    """A file of the cache.

    Units: used in seconds.
    """

    file: Path
    length: int
    used: float


def cache_place() -> Path:
    """Return where entries are: ``OPTIPATH_CACHE``, or a folder of the user's cache."""
    try:
        if own := os.environ.get("OPTIPATH_CACHE"):
            return Path(own).absolute()
        base = Path(os.environ.get("XDG_CACHE_HOME", ""))
        found = (base if base.is_absolute() else Path.home() / ".cache") / "optipath"
    except (OSError, RuntimeError):
        found = Path()
    if not found.is_absolute():
        raise CacheError(f"there is no home folder; {CURE}")
    return found


def own_folder(*, make: bool = False) -> Path:
    """Return the folder, made if need be, if nobody else may change what is in it."""
    folder = cache_place()
    if make:
        for place in reversed((folder, *folder.parents)):
            if not place.exists():
                place.mkdir(0o700, exist_ok=True)
    if hasattr(os, "getuid"):
        _refuse_shared(folder)
    return folder


def entries_in(folder: Path, suffix: str) -> list[Entry]:
    """Return the files whose names end so, that which has not been used for longest first."""
    found = []
    for file in folder.iterdir():
        if file.suffix == suffix:
            try:
                about = file.lstat()
            except FileNotFoundError:  # another process was faster
                continue
            found.append(Entry(file, about.st_size, about.st_mtime))
    return sorted(found, key=lambda entry: entry.used)


def _refuse_shared(folder: Path) -> None:
    """Refuse a folder that others may write to, or may put something else in place of."""
    if folder.is_symlink():
        raise CacheError(
            f"the cache '{folder}' is a link; set OPTIPATH_CACHE to the folder it leads to"
        )
    about = folder.lstat()
    if not stat.S_ISDIR(about.st_mode):
        raise CacheError(f"the cache '{folder}' is no folder; {CURE}")
    if about.st_uid != os.getuid():
        raise CacheError(f"the cache '{folder}' belongs to another user; {CURE}")
    if about.st_mode & 0o022:
        raise CacheError(
            f"others may write to the cache '{folder}'; remove it, and it is made anew for you "
            f"alone"
        )
    for place in _way(folder):
        about = place.lstat()
        shared = not stat.S_ISLNK(about.st_mode) and about.st_mode & 0o022
        if about.st_uid not in (0, os.getuid()) or (shared and not about.st_mode & stat.S_ISVTX):
            raise CacheError(
                f"others may replace the cache '{folder}', since they own '{place}' or may write "
                f"to it; {CURE}"
            )


def _way(place: Path) -> Iterator[Path]:
    """Yield every folder and every link that the way to a place leads through."""
    for parent in place.parents:
        yield parent
        if parent.is_symlink():
            target = parent.parent / parent.readlink()
            yield target
            yield from _way(target)


def read_own(file: Path) -> bytes:
    """Return what is in a file of one's own."""
    # What is no file, such as a pipe, is not waited for.
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    with os.fdopen(os.open(file, flags | getattr(os, "O_BINARY", 0)), "rb") as stream:
        about = os.fstat(stream.fileno())
        shared = hasattr(os, "getuid") and (
            about.st_uid != os.getuid() or bool(about.st_mode & 0o022)
        )
        if shared or not stat.S_ISREG(about.st_mode):
            raise CacheError(
                f"'{file}' in the cache is not a file of your own; remove it, or see who made it"
            )
        return stream.read()


def whole_number_of_environment(name: str, default: int) -> int:
    """Return a number of the environment."""
    text = os.environ.get(name) or str(default)
    if not text.isascii() or not text.isdigit() or len(text) > 18:
        raise CacheError(f"{name} is {shown(text)}; set it to a whole number such as {default}")
    return int(text)
