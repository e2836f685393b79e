"""Pages of the refractiveindex.info database, read as n and k, and searched."""

from __future__ import annotations

import re
from decimal import Decimal, InvalidOperation
from html import unescape
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.errors import MaterialError, OptipathError
from optipath.faults import Fault, shown, unknown
from optipath.materials.database_names import (
    CURATED,
    VACUUM,
    NamedPage,
    alike,
    catalog_pages,
    named_page,
    read_yaml,
)
from optipath.materials.formulas import NEAREST_REQUESTED, DispersionFormula
from optipath.materials.tables import EXTRAPOLATIONS, INTERPOLATIONS, PageCurve, Tabulated
from optipath.values.curve import span_text
from optipath.values.curve_value import curve_at
from optipath.values.files import input_file

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence
    from os import PathLike

    from optipath.values.curve import Curve


USUAL = {"interpolation": "linear", "extrapolate": ""}


def parts_by_name(
    name: str, page: str, own: Mapping[str, Any], wavelength: Any, how: Mapping[str, str]
) -> dict[str, Any]:
    """Return n and k of a material by its name. Units: wavelength in metres."""
    arguments = {part: value for part, value in own.items() if value is not None}
    if isinstance(name, str) and alike(name) == VACUUM and not page:
        return {"n": 1.0, "k": 0.0, **arguments}
    result = named_page(name, page)
    clear = result.curated.clear if result.curated and "k" not in arguments else None
    if clear:
        arguments["k"] = 0.0
    return _at(curve_of(result, arguments, how, clear), wavelength, arguments)


def parts_of_file(
    path: str | PathLike[str], own: Mapping[str, Any], wavelength: Any, how: Mapping[str, str]
) -> dict[str, Any]:
    """Return n and k at wavelengths in metres from a YAML file of refractiveindex.info."""
    arguments = {part: value for part, value in own.items() if value is not None}
    file = input_file(path, MaterialError)
    contents = read_yaml(file, str(file), installed=False)
    wanted = _wanted(file.name, arguments)
    return _at(page_curve(contents, file.name, str(file), wanted, how), wavelength, arguments)


def _at(curve: PageCurve, wavelength: Any, own: Mapping[str, Any]) -> dict[str, Any]:
    return {**dict(zip(curve.parts, curve_at(curve, wavelength), strict=True)), **own}


def curve_of(
    result: NamedPage,
    own: Mapping[str, Any],
    how: Mapping[str, str],
    within: tuple[float, float] | None = None,
) -> PageCurve:
    """Return the curve of a page of the database, without the parts that are given apart."""
    about = result.page.place
    return page_curve(
        read_yaml(result.page.file, about, installed=True),
        result.label,
        about,
        _wanted(result.name, own),
        how,
        within=within,
        asked={"name": result.name, **{k: v for k, v in how.items() if v != USUAL[k]}},
        remedy=f"name another page, or mend a copy of {result.page.file} for Material.from_yaml",
    )


def _wanted(name: str, own: Mapping[str, Any]) -> list[str]:
    wanted = [part for part in ("n", "k") if part not in own]
    if not wanted:
        raise MaterialError(
            f"'{name}' is asked for with an n and a k of its own; op.Material(n, k) needs no name"
        )
    return wanted


_ADJECTIVES = {"n": "index of refraction", "k": "extinction coefficient"}


def page_curve(
    contents: Any,
    label: str,
    about: str,
    wanted: Collection[str],
    how: Mapping[str, str],
    *,
    within: tuple[float, float] | None = None,
    asked: Mapping[str, str] | None = None,
    remedy: str = "",
) -> PageCurve:
    """Return the curve of a page."""
    data = contents.get("DATA") if isinstance(contents, dict) else None
    entries, faults = [], list[str]()
    if not isinstance(data, list) or not data:
        faults.append("it has no list DATA of tables and formulas, as refractiveindex.info has")
        data = []
    for at, entry in enumerate(data, 1):
        with OptipathError.collecting(faults, about=f"entry {at} of DATA"):
            entries.append(_entry(entry))
    MaterialError.raise_for([Fault.of(fault).cured(remedy) for fault in faults], about)
    # Of two entries that give one part, the later one counts, as the database's reader has it.
    giving = {part: entry for entry in entries for part in entry.parts}
    MaterialError.raise_for(_lacking(label, part, giving) for part in wanted if part not in giving)
    chosen = {part: entry for part, entry in giving.items() if part in wanted}
    faults += unknown("interpolation", how["interpolation"], INTERPOLATIONS)
    faults += unknown("extrapolate", how["extrapolate"], EXTRAPOLATIONS)
    if how["interpolation"] == "monotone" and not any(entry.columns for entry in chosen.values()):
        faults.append(
            f"{label} is by a formula, of which nothing is interpolated; leave interpolation = "
            f"'monotone' out"
        )
    if how["extrapolate"] == "linear" and not all(entry.columns for entry in chosen.values()):
        faults.append(
            f"{label} is by a formula, which has no straight line beyond its range; "
            f"{NEAREST_REQUESTED}, or stay within it"
        )
    MaterialError.raise_for(faults)
    try:
        curves = [
            entry.curve(label, parts, how)
            for entry in entries
            if (parts := [part for part in entry.parts if chosen.get(part) is entry])
        ]
        clear = None if how["extrapolate"] else within
        source = source_of(contents)
        return PageCurve(label, curves, within=clear, place=about, source=source, asked=asked or {})
    except OptipathError as error:
        raise MaterialError(*[fault.cured(remedy) for fault in error.faults]) from None


def source_of(contents: Mapping[str, Any]) -> str:
    """Return the references of a page as plain text.

    >>> source_of({"REFERENCES": "A. Author.<br> <i>J. Opt.</i> <b>1</b>, 2 (1990)"})
    'A. Author. J. Opt. 1, 2 (1990)'
    """
    text = contents.get("REFERENCES")
    words = unescape(re.sub(r"<[^>]*>", " ", text)).split() if isinstance(text, str) else []
    return " ".join(words).replace(" ,", ",")


def _lacking(label: str, part: str, giving: Mapping[str, PageEntry]) -> str:
    has = "".join(f", only {one} within {span_text(entry.span)}" for one, entry in giving.items())
    wanted = "name another page, or give it: "
    wanted += "k = 0.0 where the material is transparent" if part == "k" else "n = 1.5"
    return f"{label} has no {part} ({_ADJECTIVES[part]}){has}; {wanted}"


_POWERS = 300
"""Up to which power of ten a number is a double in any case."""

_TYPE = re.compile(r"tabulated (nk|n|k)|formula (\d{1,3})")


class PageEntry(NamedTuple):
    """One entry under ``DATA``. Units: span, columns in metres."""

    kind: str
    parts: tuple[str, ...]
    span: tuple[float, float]
    columns: tuple[tuple[float, ...], ...] = ()
    coefficients: tuple[float, ...] = ()

    def curve(self, label: str, parts: Sequence[str], how: Mapping[str, Any]) -> Curve:
        """Return the curve of some of its parts."""
        if self.columns:
            columns = [self.columns[1 + self.parts.index(part)] for part in parts]
            return Tabulated(label, tuple(parts), self.columns[0], columns, **how)
        number, extrapolate = int(self.kind.split()[1]), how["extrapolate"]
        return DispersionFormula(label, number, self.coefficients, self.span, extrapolate)


def spans_of(contents: Any) -> dict[str, tuple[float, float]]:
    """Return the wavelengths of each part of a page, of whose tables only these are read."""
    results: dict[str, tuple[float, float]] = {}
    for entry in contents["DATA"]:
        [(parts, _)] = _TYPE.findall(entry["type"])
        if parts:
            words = sorted(entry["data"].split()[:: 1 + len(parts)], key=float)
            span = _metres(Decimal(words[0])), _metres(Decimal(words[-1]))
        else:
            parts, span = "n", _entry(entry).span
        results |= dict.fromkeys(parts, span)
    return results


def _entry(entry: Any) -> PageEntry:
    kind = entry.get("type") if isinstance(entry, dict) else None
    if not isinstance(kind, str) or not (match := _TYPE.fullmatch(kind)):
        raise OptipathError(
            f"is of type {shown(kind)}; give 'tabulated nk', 'tabulated n', 'tabulated k' or "
            f"'formula 1' to 'formula 9'"
        )
    if match[1]:
        return _table(kind, tuple(match[1]), entry.get("data"))
    low_high = _numbers(entry, "range" if "range" in entry else "wavelength_range")
    if len(low_high) != 2 or not 0.0 < float(low_high[0]) < float(low_high[1]):
        raise OptipathError("has no 'wavelength_range' of two rising numbers, in micrometres")
    coefficients = tuple(map(float, _numbers(entry, "coefficients")))
    span = _metres(low_high[0]), _metres(low_high[1])
    return PageEntry(kind, ("n",), span, coefficients=coefficients)


def _table(kind: str, parts: tuple[str, ...], data: Any) -> PageEntry:
    """Return the entry of a table, its rows by wavelength, and each once of those that repeat."""
    if not isinstance(data, str) or not data.strip():
        raise OptipathError(f"('{kind}') has no 'data'; give rows of wavelength and {kind[10:]}")
    rows: set[tuple[float, ...]] = set()
    faults = []
    for at, line in enumerate(data.splitlines(), 1):
        numbers = _decimals(words := line.split())
        if len(numbers) == 1 + len(parts):
            rows.add((_metres(numbers[0]), *map(float, numbers[1:])))
        elif words:
            wrong = shown(" ".join(words))
            faults.append(f"('{kind}') has {wrong} in row {at}; give {1 + len(parts)} numbers")
    OptipathError.raise_for(faults)
    columns = tuple(zip(*sorted(rows), strict=True))
    return PageEntry(kind, parts, (columns[0][0], columns[0][-1]), columns=columns)


def _numbers(entry: dict[str, Any], key: str) -> list[Decimal]:
    text = entry.get(key)
    result = _decimals(text.split()) if isinstance(text, str) else []
    if not result:
        raise OptipathError(f"has no numbers under '{key}', but {shown(text)}")
    return result


def _decimals(words: Sequence[str]) -> list[Decimal]:
    """Return numbers, none of them rounded; nothing where one is no finite number."""
    try:
        results = [Decimal(word) for word in words]
    except InvalidOperation:
        return []
    return results if all(n.is_finite() and n.adjusted() < _POWERS for n in results) else []


def _metres(micrometres: Decimal) -> float:
    """Return a wavelength in metres, rounded once, so that ``"187.9 nm"`` is the same number."""
    return float(micrometres.scaleb(-6))


_RANGE = re.compile(
    r"(?:[:;,] *)?\b(?:n,k|n|k)(?:\(\w\))?[;,]? [\d.e-]+ *[\u2013-] *[\d.e]+ +\u00b5m"
)
"""The range in the title of a page: "n,k 0.188-1.937 um", with a dash."""


def described(one: NamedPage) -> str:
    """Say where numbers are from: the page of a short name and why, else what it is of."""
    page, curated = one.page, one.curated
    if curated:
        return "; ".join([page.place, curated.reference, curated.why])
    messages = (page.about_book, _RANGE.sub("", page.about_page), page.divider)
    return "; ".join(filter(None, messages))


def known_spans(one: NamedPage) -> dict[str, tuple[float, float]]:
    """Return the wavelengths of n and of k, in metres; nothing if a page cannot be read."""
    try:
        result = spans_of(read_yaml(one.page.file, one.page.place, installed=True))
    except (OptipathError, ValueError, ArithmeticError, LookupError, TypeError, AttributeError):
        return {}
    if one.curated and one.curated.clear:
        low, high = one.curated.clear
        result["n"] = max(low, result["n"][0]), min(high, result["n"][1])
    return {part: result[part] for part in ("n", "k") if part in result}


def pages_with(words: Sequence[str]) -> list[NamedPage]:
    """Return the pages in which all of some words occur; those with short names for none."""
    pages = {page.place: page for page in catalog_pages()}
    short = [NamedPage(c.names[0], pages[c.place], c) for c in CURATED if c.place in pages]
    if not words:
        return short
    requests = [word.casefold() for word in words]
    first = [one for one in short if _mentions(one, requests)]
    places = {one.page.place for one in first}
    others = [NamedPage(place, page) for place, page in pages.items() if place not in places]
    found = [one for one in others if _mentions(one, requests)]
    return first + sorted(found, key=lambda one: one.page.book.casefold() not in requests)


def _mentions(one: NamedPage, words: Sequence[str]) -> bool:
    page, names = one.page, one.curated.names if one.curated else ()
    texts = [page.place, page.about_book, page.about_page, page.divider, *names]
    texts += [*map(alike, names), one.curated.why if one.curated else ""]
    text = " ".join(texts).casefold()
    return all(word in text for word in words)
