"""Which page of the database a name stands for."""

from __future__ import annotations

from difflib import get_close_matches
from typing import NamedTuple

from optipath.errors import MaterialError, shown
from optipath.spelling import closest, looks_left
from optipath.values.cures import argument, cure
from optipath.values.database.catalog_pages import CatalogPage, catalog_pages
from optipath.values.database.curated_names import CURATED, CuratedName, alike, curated_names

VACUUM = "vacuum"
"""The one name without a page: n is 1 and k is 0 at every wavelength."""

_MOST = 8
"""How many pages a sentence lists."""

_MOST_WORDS = 1000


class NamedPage(NamedTuple):
    """A page, and what sentences call the material."""

    name: str
    label: str
    page: CatalogPage
    clear: tuple[float, float] | None = None


def named_page(name: str, page: str = "") -> NamedPage:
    """Return the page that a name stands for."""
    for given in (name, page):
        if not isinstance(given, str):
            raise MaterialError(f"a material has a name, such as 'gold', not {shown(given)}")
    curated = curated_names().get(alike(name))
    if curated is not None and not page:
        return of_curated(curated)
    if alike(name) == VACUUM:
        raise MaterialError(f"'{name}' has no page {shown(page)}; leave page out")
    if not page and f"{alike(name)} o" in curated_names():
        raise MaterialError(
            f"'{name}' is birefringent: '{name}-o' is its ordinary index, '{name}-e' its "
            f"extraordinary one"
        )
    found = _matching(name, page, curated)
    if len(found) > 1:
        raise MaterialError(_ambiguous(f"{name}/{page}" if page else name, found))
    if not found:
        raise MaterialError(_unknown(name, page, curated))
    return of_page(found[0])


def of_curated(curated: CuratedName) -> NamedPage:
    """Return the page of a short name, without the catalogue, which takes its time."""
    shelf, book, page = curated.place.split("/")
    data = curated.data or f"{shelf}/{book}/nk/{page}.yml"
    known = CatalogPage(shelf, book, page, data=data)
    return NamedPage(curated.names[0], curated.label, known, curated.clear)


def of_page(page: CatalogPage) -> NamedPage:
    """Return a page of the catalogue, which is called by its short name where it has one."""
    curated = next((one for one in CURATED if one.place == page.place), None)
    if curated is not None:
        return NamedPage(page.place, curated.label, page)
    label = f"{page.place} ({page.reference})" if page.reference else page.place
    return NamedPage(page.place, label, page)


def _matching(name: str, page: str, curated: CuratedName | None) -> list[CatalogPage]:
    """Return the pages that names stand for: those of a book before others of that name."""
    pages = catalog_pages()
    if curated is not None and page:
        name = curated.place.rpartition("/")[0]
    words = [_underscored(word) for word in (name, page) if word]
    keys = "/".join(words)
    for whole in (lambda p: (p.shelf, p.book, p.page), lambda p: (p.book, p.page)):
        if found := [p for p in pages if _underscored("/".join(whole(p))) == keys]:
            return found
    if page:
        return []
    for part in (
        lambda p: f"{p.shelf}/{p.book}",
        lambda p: p.book,
        lambda p: p.page,
    ):
        if found := [p for p in pages if _underscored(part(p)) == keys]:
            return found
    return []


def _underscored(name: str) -> str:
    return name.strip().replace(" ", "_")


def _ambiguous(name: str, found: list[CatalogPage]) -> str:
    books = {(page.shelf, page.book) for page in found}
    short = next((one.names[0] for one in CURATED for p in found if p.place == one.place), "")
    told = [
        f"'{page.page if len(books) == 1 else page.place}' ({page.about_page})"
        for page in found[:_MOST]
    ]
    more = f" and {len(found) - _MOST} more" if len(found) > _MOST else ""
    how = f"by {argument('page')}" if len(books) == 1 else "in place of it"
    also = f", or say '{short}'" if short else ""
    return (
        f"'{name}' has {len(found)} pages; name one {how}{also}: {', '.join(told)}{more} "
        f"('optipath materials {name}' lists them)"
    )


def _unknown(name: str, page: str, curated: CuratedName | None) -> str:
    """Return the sentence for a name that nothing has, with the one that was meant."""
    pages = catalog_pages()
    book = curated.place.split("/")[1] if curated else name
    if page and (of_book := [p.page for p in pages if _underscored(p.book) == _underscored(book)]):
        return f"material '{name}' has no page '{page}'{_meant(page, of_book)}"
    if close := _page_meant(name, pages):
        return f"material '{name}' is unknown; did you mean '{close}'?"
    known = [*[n for c in CURATED for n in c.names], VACUUM, *dict.fromkeys(p.book for p in pages)]
    glasses = [p.page for p in pages if p.shelf == "specs"]
    near = get_close_matches(name, glasses, n=3, cutoff=0.75) if looks_left() else []
    return f"material '{name}' is unknown{_meant(name, [*known[: _MOST_WORDS - 3], *near])}"


def _page_meant(name: str, pages: tuple[CatalogPage, ...]) -> str:
    """Return the page that was meant, of a book that there is; nothing where none is near."""
    book, line, page = _underscored(name).rpartition("/")
    if not line:
        return ""
    curated = curated_names().get(alike(book))
    book = curated.place.rpartition("/")[0] if curated else book
    found = closest(page, [p.page for p in pages if book in (p.book, f"{p.shelf}/{p.book}")])
    return f"{book}/{found}" if found else ""


def _meant(word: str, known: list[str]) -> str:
    if (found := closest(word, known)) is not None:
        return f"; did you mean '{found}'?"
    listed = cure("'optipath materials WORD'", "optipath materials WORD")
    return f"; {listed} lists what there is, such as {', '.join(known[:8])}"
