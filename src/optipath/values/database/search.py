"""Search of the database: the pages in which words occur, those with short names first."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from optipath.errors import OptipathError
from optipath.values.database.catalog_pages import CatalogPage, catalog_pages
from optipath.values.database.curated_names import CURATED, alike
from optipath.values.database.installed import read_yaml
from optipath.values.database.page_entries import spans_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.values.database.curated_names import CuratedName


_RANGE = re.compile(
    r"(?:[:;,] *)?\b(?:n,k|n|k)(?:\(\w\))?[;,]? [\d.e-]+ *[\u2013-] *[\d.e]+ +\u00b5m"
)
"""The range in the title of a page: "n,k 0.188-1.937 um", with a dash."""


class FoundPage(NamedTuple):
    """A page that a search has found."""

    name: str
    page: CatalogPage
    curated: CuratedName | None = None

    @property
    def described(self) -> str:
        """Where its numbers are from: the page of a short name and why, else what it is of."""
        if self.curated:
            return "; ".join([self.page.place, self.curated.reference, self.curated.why])
        told = (self.page.about_book, _RANGE.sub("", self.page.about_page), self.page.divider)
        return "; ".join(filter(None, told))

    def spans(self) -> dict[str, tuple[float, float]]:
        """Return the wavelengths of n and of k, in metres; nothing if a page cannot be read."""
        try:
            found = spans_of(read_yaml(self.page.file, self.page.place, installed=True))
        except (OptipathError, ValueError, ArithmeticError, LookupError, TypeError, AttributeError):
            return {}
        if self.curated and self.curated.clear:
            low, high = self.curated.clear
            found["n"] = max(low, found["n"][0]), min(high, found["n"][1])
        return {part: found[part] for part in ("n", "k") if part in found}


def pages_with(words: Sequence[str]) -> list[FoundPage]:
    """Return the pages in which all of some words occur; those with short names for none."""
    pages = {page.place: page for page in catalog_pages()}
    short = [FoundPage(c.names[0], pages[c.place], c) for c in CURATED if c.place in pages]
    if not words:
        return short
    asked = [word.casefold() for word in words]
    first = [one for one in short if _has(_text(one.page, one.curated), asked)]
    others = [
        FoundPage(page.place, page)
        for place, page in pages.items()
        if place not in {one.page.place for one in first} and _has(_text(page), asked)
    ]
    return first + sorted(others, key=lambda one: one.page.book.casefold() not in asked)


def _has(text: str, words: list[str]) -> bool:
    return all(word in text for word in words)


def _text(page: CatalogPage, curated: CuratedName | None = None) -> str:
    names = (*curated.names, *map(alike, curated.names), curated.why) if curated else ()
    return " ".join([page.place, page.about_book, page.about_page, page.divider, *names]).casefold()
