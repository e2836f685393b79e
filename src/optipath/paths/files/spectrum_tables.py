"""Spectra and sampled curves in preset files."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import PresetError, UnitError, shown
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
from optipath.paths.files.schema import Faults, checked_table, each_entry, number_of
from optipath.values.columns import unit_doubted
from optipath.values.units import format_quantity
from optipath.values.wavelength import WAVELENGTH, Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.materials.spectrum_kinds import EmissionLine, SpectrumKind
    from optipath.values.domains import Domain
    from optipath.values.parameters import Parameter

    Decode = Callable[[Any, Domain], Any]


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
_WHEN, _SCALE, _OFFSET = "wavelength", "scale", "offset"


def decode_spectrum(
    raw: Mapping[str, Any], parameters: Mapping[str, Parameter], decode: Decode
) -> Any:
    """Return what stands for a spectrum at the wavelength of a run."""
    faults = Faults()
    when: Any = parameters.get(_WHEN) or Wavelength()
    if _WHEN in raw:
        when = faults.attempt(f".{_WHEN}", decode, raw[_WHEN], WAVELENGTH)
    spectrum = faults.attempt("", spectrum_of, {key: raw[key] for key in raw if key != _WHEN})
    faults.refuse()
    return spectrum.at(when)  # type: ignore[union-attr] # none without faults


def spectrum_of(raw: Any) -> Spectrum:
    """Return the spectrum of a table.

    >>> spectrum_of({"line": "633 nm", "power": 2.0})
    <Spectrum: the line at 633 nm>
    """
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
    result = _terms(raw) if form == "sum" else _single(raw, form)
    if _SCALE in raw:
        result = result * raw[_SCALE]
    return result + Spectrum.constant(raw[_OFFSET]) if _OFFSET in raw else result


def spectrum_table(spectrum: Spectrum) -> dict[str, Any]:
    """Return the table of a spectrum, of which the same one is read.

    >>> spectrum_table(Spectrum.line("633 nm", power=2.0) * 3)
    {'line': '633 nm', 'power': 6.0}
    """
    return _table(spectrum.kind)


def _known() -> str:
    return ", ".join([f"'{form}'" for form in _FORMS])


def _terms(raw: Mapping[str, Any]) -> Spectrum:
    return reduce(add, each_entry(raw["sum"] or [None], spectrum_of, ".sum"))


def _single(raw: Mapping[str, Any], form: str) -> Spectrum:
    arguments = {key: raw[key] for key in ("power", "outside", "name") if key in raw}
    if form in ("wavelengths", "edges"):
        column = _NEEDED[form]
        faults = Faults()
        places = faults.attempt(f".{form}", wavelengths_of, raw[form], raw.get("unit"))
        numbers = faults.attempt(f".{column}", samples_of, raw[column], "")
        faults.refuse()
        make = Spectrum.sampled if form == "wavelengths" else Spectrum.histogram
        return make(places, numbers, **arguments)
    if form == "led":
        return Spectrum.led(raw["led"], raw["width"], **arguments)
    made: Spectrum = getattr(Spectrum, form)(raw[form], **arguments)
    return made


def _table(kind: SpectrumKind) -> dict[str, Any]:
    if isinstance(kind, SumOfKinds):
        return {"sum": [_table(term) for term in kind.terms]}
    if isinstance(kind, Lines):
        tables = [_line(line) for line in kind.lines]
        return tables[0] if len(tables) == 1 else {"sum": tables}
    if isinstance(kind, (Sampled, Histogram)):
        return _columns(kind)
    if isinstance(kind, GaussianLine):
        return {"led": _nm(kind.peak), "width": _nm(kind.width), "power": kind.power}
    if isinstance(kind, EvenSpectrum):
        return {"constant": kind.value}
    if isinstance(kind, BlackBody):
        return {"black_body": kind.temperature} | _scale(kind.factor)
    assert isinstance(kind, Illuminant)  # noqa: S101 - there are no others
    return {"illuminant": kind.name} | _scale(kind.factor)


def _columns(kind: Sampled | Histogram) -> dict[str, Any]:
    if isinstance(kind, Sampled):
        table = written_wavelengths(kind.wavelengths) | {"values": kind.values.tolist()}
    else:
        written = written_wavelengths(kind.edges)
        table = {"edges": written.pop("wavelengths"), **written, "powers": kind.powers.tolist()}
    outside = {} if kind.outside is None else {"outside": kind.outside}
    return table | outside | {"name": kind.label}


def _line(line: EmissionLine) -> dict[str, Any]:
    outside = {} if line.outside is None else {"outside": line.outside}
    return {"line": _nm(line.wavelength), "power": line.power} | outside


def _nm(metres: float) -> str:
    return format_quantity(metres, "nm")


def _scale(factor: float) -> dict[str, Any]:
    return {} if factor == 1.0 else {_SCALE: factor}


_NM = "nm"


def sampled_curve(raw: Mapping[str, Any], columns: tuple[str, ...], domain: Domain) -> Tabulated:
    """Return the curve through the samples of a table."""
    faults, domains = Faults(), {"n": N, "k": K, "values": domain}
    of_numbers = columns == ("values",)
    arguments = [key for key in columns if key in raw or of_numbers]
    axis = faults.attempt(".wavelengths", wavelengths_of, raw["wavelengths"], raw.get("unit"))
    samples = []
    for key in arguments:
        read = faults.attempt(f".{key}", samples_of, raw.get(key), domains[key].unit)
        samples.append(read)
        if read is not None and not of_numbers:
            faults.attempt(f".{key}", domains[key].check, key, read)
    faults.refuse()
    how = {key: raw[key] for key in ("interpolation", "extrapolate") if key in raw}
    usual = f"{domain.name} by wavelength" if of_numbers else "the table"
    parts = tuple(key.removesuffix("s") for key in arguments)
    return Tabulated(raw.get("name", usual), parts, axis, samples, **how)


def wavelengths_of(raw: Any, unit: Any = None) -> list[float]:
    """Return wavelengths in metres.

    >>> wavelengths_of([500, 520], "nm"), wavelengths_of(["0.5 um"])
    ([5e-07, 5.2e-07], [5e-07])
    """
    results = _each(raw, _wavelength, unit)
    texts = [entry for entry in raw if isinstance(entry, str)]
    if not texts and (doubt := unit_doubted(results, unit)):
        raise PresetError(doubt)
    return results


def _wavelength(entry: Any, unit: str | None) -> float:
    if isinstance(entry, str):
        return float(WAVELENGTH.parse(entry))
    number = number_of(entry, "")
    if unit is None:
        raise UnitError('a wavelength has no unit; add unit = "nm" to the table')
    return float(WAVELENGTH.parse(f"{number} {unit}"))


def samples_of(raw: Any, unit: str) -> list[float]:
    """Return the samples of one quantity in base units.

    >>> samples_of([1.5, 1.6], ""), samples_of(["1 mm"], "mm")
    ([1.5, 1.6], [0.001])
    """
    return _each(raw, _sample, unit)


def _sample(entry: Any, unit: str) -> float:
    number = number_of(entry, unit)
    if isinstance(number, complex) or not np.isfinite(number):
        raise PresetError(f"{shown(entry)} is no finite real number")
    return number


def _each(raw: Any, read: Callable[[Any, Any], float], unit: Any) -> list[float]:
    """Return the numbers of a list, with the place of each fault."""
    if not isinstance(raw, list) or not raw:
        raise PresetError(f"{shown(raw)} must be a list of one number or more")
    return each_entry(raw, lambda entry: read(entry, unit))


def written_wavelengths(metres: Any) -> dict[str, Any]:
    """Return wavelengths (n,) in metres as a table has them, which read as the same numbers.

    >>> written_wavelengths([5e-07, 5.2e-07])
    {'wavelengths': [500.0, 520.0], 'unit': 'nm'}
    """
    metres = np.asarray(metres).tolist()
    texts = [format_quantity(one, _NM) for one in metres]
    numbers = [float(text.split()[0]) for text in texts]
    if not unit_doubted(metres, _NM) and wavelengths_of(numbers, _NM) == metres:
        return {"wavelengths": numbers, "unit": _NM}
    return {"wavelengths": texts}
