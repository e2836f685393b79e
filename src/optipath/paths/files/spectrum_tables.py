"""Spectra and sampled curves in preset files."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import PresetError, UnitError
from optipath.faults import shown
from optipath.materials.material import K, N
from optipath.materials.quantities import spectrum_meant
from optipath.materials.spectrum import Spectrum
from optipath.materials.spectrum_kinds import (
    BlackBody,
    EvenSpectrum,
    GaussianLine,
    Histogram,
    Illuminant,
    Lines,
    Sampled,
    SumOfKinds,
)
from optipath.materials.tables import Tabulated
from optipath.paths.files.schema import checked_table, each_entry, each_key, number_of
from optipath.values.columns import unit_doubted
from optipath.values.units import format_quantity
from optipath.values.wavelength import WAVELENGTH

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.materials.spectrum_kinds import SpectrumKind
    from optipath.values.domains import Domain


_FORMS: dict[str, dict[str, type]] = {
    "wavelengths": {"values": object, "unit": str, "outside": object, "name": str},
    "edges": {"powers": object, "unit": str, "outside": object, "name": str},
    "line": {"line": str, "power": object, "outside": object},
    "led": {"led": str, "width": str, "power": object},
    "black_body": {},
    "illuminant": {"illuminant": str},
    "constant": {},
    "sum": {"sum": list},
}
"""The keys by which the kinds are known, and those that stand beside them, with their types."""
_NEEDED = {"wavelengths": "values", "edges": "powers", "led": "width"}
_SCALE, _OFFSET = "scale", "offset"


def spectrum_of(raw: Any) -> Spectrum:
    """Return the spectrum of a table."""
    if isinstance(raw, str) and (sentence := spectrum_meant(raw)):
        raise PresetError(sentence)
    if not isinstance(raw, dict):
        raise PresetError(f"must be a table of a spectrum, {_known()}, not {shown(raw)}")
    form, *others = [form for form in _FORMS if form in raw] or [""]
    if not form:
        raise PresetError(f"a table of a spectrum needs one of the keys {_known()}")
    if others:
        raise PresetError(f"'{form}' and '{others[0]}' are two spectra; write {{ sum = [...] }}")
    known = {form: object, _SCALE: object, _OFFSET: object} | _FORMS[form]
    checked_table(raw, known, filter(None, [_NEEDED.get(form)]))
    if form == "sum":
        result = reduce(add, each_entry(raw["sum"] or [None], spectrum_of, ".sum"))
    else:
        result = _single(raw, form)
    if _SCALE in raw:
        result = result * raw[_SCALE]
    return result + Spectrum.constant(raw[_OFFSET]) if _OFFSET in raw else result


def spectrum_table(spectrum: Spectrum) -> dict[str, Any]:
    """Return the table of a spectrum, of which the same one is read."""
    return _table(spectrum.kind)


def _known() -> str:
    return ", ".join([f"'{form}'" for form in _FORMS])


def _single(raw: Mapping[str, Any], form: str) -> Spectrum:
    arguments = {key: raw[key] for key in ("width", "power", "outside", "name") if key in raw}
    make = {"wavelengths": Spectrum.sampled, "edges": Spectrum.histogram}.get(form)
    if make is None:
        made: Spectrum = getattr(Spectrum, form)(raw[form], **arguments)
        return made

    def read(key: str, entry: Any) -> list[float]:
        return wavelengths_of(entry, raw.get("unit")) if key == form else samples_of(entry, "")

    return make(
        *each_key({key: raw[key] for key in (form, _NEEDED[form])}, read).values(), **arguments
    )


def _table(kind: SpectrumKind) -> dict[str, Any]:
    if isinstance(kind, SumOfKinds):
        return {"sum": [_table(term) for term in kind.terms]}
    if isinstance(kind, Lines):
        tables = [
            {"line": _nm(line.wavelength), "power": line.power} | _outside(line)
            for line in kind.lines
        ]
        return tables[0] if len(tables) == 1 else {"sum": tables}
    if isinstance(kind, Sampled):
        table = written_wavelengths(kind.wavelengths) | {"values": kind.values.tolist()}
        return table | _outside(kind) | {"name": kind.label}
    if isinstance(kind, Histogram):
        table = written_wavelengths(kind.edges, "edges") | {"powers": kind.powers.tolist()}
        return table | _outside(kind) | {"name": kind.label}
    if isinstance(kind, GaussianLine):
        return {"led": _nm(kind.peak), "width": _nm(kind.width), "power": kind.power}
    if isinstance(kind, EvenSpectrum):
        return {"constant": kind.value}
    assert isinstance(kind, (BlackBody, Illuminant))  # noqa: S101 - there are no others
    scale: dict[str, Any] = {} if kind.factor == 1.0 else {_SCALE: kind.factor}
    if isinstance(kind, BlackBody):
        return {"black_body": kind.temperature} | scale
    return {"illuminant": kind.name} | scale


def _outside(kind: Any) -> dict[str, Any]:
    return {} if kind.outside is None else {"outside": kind.outside}


def _nm(metres: float) -> str:
    return format_quantity(metres, "nm")


def sampled_curve(raw: Mapping[str, Any], columns: tuple[str, ...], domain: Domain) -> Tabulated:
    """Return the curve through the samples of a table."""
    domains, of_numbers = {"n": N, "k": K, "values": domain}, columns == ("values",)

    def read(key: str, entry: Any) -> list[float]:
        if key not in domains:
            return wavelengths_of(entry, raw.get("unit"))
        samples = samples_of(entry, domains[key].unit)
        if not of_numbers:
            domains[key].check(key, samples)
        return samples

    keys = [key for key in columns if key in raw or of_numbers]
    axis, *samples = each_key({key: raw.get(key) for key in ("wavelengths", *keys)}, read).values()
    how = {key: raw[key] for key in ("interpolation", "extrapolate") if key in raw}
    usual = f"{domain.name} by wavelength" if of_numbers else "the table"
    parts = tuple(key.removesuffix("s") for key in keys)
    return Tabulated(raw.get("name", usual), parts, axis, samples, **how)


def wavelengths_of(raw: Any, unit: Any = None) -> list[float]:
    """Return wavelengths in metres."""

    def wavelength(entry: Any) -> float:
        if isinstance(entry, str):
            return float(WAVELENGTH.parse(entry))
        number = number_of(entry, "")
        if unit is None:
            raise UnitError('a wavelength has no unit; add unit = "nm" to the table')
        return float(WAVELENGTH.parse(f"{number} {unit}"))

    results = _each(raw, wavelength)
    texts = any(isinstance(entry, str) for entry in raw)
    if not texts and (doubt := unit_doubted(results, unit)):
        raise PresetError(doubt)
    return results


def samples_of(raw: Any, unit: str) -> list[float]:
    """Return the samples of one quantity in base units."""

    def sample(entry: Any) -> float:
        number = number_of(entry, unit)
        if isinstance(number, complex) or not np.isfinite(number):
            raise PresetError(f"{shown(entry)} is no finite real number")
        return number

    return _each(raw, sample)


def _each(raw: Any, read: Callable[[Any], float]) -> list[float]:
    """Return the numbers of a list, with the place of each fault."""
    if not isinstance(raw, list) or not raw:
        raise PresetError(f"{shown(raw)} must be a list of one number or more")
    return each_entry(raw, read)


def written_wavelengths(metres: Any, key: str = "wavelengths") -> dict[str, Any]:
    """Return wavelengths (n,) in metres as a table has them, which read as the same numbers.

    >>> written_wavelengths([5e-07, 5.2e-07])
    {'wavelengths': [500.0, 520.0], 'unit': 'nm'}
    """
    metres = np.asarray(metres).tolist()
    texts = [_nm(one) for one in metres]
    numbers = [float(text.split()[0]) for text in texts]
    if not unit_doubted(metres, "nm") and wavelengths_of(numbers, "nm") == metres:
        return {key: numbers, "unit": "nm"}
    return {key: texts}
