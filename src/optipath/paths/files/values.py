"""Values in preset files, read and written: ``"30 deg"``, ``"$name"``, ``{material = "gold"}``."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import reduce
from inspect import Parameter as Argument
from inspect import signature
from itertools import chain, repeat
from operator import add, sub
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertex_chain import VerticesByAngles, VerticesDomain
from optipath.errors import OptipathError, PresetError, UnitError
from optipath.faults import did_you_mean, shown
from optipath.materials.crystals import CRYSTALS, Crystal
from optipath.materials.formulas import (
    EVERYWHERE,
    REAL,
    Cauchy,
    DrudeLorentz,
    Sellmeier,
    TaucLorentz,
)
from optipath.materials.index_domains import (
    FOLLOWED_OUTSIDE,
    FOLLOWS,
    INDEX,
    LENGTH_OF_LAYER,
    Followed,
    IndexDomain,
    IndicesDomain,
    LengthsDomain,
    OutsideDomain,
)
from optipath.materials.material import PARTS, K, Material
from optipath.materials.quantities import AMPLITUDE, ANGLE, SpectralDomain
from optipath.materials.spectrum import Spectrum
from optipath.materials.tables import PageCurve, Tabulated
from optipath.paths.files.schema import checked_table, each_entry, each_key, number_of
from optipath.paths.files.spectrum_tables import (
    sampled_curve,
    spectrum_of,
    spectrum_table,
    written_wavelengths,
)
from optipath.values.arrays import array_of, same
from optipath.values.curve import CurveSum, WavelengthRange
from optipath.values.curve_value import CurveValue, curve_values
from optipath.values.domains import Choice, Domain
from optipath.values.parameters import Parameter
from optipath.values.units import format_quantity
from optipath.values.use import axes_for
from optipath.values.wavelength import WAVELENGTH, Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from optipath.materials.formulas import FormulaCurve
    from optipath.values.curve import Curve
    from optipath.values.use import Use

    Parameters = Mapping[str, Parameter]


_AFFINE = {"parameter": str, "scale": object, "offset": object}
"""The keys of a multiple of a parameter with an offset."""

_ANGLES, _BACKWARDS = ("incidences", "turns"), "backwards"
"""The keys of a chain of vertices by angles."""

_FORMULAS: dict[str, type[FormulaCurve]] = {
    "sellmeier": Sellmeier,
    "cauchy": Cauchy,
    "drude_lorentz": DrudeLorentz,
    "tauc_lorentz": TaucLorentz,
}
"""The formulas by the keys under which their coefficients stand."""

_MATERIAL, _SAMPLES, _CRYSTAL = "material", "wavelengths", "crystal"
_SUM, _DIFFERENCE = "sum", "difference"
_TEXTS = ("page", "interpolation", "extrapolate")
_CURVES = {
    _MATERIAL: (*_TEXTS, *PARTS),
    _SAMPLES: ("unit", "interpolation", "extrapolate", "name"),
    **dict.fromkeys(_FORMULAS, ("name", "span")),
    _CRYSTAL: (),
    _SUM: (),
    _DIFFERENCE: (),
}
"""The keys by which a table is known for a curve, and those that may stand beside them."""

_WHEN = "wavelength"
"""The key, and the name of the parameter that is taken where it is left out."""

_OF_NUMBER = ("part", "scale", "offset")
_TEXT_KEYS = {_MATERIAL, _CRYSTAL, "name", "unit", *_TEXTS}


def decode(raw: Any, domain: Domain, parameters: Parameters) -> Any:
    """Return the value of an element's field, in base units."""
    if isinstance(domain, Choice):
        return domain.check("the value", raw)
    if entry_domain(domain) is not None:
        return _list(raw, domain, parameters)
    if isinstance(domain, Followed) and raw == FOLLOWS.word:
        return FOLLOWS
    if isinstance(raw, dict):
        return _of_table(raw, domain, parameters)
    if isinstance(raw, str):
        return _of_text(raw, domain, parameters)
    number = _number(raw, domain.unit)
    if isinstance(number, list):
        array_of("a list", number, UnitError)
    return number


def _of_table(raw: dict[str, Any], domain: Domain, parameters: Parameters) -> Any:
    if isinstance(domain, SpectralDomain) and "parameter" not in raw:
        curve = {key: value for key, value in raw.items() if key != _WHEN}
        return spectrum_of(curve).at(_wavelength(raw, parameters))
    if not raw.keys().isdisjoint(_CURVES):
        return _curve(raw, domain, parameters)
    if raw.keys() & _AFFINE.keys():
        return _affine(raw, domain, parameters)
    if _is_of_index(domain):
        parts = _parts(raw, domain, parameters)
        if parts.keys() == {"n"} and isinstance(parts["n"], list):
            return np.array(parts["n"])
        return Material(**parts)
    if domain.complex_parts:
        return _complex(_parts(raw, domain, {}))
    if isinstance(domain, VerticesDomain):
        checked_table(raw, {**dict.fromkeys(_ANGLES, list), _BACKWARDS: bool})
        incidences, turns = [
            each_entry(raw.get(key, []), lambda one: decode(one, ANGLE, parameters), f".{key}")
            for key in _ANGLES
        ]
        return VerticesByAngles(tuple(incidences), tuple(turns), raw.get(_BACKWARDS, False))
    return number_of(raw, domain.unit)  # Which it is not.


def _is_of_index(domain: Domain) -> bool:
    return isinstance(domain, (IndexDomain, OutsideDomain))


def _of_text(raw: str, domain: Domain, parameters: Parameters) -> Any:
    if "$" in raw:
        return _referred(raw, parameters)
    try:
        return domain.parse(raw)
    except OptipathError:
        if (name := raw.strip()) in parameters:
            cure = f'write "${name}" for the parameter'
            raise PresetError(f"'{raw}' is no number; {cure}") from None
        raise


def decode_argument(raw: Any, parameter: Parameter, uses: Iterable[Use] = ()) -> Any:
    """Return the value of a parameter, a default or one of a case, in base units."""
    if isinstance(raw, str):
        value = axes_for(parameter.name, raw, uses)
        return parameter.parse(value) if isinstance(value, str) else value
    if isinstance(raw, list):
        several = [decode_argument(entry, parameter, uses) for entry in raw]
        return array_of("the value", several) if {*map(type, several)} == {float} else several
    if isinstance(raw, dict):
        domain = AMPLITUDE if raw.keys() & AMPLITUDE.complex_parts else INDEX
        return _complex(_parts(raw, domain, {}))
    return number_of(raw, parameter.unit)


def text_or_number(raw: Any, unit: str) -> Any:
    """Return a number, which has no unit; a text, which a `Parameter` reads, as it is."""
    return raw if isinstance(raw, (str, list)) else number_of(raw, unit)


def _referred(raw: str, parameters: Parameters) -> Parameter:
    """Return the parameter that ``"$name"`` or ``"-$name"`` stands for."""
    sign, _, name = raw.partition("$")
    if sign in ("", "-") and name in parameters:
        return -parameters[name] if sign else parameters[name]
    if sign in ("", "-") and name.isidentifier():
        known = [f"${parameter}" for parameter in parameters]
        raise PresetError(f"parameter '{raw}' is not declared{did_you_mean(raw, known)}")
    multiple = '{ parameter = "NAME", scale = 0.5, offset = ... }'
    raise PresetError(f"'{raw}' is no name of a parameter; write a multiple as {multiple}")


def _affine(raw: Any, domain: Domain, parameters: Parameters) -> Parameter:
    """Return a multiple of a parameter with an offset that is written as a table."""
    checked_table(raw, _AFFINE, ("parameter",))
    name, units = raw["parameter"], {"scale": "", "offset": domain.unit}
    if name not in parameters:
        raise PresetError(f"parameter '{name}' is not declared{did_you_mean(name, parameters)}")
    numbers = {key: raw[key] for key in units if key in raw}
    each: Any = each_key(numbers, lambda key, number: number_of(number, units[key]))
    return replace(parameters[name], **each)


def _parts(raw: Any, domain: Domain, parameters: Parameters) -> dict[str, Any]:
    """Return the parts of a complex number or a material that is written as a table."""
    names = domain.complex_parts or INDEX.complex_parts
    of_index = names == INDEX.complex_parts
    checked_table(raw, (*names, *_CURVES) if of_index else names, names[:1])
    domains = dict.fromkeys(names, Domain(domain.name)) | ({"k": K} if of_index else {})
    return _of_keys(raw, domains, parameters)


def _of_keys(
    raw: Mapping[str, Any], domains: Mapping[str, Domain], parameters: Parameters
) -> dict[str, Any]:
    """Return the values of those keys of a table that it has."""
    values = {key: raw[key] for key in domains if key in raw}
    return each_key(values, lambda key, value: decode(value, domains[key], parameters))


def _complex(parts: Mapping[str, Any]) -> Any:
    try:
        real, *imaginary = map(np.asarray, parts.values())
        return (real + 1j * sum(imaginary))[()]
    except ValueError:
        names = " and ".join(f"'{name}'" for name in parts)
        raise UnitError(f"the shapes of {names} do not fit; make all rows equally long") from None


def _number(raw: Any, unit: str) -> Any:
    if not isinstance(raw, list):
        return number_of(raw, unit)
    if not raw:
        raise UnitError("an empty list is no value; give at least one number")
    return [_number(entry, unit) for entry in raw]


def entry_domain(domain: Domain) -> Domain | None:
    """Return what each entry of a list may be; None where a value is no list of values."""
    if isinstance(domain, IndicesDomain):
        return INDEX
    return LENGTH_OF_LAYER if isinstance(domain, LengthsDomain) else None


def _list(raw: Any, domain: Domain, parameters: Parameters) -> list[Any]:
    """Return the values of a list of indices, or of lengths."""
    of_indices, each = isinstance(domain, IndicesDomain), entry_domain(domain) or domain
    if not isinstance(raw, list):
        example = "[1, 1.5, { n = 0.6, k = 2 }]" if of_indices else '["2 mm", "0.1 mm"]'
        raise PresetError(f"{shown(raw)} is no list; write one such as {example}")
    domains = chain([FOLLOWED_OUTSIDE if of_indices else each], repeat(each))
    pairs = zip(raw, domains, strict=False)
    return each_entry(pairs, lambda pair: decode(pair[0], pair[1], parameters))


def _wavelength(raw: Mapping[str, Any], parameters: Parameters) -> Any:
    """Return the wavelength at which a curve is read."""
    if _WHEN not in raw:
        return parameters.get(_WHEN) or Wavelength()
    return _of_keys(raw, {_WHEN: WAVELENGTH}, parameters)[_WHEN]


def _curve(raw: Mapping[str, Any], domain: Domain, parameters: Parameters) -> Any:
    """Return what stands for a table of what depends on the wavelength."""
    form, *others = [key for key in _CURVES if key in raw]
    if others:
        raise PresetError(f"'{form}' and '{others[0]}' say one thing twice; leave one of them out")
    if domain.tail:
        cure = "give them for each wavelength, as a parameter"
        raise PresetError(f"'{form}' gives one number, but several are asked for; {cure}")
    of_index = _is_of_index(domain)
    if form in (_SUM, _DIFFERENCE):
        if of_index:
            raise PresetError(f"'{form}' gives one number; write {{ n = {{ {form} = ... }} }}")
        return _placed(_together(raw, form, domain, parameters), raw, domain, parameters)
    if of_index:
        return Material(**_numbers(raw, form, domain, parameters))
    own = {key: raw[key] for key in raw if key not in _OF_NUMBER}
    results = _numbers(own, form, domain, parameters)
    part = raw.get("part", "k" if domain is K and "k" in results else next(iter(results)))
    if part not in results:
        raise PresetError(f"'part' is '{part}', but the table has {' and '.join(results)}")
    return _placed(results[part], raw, domain, parameters)


def _numbers(
    raw: Mapping[str, Any], form: str, domain: Domain, parameters: Parameters
) -> dict[str, Any]:
    """Return the numbers that a table gives, by the names of the parts of its curve."""
    of_index, keys = _is_of_index(domain), [form, *_CURVES[form]]
    columns = ("n", "k") if of_index or not raw.keys().isdisjoint(("n", "k")) else ("values",)
    if form == _SAMPLES:
        keys += columns
    elif form in _FORMULAS and of_index:
        keys.append("k")
    known = {key: str if key in _TEXT_KEYS else object for key in (*keys, _WHEN)}
    checked_table(raw, known, ("n",) if form == _SAMPLES and of_index else ())
    when = _wavelength(raw, parameters)
    if form == _MATERIAL:
        texts: dict[str, Any] = {key: raw[key] for key in _TEXTS if key in raw}
        numbers = _of_keys(raw, PARTS, parameters)
        named = Material.named(raw[_MATERIAL], wavelength=when, **texts, **numbers)
        return {"n": named.n, "k": named.k}
    if form == _CRYSTAL:
        return {_CRYSTAL: _number_of_crystal(raw[_CRYSTAL], domain, when)}
    # The k of a material may stand beside a formula or samples, and be none of it.
    has_own_k = of_index and "k" in raw and not (form == _SAMPLES and isinstance(raw["k"], list))
    if form == _SAMPLES:
        curve: Curve = sampled_curve(raw, ("n",) if has_own_k else columns, domain)
    else:
        curve = _formula(raw, form, parameters)
    if not isinstance(when, Parameter):
        WavelengthRange.of(curve).check(_WHEN, when)
    results = dict(zip(curve.parts, curve_values(curve, when), strict=True))
    if has_own_k:
        if "k" in results:
            raise PresetError(f"'{form}' gives k as well; leave k out")
        results |= _of_keys(raw, {"k": K}, parameters)
    return results


def _formula(raw: Mapping[str, Any], form: str, parameters: Parameters) -> Curve:
    """Return the curve of a table with a formula."""

    def nested(entry: Any, domain: Domain) -> Any:
        if not isinstance(entry, list):
            return decode(entry, domain, parameters)
        return each_entry(entry, lambda one: nested(one, domain))

    known, table = _coefficients_of(form), raw[form]
    needed = [name for name, usual in known.items() if usual is Argument.empty]
    each_key({form: table}, lambda _, coefficients: checked_table(coefficients, [*known], needed))
    arguments = each_key(table, lambda _, entry: nested(entry, REAL), f".{form}")
    span = {key: raw[key] for key in ("span",) if key in raw}
    arguments |= each_key(span, lambda _, ends: nested(ends, WAVELENGTH))
    return _FORMULAS[form](raw.get("name", f"the formula '{form}'"), **arguments)


def _coefficients_of(form: str) -> dict[str, Any]:
    """Return the names of the coefficients of a formula, with what they are by default."""
    arguments = signature(_FORMULAS[form]).parameters.values()
    return {a.name: a.default for a in arguments if a.name not in ("label", "span")}


_QUANTITIES = {"": "birefringence", "angle per length": "rotatory_power"}
"""What a crystal gives for a dimension."""


def _number_of_crystal(raw: str, domain: Domain, wavelength: Any) -> Any:
    """Return what a crystal gives where one number stands."""
    crystal = Crystal.named(raw, wavelength)
    request = "" if _is_of_index(domain) else _QUANTITIES.get(domain.dimension, "")
    result = getattr(crystal, request, None)
    if result is None:
        known = "it gives a birefringence, and quartz a rotatory power"
        raise PresetError(f"{crystal.label} gives no {domain.name}; {known}")
    return result


def _together(raw: Mapping[str, Any], form: str, domain: Domain, parameters: Parameters) -> Any:
    """Return a sum or a difference of numbers by wavelength."""
    checked_table(raw, (form, *_OF_NUMBER[1:]))
    terms = raw[form]
    if not isinstance(terms, list) or len(terms) < 2 or (form == _DIFFERENCE and len(terms) > 2):
        many = "two tables" if form == _DIFFERENCE else "two tables or more"
        raise PresetError(f"'{form}' must be a list of {many}, not {shown(terms)}")
    results = each_entry(terms, lambda term: decode(term, domain, parameters), f".{form}")
    return reduce(sub if form == _DIFFERENCE else add, results)


def _placed(value: Any, raw: Mapping[str, Any], domain: Domain, parameters: Parameters) -> Any:
    """Return a multiple of a value with an offset, where the table says so."""
    numbers = _of_keys(raw, {"scale": Domain("scale"), "offset": domain}, parameters)
    value = numbers["scale"] * value if "scale" in numbers else value
    return value + numbers["offset"] if "offset" in numbers else value


def _in(raw: Any) -> list[Any]:
    """Return a part of a document and all that stands in it."""
    results = [raw]
    for entry in results:
        if isinstance(entry, dict):
            results += entry.values()
        elif isinstance(entry, list):
            results += entry
    return results


def references_in(raw: Any) -> set[str]:
    """Return the names of the parameters that a part of a document refers to.

    >>> mirror = {"index": {"n": "$n1", "k": 0.1}, "azimuth": {"parameter": "rho", "scale": -2}}
    >>> sorted(references_in([mirror, "-$phi"]))
    ['n1', 'phi', 'rho']
    """
    result = set()
    for entry in _in(raw):
        if isinstance(entry, str) and entry.startswith(("$", "-$")):
            result.add(entry.partition("$")[2])
        elif isinstance(entry, dict) and isinstance(name := entry.get("parameter"), str):
            result.add(name)
    return result


def wavelength_names(raw: Any) -> set[str]:
    """Return the names of parameters used as a wavelength; ``wavelength`` is always one.

    >>> sorted(wavelength_names([{"wavelength": "$lam"}, {"thickness": "$d"}]))
    ['lam', 'wavelength']
    """
    whens = [entry.get(_WHEN) for entry in _in(raw) if isinstance(entry, dict)]
    names = [when.get("parameter") if isinstance(when, dict) else when for when in whens]
    return {_WHEN, *(name.lstrip("-").lstrip("$") for name in names if isinstance(name, str))}


def encode(value: Any, unit: str, complex_parts: tuple[str, ...] = INDEX.complex_parts) -> Any:
    """Write a value so that decoding gives it back."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, CurveValue):
        table = _table(value.curve, value.depends_on, unit) | _part(value.curve, value.place)
        return table | _multiple(value, unit)
    if isinstance(value, Parameter):
        if value.is_signed:
            return f"{'-' * value.is_negative}${value.name}"
        return {"parameter": value.name} | _multiple(value, unit)
    if value is FOLLOWS:
        return FOLLOWS.word
    if isinstance(value, Material):
        return _material(value)
    if isinstance(value, VerticesByAngles):
        table = {key: encode(getattr(value, key), ANGLE.unit) for key in _ANGLES}
        return table | ({_BACKWARDS: True} if value.backwards else {})
    if isinstance(value, str):
        return value
    if isinstance(value, complex) or (isinstance(value, np.ndarray) and value.dtype.kind == "c"):
        number = np.asarray(value)
        return dict(zip(complex_parts, (number.real.tolist(), number.imag.tolist()), strict=True))
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [encode(entry, unit) for entry in value]
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return format_quantity(value, unit) if unit and np.isfinite(value) else value
    raise PresetError(f"{shown(value)} has no form in a preset file; use numbers or parameters")


def _multiple(value: Parameter, unit: str) -> dict[str, Any]:
    """Return the keys of a scale and an offset, where there are such."""
    scale = {} if value.scale == 1.0 else {"scale": encode(value.scale, "")}
    return scale | ({"offset": encode(value.offset, unit)} if value.offset else {})


def _material(material: Material) -> dict[str, Any]:
    """Return the shortest table of which a material is read: of a curve, or of n and k apart."""
    n, k = material.n, material.k
    arguments: list[Any] = [n, k]
    for value in arguments:
        arguments += value.arguments if isinstance(value, CurveValue) else ()
    known = {one.name: one.alone() for one in arguments if isinstance(one, Parameter)}
    apart = {"n": encode(n, ""), "k": encode(k, "")}
    for value, others in ((n, ()), (n, "k"), (k, "n")):
        # Beside the name of a page, n or k may be given.
        if isinstance(value, CurveValue) and (isinstance(value.curve, PageCurve) or not others):
            table = _table(value.curve, value.depends_on) | {part: apart[part] for part in others}
            with suppress(OptipathError):
                if same(decode(table, INDEX, known), material):
                    return table
    return apart


def _part(curve: Curve, place: int) -> dict[str, str]:
    """Return the key of a part, n or k, where a curve has several."""
    alone = len(curve.parts) == 1 and not isinstance(curve, PageCurve)
    return {} if alone else {"part": curve.parts[place]}


def _table(curve: Curve, depends_on: tuple[Any, ...], unit: str = "") -> dict[str, Any]:
    """Return the table of the curve that a value follows from."""
    crystal = _crystal_of(curve)
    form = next((form for form, of in _FORMULAS.items() if type(curve) is of), "")
    if crystal:
        table: dict[str, Any] = {_CRYSTAL: crystal}
    elif isinstance(curve, CurveSum):
        return _sum(curve, depends_on, unit)
    elif isinstance(curve, Spectrum):
        table = spectrum_table(curve)
    elif isinstance(curve, Tabulated):
        table = _samples(curve, unit)
    elif isinstance(curve, PageCurve) and curve.asked:
        table = {_MATERIAL if key == "name" else key: text for key, text in curve.asked.items()}
    elif form:
        given = {name: getattr(curve, name) for name in _coefficients_of(form)}
        numbers = {name: encode(value, "") for name, value in given.items() if value is not None}
        table = {form: numbers, "name": curve.label}
        if curve.span != EVERYWHERE:
            table["span"] = [encode(end, WAVELENGTH.unit) for end in curve.span]
    else:
        raise PresetError(f"{curve.label} has no form in a preset file; give samples of it")
    when = depends_on[0]
    if isinstance(when, Parameter) and when.name == _WHEN == when.quantity:
        return table
    return table | {_WHEN: encode(when, WAVELENGTH.unit)}


def _crystal_of(curve: Curve) -> str:
    """Return the name of the crystal that a curve is of; ``""`` for any other."""
    for name in CRYSTALS:
        crystal = Crystal.named(name)
        for quantity in _QUANTITIES.values():
            if getattr(getattr(crystal, quantity), "curve", None) == curve:
                return name
    return ""


def _samples(curve: Tabulated, unit: str) -> dict[str, Any]:
    table = written_wavelengths(curve.wavelengths)
    for part, column in zip(curve.parts, curve.columns, strict=True):
        key, of = ("values", unit) if part == "value" else (part, "")
        table[key] = encode(np.asarray(column), of)
    if curve.interpolation != "linear":
        table["interpolation"] = curve.interpolation
    if curve.extrapolate:
        table["extrapolate"] = curve.extrapolate
    return table | {"name": curve.label}


def _sum(curve: CurveSum, depends_on: tuple[Any, ...], unit: str) -> dict[str, Any]:
    """Return the table of a sum; what is added stands with its first term."""
    when, *left = depends_on
    terms = []
    for factor, one, place in curve.terms:
        count = len(one.arguments())
        own, left = (when, *left[:count]), left[count:]
        table = _table(one, own, unit) | _part(one, place)
        terms.append(table | ({"scale": factor} if factor != 1.0 else {}))
    if curve.constant:
        terms[0]["offset"] = encode(curve.constant, unit)
    return {_SUM: terms}
