"""The files of the page, read from the package once; nothing else is ever sent as a file."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import NamedTuple

_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
}


class PageFile(NamedTuple):
    """A file of the page."""

    kind: str
    content: bytes


@cache
def page_files() -> dict[str, PageFile]:
    """Return the files by the name under which they are asked for."""
    folder = files("optipath.explorer").joinpath("page")
    found = {}
    for file in folder.iterdir():
        kind = _TYPES.get("." + file.name.rpartition(".")[2])
        if kind is not None:
            name = "" if file.name == "index.html" else f"page/{file.name}"
            found[name] = PageFile(kind, file.read_bytes())
    return found
