"""The entries of a page of refractiveindex.info: tables and formulas, read from its YAML."""

from __future__ import annotations

import re
from decimal import Decimal, InvalidOperation
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.errors import OptipathError, ValueFault, shown
from optipath.values.curves.dispersion_formula import DispersionFormula
from optipath.values.curves.tabulated import Tabulated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.values.curves.curve import Curve

_POWERS = 300
"""Up to which power of ten a number is a double in any case."""

_TYPE = re.compile(r"tabulated (nk|n|k)|formula (\d{1,3})")


class PageEntry(NamedTuple):
    """One entry under ``DATA``.

    Units: span, columns in metres.
    """

    kind: str
    parts: tuple[str, ...]
    span: tuple[float, float]
    columns: tuple[tuple[float, ...], ...] = ()
    coefficients: tuple[float, ...] = ()
    rows: tuple[int, ...] = ()

    def curve(
        self, label: str, parts: Sequence[str], interpolation: str, extrapolate: str
    ) -> Curve:
        """Return the curve of some of its parts."""
        if not self.columns:
            number = int(self.kind.split()[1])
            return DispersionFormula(
                label, number, self.coefficients, self.span, extrapolate=extrapolate
            )
        if faults := self._faults_of_rows(label):
            raise ValueFault(*faults)
        wanted = [self.columns[1 + self.parts.index(part)] for part in parts]
        how = {"interpolation": interpolation, "extrapolate": extrapolate}
        return Tabulated(label, tuple(parts), self.columns[0], wanted, **how)

    def _faults_of_rows(self, label: str) -> list[str]:
        """Return what is wrong with the wavelengths of a table."""
        places = self.columns[0]
        faults = [
            f"row {row} of {label} has the wavelength {place * 1e6:.10g}; give lengths above 0"
            for row, place in zip(self.rows, places, strict=True)
            if place <= 0.0
        ]
        same = [at for at in range(1, len(places)) if places[at] == places[at - 1] > 0.0]
        return faults + [
            f"{label} has the wavelength {places[at] * 1e9:.10g} nm twice, in the rows "
            f"{min(self.rows[at - 1 : at + 1])} and {max(self.rows[at - 1 : at + 1])}; give each "
            f"once"
            for at in same
        ]


def entries_of(contents: Any, faults: list[str]) -> list[PageEntry]:
    """Return the entries of a page, and tell what is wrong with others."""
    data = contents.get("DATA") if isinstance(contents, dict) else None
    if not isinstance(data, list) or not data:
        faults.append("it has no list DATA of tables and formulas, as refractiveindex.info has")
        return []
    found = []
    for at, entry in enumerate(data, 1):
        try:
            found.append(_entry(entry))
        except OptipathError as error:
            faults += [f"entry {at} of DATA {fault}" for fault in error.faults]
    return found


def spans_of(contents: Any) -> dict[str, tuple[float, float]]:
    """Return the wavelengths of each part of a page, of whose tables only these are read."""
    found: dict[str, tuple[float, float]] = {}
    for entry in contents["DATA"]:
        [(parts, _)] = _TYPE.findall(entry["type"])
        if parts:
            words = sorted(entry["data"].split()[:: 1 + len(parts)], key=float)
            span = _metres_of([Decimal(words[0]), Decimal(words[-1])])
        else:
            parts, span = "n", _entry(entry).span
        found |= dict.fromkeys(parts, span)
    return found


def _entry(entry: Any) -> PageEntry:
    kind = entry.get("type") if isinstance(entry, dict) else None
    match = _TYPE.fullmatch(kind) if isinstance(kind, str) else None
    if not isinstance(kind, str) or match is None:
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
    return PageEntry(kind, ("n",), _metres_of(low_high), coefficients=coefficients)


def _table(kind: str, parts: tuple[str, ...], data: Any) -> PageEntry:
    """Return the entry of a table, its rows by wavelength, and each once of those that repeat."""
    if not isinstance(data, str) or not data.strip():
        raise OptipathError(f"('{kind}') has no 'data'; give rows of wavelength and {kind[10:]}")
    lines = [(at, line.split()) for at, line in enumerate(data.splitlines(), 1) if line.strip()]
    rows: dict[tuple[float, ...], int] = {}
    faults = []
    for at, words in lines:
        numbers = _decimals(words)
        if not numbers:
            faults.append(f"('{kind}') has no numbers in row {at}, {shown(' '.join(words))}")
            continue
        wavelength, *values = numbers
        if len(values) != len(parts):
            faults.append(
                f"('{kind}') has {len(words)} numbers in row {at}, {shown(' '.join(words))}; give "
                f"{1 + len(parts)}"
            )
            continue
        rows.setdefault((_metres(wavelength), *map(float, values)), at)
    if faults:
        raise OptipathError(*faults)
    ordered = sorted(rows)
    columns = tuple(zip(*ordered, strict=True))
    span = columns[0][0], columns[0][-1]
    found = tuple([rows[row] for row in ordered])
    return PageEntry(kind, parts, span, columns=columns, rows=found)


def _numbers(entry: dict[str, Any], key: str) -> list[Decimal]:
    text = entry.get(key)
    found = _decimals(text.split()) if isinstance(text, str) else []
    if not found:
        raise OptipathError(f"has no numbers under '{key}', but {shown(text)}")
    return found


def _decimals(words: Sequence[str]) -> list[Decimal]:
    """Return numbers, none of them rounded; nothing where one is no finite number."""
    if not all(word.isascii() and "_" not in word for word in words):
        return []  # Python reads 15 into 1_5.
    try:
        found = [Decimal(word) for word in words]
    except InvalidOperation:
        return []
    return found if all(n.is_finite() and n.adjusted() < _POWERS for n in found) else []


def _metres_of(span: Sequence[Decimal]) -> tuple[float, float]:
    low, high = map(_metres, span)
    return low, high


def _metres(micrometres: Decimal) -> float:
    """Return a wavelength in metres, rounded once, so that ``"187.9 nm"`` is the same number."""
    return float(micrometres.scaleb(-6))
