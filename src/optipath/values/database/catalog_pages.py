"""The pages of the database: shelves of books, and what their catalogue says of them."""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.values.database.installed import database_folder, read_yaml

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_MISPLACED = {
    ("main/MgO/Synowicki", "main/As2S3/nk/Synowicki.yml"): "main/MgO/nk/Synowicki.yml",
    ("main/ZrO2/Synowicki", "main/As2S3/nk/Synowicki.yml"): "main/ZrO2/nk/Synowicki.yml",
}
"""Files that the catalogue of May 2026 names wrongly, and where the pages are."""


class CatalogPage(NamedTuple):
    """A page, as the catalogue has it."""

    shelf: str
    book: str
    page: str
    about_book: str = ""
    about_page: str = ""
    divider: str = ""
    data: str = ""

    @property
    def place(self) -> str:
        """Its name: ``"main/Au/Johnson"``."""
        return f"{self.shelf}/{self.book}/{self.page}"

    @property
    def reference(self) -> str:
        """Who found it: ``"Johnson and Christy 1972"``; nothing for pages of makers."""
        head = self.about_page.partition(":")[0].strip()
        return head if re.search(r"\d{4}", head) else ""

    @property
    def file(self) -> Path:
        """The file on this machine."""
        return database_folder() / "data" / self.data


@cache
def catalog_pages() -> tuple[CatalogPage, ...]:
    """Return all pages, in the order of the catalogue."""
    found: dict[str, CatalogPage] = {}
    for page in _pages(
        read_yaml(database_folder() / "catalog-nk.yml", "the catalogue", installed=True)
    ):
        found.setdefault(page.place, page)
    return tuple(found.values())


def _pages(catalog: Any) -> Iterator[CatalogPage]:
    for shelf in _with(catalog, "SHELF"):
        for book in _with(shelf["content"], "BOOK"):
            divider = ""
            for entry in book["content"]:
                divider = _plain(entry.get("DIVIDER", divider))
                if "PAGE" not in entry:
                    continue
                place = f"{shelf['SHELF']}/{book['BOOK']}/{entry['PAGE']}"
                data = _MISPLACED.get((place, entry["data"]), entry["data"])
                told = (_plain(book.get("name", "")), _plain(entry.get("name", "")), divider)
                yield CatalogPage(shelf["SHELF"], book["BOOK"], entry["PAGE"], *told, data)


def _with(entries: Any, key: str) -> Iterator[dict[str, Any]]:
    return (entry for entry in entries if key in entry)


def _plain(text: str) -> str:
    return re.sub(r"<[^>]+>", "", text)
