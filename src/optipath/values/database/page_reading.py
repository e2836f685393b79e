"""A page of refractiveindex.info as a curve: n and k, each from the entry that gives it."""

from __future__ import annotations

import re
from html import unescape
from typing import TYPE_CHECKING, Any

from optipath.errors import MaterialError, OptipathError, shown, unknown
from optipath.values.cures import argument
from optipath.values.curves.dispersion_formula import nearest_asked_for
from optipath.values.curves.page_curve import PageCurve
from optipath.values.curves.tabulated import EXTRAPOLATIONS, INTERPOLATIONS
from optipath.values.curves.wavelength_range import span_text
from optipath.values.database.page_entries import PageEntry, entries_of

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

_ADJECTIVES = {"n": "index of refraction", "k": "extinction coefficient"}


def page_curve(
    contents: Any,
    label: str,
    about: str,
    *,
    wanted: Collection[str] = ("n", "k"),
    interpolation: str = "linear",
    extrapolate: str = "",
    within: tuple[float, float] | None = None,
    asked: Mapping[str, str] | None = None,
    remedy: str = "",
) -> PageCurve:
    """Return the curve of a page."""
    faults: list[str] = []
    entries = entries_of(contents, faults)
    if faults:
        raise MaterialError(*_cured(faults, remedy), about=about)
    # Of two entries that give one part, the later one counts, as the database's reader has it.
    giving = {part: entry for entry in entries for part in entry.parts}
    if lacking := [part for part in wanted if part not in giving]:
        raise MaterialError(*[_lacking(label, part, giving) for part in lacking])
    chosen = {part: entry for part, entry in giving.items() if part in wanted}
    _check_asked(label, chosen.values(), interpolation, extrapolate)
    try:
        curves = [
            entry.curve(label, parts, interpolation, extrapolate)
            for entry in entries
            if (parts := [part for part in entry.parts if chosen.get(part) is entry])
        ]
        clear = None if extrapolate else within
        source = source_of(contents)
        return PageCurve(label, curves, within=clear, place=about, source=source, asked=asked)
    except OptipathError as error:
        raise MaterialError(*_cured(error.faults, remedy)) from None


def source_of(contents: Any) -> str:
    """Return the references of a page as plain text.

    Examples
    --------
    >>> source_of({"REFERENCES": "A. Author.<br> <i>J. Opt.</i> <b>1</b>, 2 (1990)"})
    'A. Author. J. Opt. 1, 2 (1990)'
    """
    text = contents.get("REFERENCES", "") if isinstance(contents, dict) else ""
    words = unescape(re.sub(r"<[^>]*>", " ", text)).split() if isinstance(text, str) else []
    return " ".join(words).replace(" ,", ",")


def _lacking(label: str, part: str, giving: Mapping[str, PageEntry]) -> str:
    has = "".join(f", only {one} within {span_text(entry.span)}" for one, entry in giving.items())
    if not argument(part):
        wanted = "name another page"
    elif part == "k":
        wanted = f"where the material is transparent, ask for {argument('k', '0.0')}, or give its k"
    else:
        wanted = f"give it, as {argument('n', '1.5')}"
    return f"{label} has no {part} ({_ADJECTIVES[part]}){has}; {wanted}"


def _cured(faults: Iterable[str], remedy: str) -> list[str]:
    return [f"{fault}; {remedy}" if remedy else fault for fault in faults]


def _check_asked(
    label: str, entries: Collection[PageEntry], interpolation: str, extrapolate: str
) -> None:
    """Refuse what is asked for in vain, or cannot be had."""
    faults = [
        *unknown("interpolation", interpolation, INTERPOLATIONS),
        *unknown("extrapolate", extrapolate, EXTRAPOLATIONS),
    ]
    by_formula = [not entry.columns for entry in entries]
    if not faults and interpolation != "linear" and all(by_formula):
        faults.append(
            f"{label} is by a formula, of which nothing is interpolated; leave interpolation = "
            f"{shown(interpolation)} out"
        )
    if extrapolate == "linear" and any(by_formula):
        faults.append(
            f"{label} is by a formula, which has no straight line beyond its range; "
            f"{nearest_asked_for()}, or stay within it"
        )
    if faults:
        raise MaterialError(*faults)
