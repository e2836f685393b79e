"""The cache of compiled code, in memory and on disk."""

from __future__ import annotations

import hashlib
import logging
import os
import stat
from contextlib import contextmanager, suppress
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.errors import CacheError
from optipath.faults import shown
from optipath.values.files import write_own_file

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.engines.machine_code import MachineCode


_LOGGER = logging.getLogger("optipath")
_CODE, _DRAFT = ".code", ".draft"
_MOST_FUNCTIONS = 256
_CHECKSUM = hashlib.sha256().digest_size
_TROUBLE = (OSError, RuntimeError, CacheError)
"""What may be wrong with the folder; a circle of links is a RuntimeError."""

CURE = "set OPTIPATH_CACHE to a folder of your own"


class Entry(NamedTuple):
    """A file of the cache. Units: used in seconds."""

    file: Path
    length: int
    used: float


class CodeCache:
    """Keeps what has been compiled, for this process and for the next.

    *It never changes a result.* The name of an entry is a hash of the text, of the versions of
    what compiles it, and of the processor with its features. An entry whose checksum does not fit
    is removed, and compiled anew.

    *It runs nobody else's code.* Entries are machine code, and nothing is ever unpickled. Folders
    and files that belong to others, or that others may write to, are not used.

    *It never stops a computation.* A fault of the folder is logged to ``optipath``, once a process,
    and what is not cached is compiled. Files appear whole under their names; the drafts of killed
    processes are removed by the next.

    *It is bounded.* On disk by ``OPTIPATH_CACHE_BYTES`` (128 MiB), in memory by 256 functions; the
    least recently used goes first.

    >>> CodeCache().limit
    134217728
    """

    def __init__(self) -> None:
        self._functions: dict[str, MachineCode] = {}
        self._lock = RLock()
        self._warned: set[str] = set()
        self._tidied: set[Path] = set()

    @property
    def folder(self) -> Path:
        """Where entries are: ``OPTIPATH_CACHE``, or a folder of the user's cache."""
        try:
            if own := os.environ.get("OPTIPATH_CACHE"):
                return Path(own).absolute()
            base = Path(os.environ.get("XDG_CACHE_HOME", ""))
            return (base if base.is_absolute() else Path.home() / ".cache") / "optipath"
        except (OSError, RuntimeError):
            raise CacheError(f"there is no home folder; {CURE}") from None

    @property
    def limit(self) -> int:
        """How many bytes are kept on disk."""
        name, default = "OPTIPATH_CACHE_BYTES", 1 << 27
        text = os.environ.get(name) or str(default)
        if not text.isascii() or not text.isdigit() or len(text) > 18:
            raise CacheError(f"{name} is {shown(text)}; set it to a whole number such as {default}")
        return int(text)

    def function(self, text: str, compiled: Callable[[str], bytes]) -> MachineCode:
        """Return the function of a text, compiled (and logged once) where it is not cached."""
        with self._lock:
            result = self._functions.pop(text, None) or self._loaded(text, compiled)
            self._functions[text] = result
            if len(self._functions) > _MOST_FUNCTIONS:
                del self._functions[next(iter(self._functions))]
            return result

    def _loaded(self, text: str, compiled: Callable[[str], bytes]) -> MachineCode:
        from optipath.engines.machine_code import MachineCode  # noqa: PLC0415 - an extra

        code = self.load(text)
        if code is not None:
            try:
                return MachineCode(code)
            except (RuntimeError, ValueError):
                self.tell("a file of compiled code cannot be run; it is compiled anew")
        self.tell("compiling, which may take some seconds")
        code = compiled(text)
        self.keep(text, code)
        return MachineCode(code)

    def has(self, text: str) -> bool:
        """Tell whether the function of a text is kept, in memory or on disk."""
        if text in self._functions:
            return True
        with suppress(*_TROUBLE):
            folder = self._folder()
            # LLVM is loaded only where there is something of this text.
            return any(folder.glob(f"{_hash(text)[:16]}-*")) and (folder / _name_of(text)).exists()
        return False

    def load(self, text: str) -> bytes | None:
        """Return what is kept on disk for a text, or None."""
        try:
            file = self._folder() / _name_of(text)
            stored = _bytes_of(file)
            if stored[:_CHECKSUM] == _checksum(file.name, stored[_CHECKSUM:]):
                with suppress(OSError):  # where nothing can be noted
                    os.utime(file)
                return stored[_CHECKSUM:]
            self.tell("a file of compiled code is damaged; it is compiled anew")
            file.unlink()
        except FileNotFoundError:
            pass
        except _TROUBLE as error:
            self._tell_of(error)
        return None

    def keep(self, text: str, code: bytes) -> None:
        """Keep what has been compiled for a text."""
        try:
            if len(code) + _CHECKSUM > self.limit:
                return
            file = self._folder(make=True) / _name_of(text)
            write_own_file(file, _checksum(file.name, code) + code)
            entries = self.entries()
            length = sum(entry.length for entry in entries)
            for entry in entries:
                if length > self.limit:
                    entry.file.unlink(missing_ok=True)
                    length -= entry.length
        except _TROUBLE as error:
            self._tell_of(error)

    def entries(self) -> list[Entry]:
        """Return what is on disk, that which has not been used for longest first."""
        with self._reported_as_fault():
            return _entries_in(self._folder(), _CODE)
        return []

    def clear(self) -> int:
        """Remove what is on disk, drafts too; return how many entries there were."""
        entries = self.entries()
        with self._reported_as_fault():
            for entry in (*entries, *_entries_in(self._folder(), _DRAFT)):
                entry.file.unlink(missing_ok=True)
        return len(entries)

    def tell(self, what: str) -> None:
        """Tell the log something, once a process."""
        if what not in self._warned:
            self._warned.add(what)
            _LOGGER.warning(what)

    def _tell_of(self, error: BaseException) -> None:
        self.tell(f"compiled code is not kept: {self._fault(error)}")

    @contextmanager
    def _reported_as_fault(self) -> Iterator[None]:
        """Raise what is wrong with the folder as a CacheError; that it is not there is no fault."""
        try:
            yield
        except FileNotFoundError:
            pass
        except (OSError, RuntimeError) as error:
            raise self._fault(error) from None

    def _fault(self, error: BaseException) -> CacheError:
        """Return what is wrong with the folder as a sentence with its cure."""
        if isinstance(error, CacheError):
            return error
        reason = getattr(error, "strerror", None) or error
        return CacheError(f"the cache '{self.folder}' cannot be used ({reason}); {CURE}")

    def _folder(self, *, make: bool = False) -> Path:
        """Return the folder, if nobody else may write to it, without drafts that were left."""
        folder = self.folder
        if make:
            for place in reversed((folder, *folder.parents)):
                if not place.exists():
                    place.mkdir(0o700, exist_ok=True)
        about = folder.lstat()
        if not stat.S_ISDIR(about.st_mode):
            raise CacheError(f"the cache '{folder}' is no folder; {CURE}")
        _refuse_foreign(folder, about)
        if folder not in self._tidied:
            for draft in _entries_in(folder, _DRAFT):
                draft.file.unlink(missing_ok=True)
            self._tidied.add(folder)
        return folder


CODE = CodeCache()
"""The cache of this process."""


def _refuse_foreign(place: Path, about: os.stat_result) -> None:
    """Refuse what belongs to another user, or may be written to by others."""
    if hasattr(os, "getuid") and (about.st_uid != os.getuid() or about.st_mode & 0o022):
        raise CacheError(f"'{place}' in the cache is not yours alone; remove it, or {CURE}")


def _entries_in(folder: Path, suffix: str) -> list[Entry]:
    """Return the files whose names end so, that which has not been used for longest first."""
    results = []
    for file in folder.iterdir():
        if file.suffix == suffix:
            with suppress(FileNotFoundError):  # where another process was faster
                about = file.lstat()
                results.append(Entry(file, about.st_size, about.st_mtime))
    return sorted(results, key=lambda entry: entry.used)


def _bytes_of(file: Path) -> bytes:
    """Return what is in a file of one's own."""
    # What is no file, such as a pipe, is not waited for.
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    with os.fdopen(os.open(file, flags | getattr(os, "O_BINARY", 0)), "rb") as stream:
        about = os.fstat(stream.fileno())
        if not stat.S_ISREG(about.st_mode):
            raise CacheError(f"'{file}' in the cache is no file; remove it")
        _refuse_foreign(file, about)
        return stream.read()


def _checksum(name: str, code: bytes) -> bytes:
    return hashlib.sha256(name.encode() + code).digest()


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _name_of(text: str) -> str:
    """Return the name of the entry of a text, by all that its machine code depends on."""
    return f"{_hash(text)[:16]}-{_hash(repr((text, _maker())))}{_CODE}"


@cache
def _maker() -> tuple[Any, ...]:
    """Return what makes code of a text: the versions of packages, and the processor."""
    from optipath.engines.machine_code import processor  # noqa: PLC0415 - an extra

    versions = []
    for package in ("optipath", "numba", "llvmlite"):
        with suppress(PackageNotFoundError):
            versions.append((package, version(package)))
    return (*versions, *processor())
