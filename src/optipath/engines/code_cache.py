"""The cache of compiled code, in memory and on disk."""

from __future__ import annotations

import hashlib
import logging
import os
import platform
import stat
from collections import OrderedDict
from contextlib import contextmanager, suppress
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.errors import CacheError, shown
from optipath.values.files import write_own_file

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.engines.machine_code import MachineCode


_LOGGER = logging.getLogger("optipath")
_DRAFT = ".draft"
_CHECKSUM = hashlib.sha256().digest_size
_TROUBLE = (OSError, RuntimeError, CacheError)
"""What the folder may do to us; a circle of links is a RuntimeError."""


class CodeCache:
    """Keeps what has been compiled, for this process and for the next.

    *It never changes a result.* The key of an entry is a hash of the text, of the sources of what
    the text calls, of the versions of optipath, Numba, llvmlite, NumPy and Python, of the settings
    of Numba in the environment, and of the processor with its features. An entry whose checksum of
    key and content does not fit is removed, and compiled anew.

    *It runs nobody else's code.* Entries are machine code, and nothing is ever unpickled. The
    folder is made for its owner alone; folders and files that others own, may write or may replace
    are not used.

    *It never stops a computation.* A fault of the folder is logged to ``optipath``, once a process,
    and what is not cached is compiled. Files appear whole under their names; the drafts of killed
    processes are removed by the next.

    *It is bounded.* On disk by ``OPTIPATH_CACHE_BYTES`` (128 MiB), in memory by
    ``OPTIPATH_CACHE_FUNCTIONS`` (256); the least recently used goes first. Of each function that a
    process has compiled itself, some 0.2 MB stay with Numba and LLVM.

    >>> CodeCache().limit
    134217728
    """

    def __init__(self) -> None:
        self._functions: OrderedDict[str, MachineCode] = OrderedDict()
        self._lock = RLock()
        self._warned: set[str] = set()
        self._tidied: set[Path] = set()

    @property
    def folder(self) -> Path:
        """Where entries are, as `cache_place` says."""
        return cache_place()

    @property
    def limit(self) -> int:
        """How many bytes are kept on disk."""
        return whole_number_of_environment("OPTIPATH_CACHE_BYTES", 1 << 27)

    @property
    def most_functions(self) -> int:
        """How many functions are kept in memory."""
        return whole_number_of_environment("OPTIPATH_CACHE_FUNCTIONS", 256)

    def function(self, text: str, compiled: Callable[[str], bytes]) -> MachineCode:
        """Return the function of a text, compiled (and logged once) where it is not cached."""
        with self._lock:
            if text not in self._functions:
                self._functions[text] = self._loaded(text, compiled)
            self._functions.move_to_end(text)
            result = self._functions[text]
            try:
                most = self.most_functions
            except CacheError as error:
                most = 1
                self.tell(str(error))
            while len(self._functions) > most:
                self._functions.popitem(last=False)
            return result

    def _loaded(self, text: str, compiled: Callable[[str], bytes]) -> MachineCode:
        from optipath.engines.machine_code import MachineCode  # noqa: PLC0415 - not to clear

        code = self.load(text)
        if code is not None:
            try:
                return MachineCode(code)
            except (RuntimeError, ValueError):
                self.tell("a file of compiled code cannot be run; it is compiled anew")
        stored = "; what is compiled is kept" if self._can_keep() else ""
        self.tell(f"compiling for Numba, which takes some seconds a path{stored}")
        code = compiled(text)
        self.keep(text, code)
        return MachineCode(code)

    def _can_keep(self) -> bool:
        try:
            self._folder(make=True)
        except _TROUBLE as error:
            self._tell_of(error)
            return False
        return True

    def has(self, text: str) -> bool:
        """Tell whether the function of a text is kept, in memory or on disk.

        What is on disk is not read, and LLVM is loaded only where there is something of this text.
        """
        if text in self._functions:
            return True
        try:
            folder = self._folder()
            if not any(folder.glob(f"{name_of_text(text)}-*")):
                return False
            return (folder / name_of_code(text)).exists()
        except _TROUBLE:
            return False

    def load(self, text: str) -> bytes | None:
        """Return what is kept on disk for a text, or None."""
        try:
            folder = self._folder()
            file = folder / name_of_code(text)
            stored = read_own(file)
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
            file = self._folder(make=True) / name_of_code(text)
            write_own_file(file, _checksum(file.name, code) + code)
            self._shrink()
        except _TROUBLE as error:
            self._tell_of(error)

    def entries(self) -> list[Entry]:
        """Return what is on disk, that which has not been used for longest first."""
        with self._reported_as_fault():
            return entries_in(self._folder(), CODE_SUFFIX)
        return []

    def clear(self) -> int:
        """Remove what is on disk, drafts too; return how many entries there were."""
        entries = self.entries()
        with self._reported_as_fault():
            for entry in (*entries, *entries_in(self._folder(), _DRAFT)):
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
        """Return the folder as `own_folder` does, without drafts that others have left."""
        folder = own_folder(make=make)
        if folder not in self._tidied:
            for draft in entries_in(folder, _DRAFT):
                draft.file.unlink(missing_ok=True)
            self._tidied.add(folder)
        return folder

    def _shrink(self) -> None:
        """Remove the entries that have not been used for longest, down to the limit."""
        entries = self.entries()
        length = sum(entry.length for entry in entries)
        for entry in entries:
            if length <= self.limit:
                break
            entry.file.unlink(missing_ok=True)
            length -= entry.length


def _checksum(name: str, code: bytes) -> bytes:
    return hashlib.sha256(name.encode() + code).digest()


CODE = CodeCache()
"""The cache of this process."""


CURE = "set OPTIPATH_CACHE to a folder of your own"


class Entry(NamedTuple):
    """A file of the cache. Units: used in seconds."""

    file: Path
    length: int
    used: float


def cache_place() -> Path:
    """Return where entries are: ``OPTIPATH_CACHE``, or a folder of the user's cache."""
    try:
        if own := os.environ.get("OPTIPATH_CACHE"):
            return Path(own).absolute()
        base = Path(os.environ.get("XDG_CACHE_HOME", ""))
        result = (base if base.is_absolute() else Path.home() / ".cache") / "optipath"
    except (OSError, RuntimeError):
        result = Path()
    if not result.is_absolute():
        raise CacheError(f"there is no home folder; {CURE}")
    return result


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
    results = []
    for file in folder.iterdir():
        if file.suffix == suffix:
            try:
                about = file.lstat()
            except FileNotFoundError:  # another process was faster
                continue
            results.append(Entry(file, about.st_size, about.st_mtime))
    return sorted(results, key=lambda entry: entry.used)


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


CODE_SUFFIX = ".code"


def name_of_text(text: str) -> str:
    """Return what the names of all entries of a text begin with."""
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def name_of_code(text: str) -> str:
    """Return the name of the entry of a text, by all that its machine code depends on."""
    settings = sorted((k, v) for k, v in os.environ.items() if k.startswith("NUMBA_"))
    key = hashlib.sha256(repr((text, settings, _maker())).encode())
    return f"{name_of_text(text)}-{key.hexdigest()}{CODE_SUFFIX}"


@cache
def _maker() -> Any:
    """Return what makes code of a text: sources, versions, the processor."""
    import llvmlite.binding as llvm  # noqa: PLC0415 - an extra

    here = files("optipath.engines")
    sources = [(here / name).read_text("utf-8") for name in ("numba_helpers.py", "machine_code.py")]
    packages = [_version(name) for name in ("optipath", "numba", "llvmlite", "numpy")]
    try:
        features = llvm.get_host_cpu_features().flatten()
    except RuntimeError:  # LLVM does not know them of every processor
        features = ""
    processor = (llvm.get_process_triple(), llvm.get_host_cpu_name(), features)
    return sources, packages, platform.python_version(), processor


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        if package == "optipath":  # a folder of sources, which are in the key themselves
            return ""
        raise CacheError(f"the version of {package} is not known; install it with pip") from None
