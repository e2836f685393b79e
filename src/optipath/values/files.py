"""Files: names and contents read, files written whole or not at all, forms of pictures."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import stat
from contextlib import contextmanager
from io import BytesIO
from os import PathLike, fspath
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from optipath.errors import OptipathError, ValueFault
from optipath.faults import shown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from matplotlib.figure import Figure


LARGEST = 64 * 1024 * 1024
"""How many bytes a file of text may have."""


def input_file(path: Any, error: type[OptipathError] = ValueFault) -> Path:
    """Return the path of a file that is to be read."""
    name = fspath(path) if isinstance(path, (str, PathLike)) else path
    if not isinstance(name, str):
        name = ""
    if not name or "\0" in name:
        raise error(f"{shown(path)} is no name of a file; write one such as 'folder/file.csv'")
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
        result = stream.read(most + 1)
    if len(result) > most:
        raise OSError(0, f"it is larger than {most // 1024**2} MiB")
    return result


def text_of(file: Path) -> str:
    """Return the text of a file, or of a pipe."""
    try:
        return bytes_of(file).decode("utf-8")
    except OSError as error:
        raise OptipathError(f"'{file}' cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise OptipathError(f"'{file}' is no text in UTF-8; save it as UTF-8") from None


@contextmanager
def message_of(
    file: Path,
    error: Callable[[str], Exception],
    cure: str = "; give a name in a folder that takes files",
) -> Iterator[None]:
    """Tell what the file system refuses while a file is written."""
    try:
        yield
    except OSError as fault:
        # Libraries write more into `strerror` than what the system says.
        why = os.strerror(fault.errno) if fault.errno else fault
        raise error(f"'{file}' cannot be written: {why}{cure}") from None


def write_file(file: Path, content: bytes) -> None:
    """Write a file, so that the old one stays until all of the new one is on the disk.

    Permissions are kept, links are followed, and ``/dev/stdout`` and its like are written directly.
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
    with drafted(file) as draft, draft.open("wb") as stream:
        yield stream


@contextmanager
def drafted(file: Path) -> Iterator[Path]:
    """Let a file be written by others as a draft, which is then moved to its place."""
    place = _place_of(file)
    with _draft(place, 0o666) as draft:
        yield draft
        if place.exists():
            shutil.copymode(place, draft)


def write_own_file(file: Path, content: bytes, mode: int = 0o600) -> None:
    """Write a file in place of whatever stood there, a link too; by default for its owner alone."""
    with _draft(file, mode) as draft:
        draft.write_bytes(content)


def _place_of(file: Path) -> Path:
    """Return where a file is, behind all links, if it can be written there."""
    place = Path(os.path.realpath(file))
    if place.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    if place.exists() and not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return place


@contextmanager
def _draft(place: Path, mode: int) -> Iterator[Path]:
    draft = place.with_name(f".{secrets.token_hex(8)}.draft")
    try:
        os.close(os.open(draft, os.O_CREAT | os.O_EXCL | os.O_WRONLY, mode))
        yield draft
        with draft.open("rb+") as stream:
            os.fsync(stream.fileno())
        draft.replace(place)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise


_METADATA: dict[str, dict[str, Any]] = {
    ".png": {},
    ".svg": {"Date": None},
    ".pdf": {"CreationDate": None},
}
"""The endings, and what is said in each form so that a picture has the same bits every time."""

_TEXT_IS_TEXT: dict[Any, Any] = {
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "optipath",
}


def check_form(file: Path) -> None:
    """Refuse a file in whose form nothing can be drawn."""
    if file.suffix.lower() not in _METADATA:
        known = ", ".join(_METADATA)
        raise OptipathError(f"'{file}' has an ending that cannot be drawn; use one of: {known}")


def write_picture(figure: Figure, file: Path, dots_per_inch: float | str = "figure") -> None:
    """Draw a figure into a file, with texts that can be searched and set in another type."""
    from matplotlib import rc_context  # noqa: PLC0415 - an extra

    check_form(file)
    form, drawn = file.suffix.lower(), BytesIO()
    # For as long as it is written: there is no other way to say it.
    with rc_context(_TEXT_IS_TEXT):
        figure.savefig(drawn, format=form[1:], dpi=dots_per_inch, metadata=_METADATA[form])
    write_file(file, drawn.getvalue())
