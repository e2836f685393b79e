"""Compiled code, kept on disk so that a second process need not wait for it again."""

from __future__ import annotations

import hashlib
import logging
import os
import sys
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numba as nb

from optipath.engines import numba_helpers

_LOGGER = logging.getLogger("optipath")


@cache
def compiled_once(text: str) -> Any:
    """Return the compiled function ``path`` of a text.

    The text is kept as a file, since Numba keeps what it compiles beside the file of the
    source. That a path is going to be compiled is told to the log ``optipath``, as a warning,
    so that nobody wonders what he waits for.
    """
    file = _file_of(text)
    # What Numba loads from disk belongs to a module that can be imported.
    space: dict[str, Any] = {"__name__": numba_helpers.__name__}
    exec(compile(text, file or "<formula>", "exec"), space)  # noqa: S102 - our own text
    options: dict[str, Any] = {"error_model": "numpy", "nogil": True, "cache": file is not None}
    for name in ("ldexp", "path"):
        space[name] = nb.njit(**options)(space[name])
    if file is None:
        _LOGGER.warning("compiling a path for Numba; it cannot be kept in %s", folder())
    elif not _is_compiled(Path(file)):
        _LOGGER.warning("compiling a path for Numba, once; it is kept in %s", folder())
    return space["path"]


def _is_compiled(file: Path) -> bool:
    version = f"py{sys.version_info.major}{sys.version_info.minor}"
    return any(file.parent.glob(f"__pycache__/{file.stem}.path-*.{version}*.nbi"))


def forget(text: str) -> None:
    """Remove what is kept of a text, such as a file that was damaged."""
    compiled_once.cache_clear()
    kept = folder() / "__pycache__"
    for file in kept.glob(f"formula_{_name_of(text)}.*"):
        file.unlink(missing_ok=True)


def _name_of(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def folder() -> Path:
    """Return where compiled code is kept: ``OPTIPATH_CACHE``, or a folder of the user's cache."""
    if own := os.environ.get("OPTIPATH_CACHE"):
        return Path(own)
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "optipath"


def _file_of(text: str) -> str | None:
    """Return the file that holds a text, written if need be; None where none can be written."""
    file = folder() / f"formula_{_name_of(text)}.py"
    try:
        if not file.exists():
            file.parent.mkdir(parents=True, exist_ok=True)
            handle, draft = tempfile.mkstemp(dir=file.parent, suffix=".draft")
            with os.fdopen(handle, "w", encoding="utf-8") as stream:
                stream.write(text)
            Path(draft).replace(file)
    except (OSError, RuntimeError):
        return None
    return str(file)
