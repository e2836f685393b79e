"""Materials, crystals and formulas in preset files, read and written."""

from __future__ import annotations

from functools import reduce
from inspect import Parameter as Argument
from inspect import signature
from operator import add, sub
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, PresetError, shown
from optipath.materials.crystals import CRYSTALS, Crystal
from optipath.materials.formulas import EVERYWHERE, REAL, Cauchy, Sellmeier
from optipath.materials.index_domains import IndexDomain, OutsideDomain
from optipath.materials.material import PARTS, K, Material
from optipath.materials.oscillators import DrudeLorentz, TaucLorentz
from optipath.materials.spectrum import Spectrum
from optipath.materials.tables import PageCurve, Tabulated
from optipath.paths.files.schema import checked_table, each_entry, each_key
from optipath.paths.files.spectrum_tables import sampled_curve, spectrum_table, written_wavelengths
from optipath.values.curve import CurveSum, WavelengthRange
from optipath.values.curve_value import CurveValue, curve_values
from optipath.values.domains import Domain
from optipath.values.parameters import Parameter
from optipath.values.wavelength import WAVELENGTH, Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.materials.formulas import FormulaCurve
    from optipath.values.curve import Curve

    Decode = Callable[[Any, Domain], Any]
    Encode = Callable[[Any, str], Any]


CRYSTAL = "crystal"
"""The key by which such a table is known."""

_QUANTITIES = {"": "birefringence", "angle per length": "rotatory_power"}
"""What a crystal gives for a dimension."""


def number_of_crystal(raw: str, domain: Domain, wavelength: Any) -> Any:
    """Return what a crystal gives where one number stands.

    >>> from optipath.values.domains import Domain
    >>> round(number_of_crystal("quartz", Domain("birefringence"), 5.893e-7), 5)
    0.0091
    """
    crystal = Crystal.named(raw, wavelength)
    of_index = isinstance(domain, (IndexDomain, OutsideDomain))
    request = "" if of_index else _QUANTITIES.get(domain.dimension, "")
    result = getattr(crystal, request, None)
    if result is None:
        raise PresetError(
            f"{crystal.label} gives no {domain.name}; it stands for a birefringence, and quartz "
            f"for a rotatory power"
        )
    return result


def crystal_of(curve: Curve) -> str:
    """Return the name of the crystal that a curve is of; ``""`` for any other.

    >>> crystal_of(Crystal.named("calcite").birefringence.curve)
    'calcite'
    """
    for name in CRYSTALS:
        crystal = Crystal.named(name)
        for quantity in _QUANTITIES.values():
            if getattr(getattr(crystal, quantity), "curve", None) == curve:
                return name
    return ""


FORMULAS: dict[str, type[FormulaCurve]] = {
    "sellmeier": Sellmeier,
    "cauchy": Cauchy,
    "drude_lorentz": DrudeLorentz,
    "tauc_lorentz": TaucLorentz,
}
"""The formulas by the keys under which their coefficients stand."""

COMMON_KEYS = ("name", "span")
"""The keys that stand beside that of the formula."""


def formula_of(raw: Mapping[str, Any], form: str, decode: Decode) -> Curve:
    """Return the curve of a table with a formula."""
    known = _coefficients_of(form)
    table = raw[form]
    needed = [name for name, usual in known.items() if usual is Argument.empty]
    each_key({form: table}, lambda _, raw: checked_table(raw, known.keys(), needed))
    arguments = each_key(table, lambda _, raw: _nested(raw, REAL, decode), f".{form}")
    span = {key: raw[key] for key in ("span",) if key in raw}
    arguments |= each_key(span, lambda _, ends: _nested(ends, WAVELENGTH, decode))
    return FORMULAS[form](raw.get("name", f"the formula '{form}'"), **arguments)


def formula_table(curve: Curve, encode: Encode) -> dict[str, Any] | None:
    """Return the table of a formula; None for another curve."""
    form = next((form for form, of in FORMULAS.items() if type(curve) is of), None)
    if form is None:
        return None
    arguments = {name: getattr(curve, name) for name in _coefficients_of(form)}
    table = {name: encode(value, "") for name, value in arguments.items() if value is not None}
    results: dict[str, Any] = {form: table, "name": curve.label}
    if curve.span != EVERYWHERE:
        results["span"] = [encode(end, WAVELENGTH.unit) for end in curve.span]
    return results


def _coefficients_of(form: str) -> dict[str, Any]:
    """Return the names of the coefficients of a formula, with what they are by default."""
    arguments = signature(FORMULAS[form]).parameters.values()
    return {a.name: a.default for a in arguments if a.name not in ("label", "span")}


def _nested(raw: Any, domain: Domain, decode: Decode) -> Any:
    """Return a number, or a list of such, or of lists of them."""
    if not isinstance(raw, list):
        return decode(raw, domain)
    return each_entry(raw, lambda entry: _nested(entry, domain, decode))


NAMED = "material"
"""The key by which such a table is known."""

_TEXTS = ("page", "interpolation", "extrapolate")
OF_PAGES = (*_TEXTS, *PARTS)
"""The other keys that it may have; n and k in place of what a page has."""


def material_by_name(
    raw: Mapping[str, Any], wavelength: Any, decode: Callable[[Any, Domain], Any]
) -> dict[str, Any]:
    """Return n and k of a material of the database."""
    parts = {key: raw[key] for key in PARTS if key in raw}
    numbers: dict[str, Any] = each_key(parts, lambda key, part: decode(part, PARTS[key]))
    texts: dict[str, Any] = {key: raw[key] for key in _TEXTS if key in raw}
    result = Material.named(raw[NAMED], wavelength=wavelength, **texts, **numbers)
    return {"n": result.n, "k": result.k}


def page_table(curve: PageCurve) -> dict[str, Any] | None:
    """Return the table of a material by name; None for what is read from a file."""
    if not curve.asked:
        return None
    return {NAMED if key == "name" else key: text for key, text in curve.asked.items()}


def own_part(curve: PageCurve, n: Any, k: Any) -> dict[str, Any]:
    """Return which of n and k a table has to say beside the name of a material."""
    arguments = {"n": n, "k": k}
    own = {part: arguments[part] for part in arguments if part not in curve.parts}
    try:
        usual = Material.named(**curve.asked)
    except OptipathError:
        return own  # Without them, it is no material.
    same = isinstance(usual.n, CurveValue) and usual.n.curve.span == curve.span
    return {} if same and own == {"k": 0.0} == {"k": usual.k} else own


def is_usual_part(curve: PageCurve, part: str) -> bool:
    """Tell whether a name by itself gives a curve: an index without k may reach further."""
    try:
        usual = getattr(Material.named(**curve.asked), part)
    except OptipathError:
        return False
    return isinstance(usual, CurveValue) and usual.curve == curve


SAMPLES, SUM, DIFFERENCE = "wavelengths", "sum", "difference"
FORMS = (NAMED, SAMPLES, *FORMULAS, CRYSTAL, SUM, DIFFERENCE)
"""The keys by which a table is known for one of these."""

WHEN = "wavelength"
"""The key, and the name of the parameter that is taken where it is left out."""

_OF_SAMPLES = ("unit", "interpolation", "extrapolate", "name")
_OF_NUMBER = ("part", "scale", "offset")
_TEXT_KEYS = (NAMED, CRYSTAL, "name", "unit", *_TEXTS)


def is_curve(raw: Mapping[str, Any]) -> bool:
    """Tell whether a table is one of what depends on the wavelength.

    >>> is_curve({"material": "gold"}), is_curve({"n": 1.5})
    (True, False)
    """
    return not raw.keys().isdisjoint(FORMS)


def decode_curve(
    raw: Mapping[str, Any], domain: Domain, parameters: Mapping[str, Parameter], decode: Decode
) -> Any:
    """Return what stands for a table of what depends on the wavelength."""
    form, *others = [key for key in FORMS if key in raw]
    if others:
        raise PresetError(f"'{form}' and '{others[0]}' say one thing twice; leave one of them out")
    if domain.tail:
        raise PresetError(
            f"'{form}' gives one number, but several are asked for that belong together; give "
            f"them for each wavelength, as a parameter"
        )
    of_index = isinstance(domain, (IndexDomain, OutsideDomain))
    if form in (SUM, DIFFERENCE):
        if of_index:
            raise PresetError(f"'{form}' gives one number; write {{ n = {{ {form} = ... }} }}")
        return _together(raw, form, domain, decode)
    whole = {key: raw[key] for key in raw if of_index or key not in _OF_NUMBER}
    result = _parts(whole, form, domain, of_index, parameters, decode)
    if not of_index:
        return _placed(_chosen(result, raw, domain), raw, domain, decode)
    if _has_own_k(raw, form):
        if "k" in result:
            raise PresetError(f"'{form}' gives k as well; leave k out")
        result["k"] = _at_key("k", decode, raw["k"], K)
    return Material(**result)


def _typed(*keys: str) -> dict[str, type]:
    """Return the types of some keys: a text, or anything."""
    return {key: str if key in _TEXT_KEYS else object for key in keys}


def _parts(
    raw: Mapping[str, Any],
    form: str,
    domain: Domain,
    of_index: bool,  # noqa: FBT001 - it goes no further
    parameters: Mapping[str, Parameter],
    decode: Decode,
) -> dict[str, Any]:
    """Return the numbers that a table gives, by the names of the parts of its curve."""
    columns = ("n", "k") if of_index or not raw.keys().isdisjoint(("n", "k")) else ("values",)
    own = {NAMED: OF_PAGES, SAMPLES: (*_OF_SAMPLES, *columns), CRYSTAL: ()}
    keys = own.get(form, (*COMMON_KEYS, "k") if of_index else COMMON_KEYS)
    needed = ("n",) if form == SAMPLES and of_index else ()
    checked_table(raw, _typed(form, *keys, WHEN), needed)
    when: Any = parameters.get(WHEN) or Wavelength()
    if WHEN in raw:
        when = _at_key(WHEN, decode, raw[WHEN], WAVELENGTH)
    if form == NAMED:
        return material_by_name(raw, when, decode)
    if form == CRYSTAL:
        return {CRYSTAL: number_of_crystal(raw[CRYSTAL], domain, when)}
    if of_index and form == SAMPLES and _has_own_k(raw, form):
        columns = ("n",)
    curve = (
        sampled_curve(raw, columns, domain) if form == SAMPLES else formula_of(raw, form, decode)
    )
    return _at(curve, when)


def _has_own_k(raw: Mapping[str, Any], form: str) -> bool:
    """Tell whether the k of a material stands beside a formula or samples, and is none of it."""
    sampled = form == SAMPLES and isinstance(raw.get("k"), list)
    return form in (SAMPLES, *FORMULAS) and "k" in raw and not sampled


def _at_key(key: str, decode: Decode, raw: Any, domain: Domain) -> Any:
    """Return the value of a key of a table, or raise with its place."""
    return each_key({key: raw}, lambda _, value: decode(value, domain))[key]


def _at(curve: Curve, when: Any) -> dict[str, Any]:
    if not isinstance(when, Parameter):
        WavelengthRange.of(curve).check(WHEN, when)
    return dict(zip(curve.parts, curve_values(curve, when), strict=True))


def _chosen(results: Mapping[str, Any], raw: Mapping[str, Any], domain: Domain) -> Any:
    """Return the number of a table where one is asked for: of n and k the k for a k, else n."""
    usual = "k" if domain is K and "k" in results else next(iter(results))
    part = raw.get("part", usual)
    if part not in results:
        raise PresetError(f"'part' is '{part}', but the table has {' and '.join(results)}")
    return results[part]


def _together(raw: Mapping[str, Any], form: str, domain: Domain, decode: Decode) -> Any:
    """Return a sum or a difference of numbers by wavelength."""
    checked_table(raw, (form, *_OF_NUMBER[1:]))
    terms = raw[form]
    if not isinstance(terms, list) or len(terms) < 2 or (form == DIFFERENCE and len(terms) > 2):
        many = "two tables" if form == DIFFERENCE else "two tables or more"
        raise PresetError(f"'{form}' must be a list of {many}, not {shown(terms)}")
    results = each_entry(terms, lambda term: decode(term, domain), f".{form}")
    return _placed(reduce(sub if form == DIFFERENCE else add, results), raw, domain, decode)


def _placed(value: Any, raw: Mapping[str, Any], domain: Domain, decode: Decode) -> Any:
    """Return a multiple of a value with an offset, where the table says so."""
    if "scale" in raw:
        value = _at_key("scale", decode, raw["scale"], Domain("scale")) * value
    if "offset" in raw:
        value = value + _at_key("offset", decode, raw["offset"], domain)
    return value


def material_table(material: Material, encode: Encode) -> dict[str, Any]:
    """Return the table of a material: of its curve, or of n and k apart."""
    n, k = material.n, material.k
    if isinstance(n, CurveValue) and _are_parts(n, k):
        return _table(n.curve, n.depends_on, "", encode)
    # A page with n or k alone, the other being given beside its name.
    for part, value in (("n", n), ("k", k)):
        if _is_plain(value) and isinstance(value.curve, PageCurve):
            curve = value.curve
            apart = _are_both_curves(n, k) and is_usual_part(curve, part)
            if curve.asked and curve.parts == (part,) and not apart:
                own = own_part(curve, n, k)
                named = _table(curve, value.depends_on, "", encode)
                return named | {key: encode(each, "") for key, each in own.items()}
    return {"n": encode(n, ""), "k": encode(k, "")}


def _are_parts(n: CurveValue, k: Any) -> bool:
    """Tell whether n and k are those of one curve, at the same wavelength."""
    if not _is_plain(n) or n.curve.parts[n.place] != "n":
        return False
    if not isinstance(k, CurveValue):
        of_page = isinstance(n.curve, PageCurve)
        return not of_page and "k" not in n.curve.parts and isinstance(k, (int, float)) and k == 0.0
    same = k.curve == n.curve and k.depends_on == n.depends_on and k.curve.parts[k.place] == "k"
    return same and _is_plain(k)


def _is_plain(value: Any) -> bool:
    """Tell whether a value follows from a curve, and is no multiple of what does."""
    return isinstance(value, CurveValue) and value.is_signed and not value.is_negative


def _are_both_curves(n: Any, k: Any) -> bool:
    return isinstance(n, CurveValue) and isinstance(k, CurveValue)


def number_table(value: CurveValue, unit: str, encode: Encode) -> dict[str, Any]:
    """Return the table of one number by wavelength, or of a multiple of it with an offset."""
    table = _table(value.curve, value.depends_on, unit, encode) | _part(value.curve, value.place)
    if value.scale != 1.0:
        table["scale"] = value.scale
    if value.offset:
        table["offset"] = encode(value.offset, unit)
    return table


def _part(curve: Curve, place: int) -> dict[str, str]:
    """Return the default part of a name's numbers, n or k, in words."""
    alone = len(curve.parts) == 1 and not isinstance(curve, PageCurve)
    return {} if alone else {"part": curve.parts[place]}


def _table(curve: Curve, depends_on: tuple[Any, ...], unit: str, encode: Encode) -> dict[str, Any]:
    if name := crystal_of(curve):
        return {CRYSTAL: name} | _wavelength(depends_on[0], encode)
    if isinstance(curve, CurveSum):
        return _sum(curve, depends_on, unit, encode)
    table: dict[str, Any] | None
    if isinstance(curve, Spectrum):
        table = spectrum_table(curve)
    elif isinstance(curve, Tabulated):
        table = _samples(curve, unit, encode)
    elif isinstance(curve, PageCurve):
        table = page_table(curve)
    else:
        table = formula_table(curve, encode)
    if table is None:
        raise PresetError(f"{curve.label} has no form in a preset file; give samples of it")
    return table | _wavelength(depends_on[0], encode)


def _samples(curve: Tabulated, unit: str, encode: Encode) -> dict[str, Any]:
    table = written_wavelengths(curve.wavelengths)
    for part, column in zip(curve.parts, curve.columns, strict=True):
        key, of = ("values", unit) if part == "value" else (part, "")
        table[key] = encode(np.asarray(column), of)
    if curve.interpolation != "linear":
        table["interpolation"] = curve.interpolation
    if curve.extrapolate:
        table["extrapolate"] = curve.extrapolate
    return table | {"name": curve.label}


def _sum(curve: CurveSum, depends_on: tuple[Any, ...], unit: str, encode: Encode) -> dict[str, Any]:
    """Return the table of a sum; what is added stands with its first term."""
    when, *left = depends_on
    terms = []
    for factor, one, place in curve.terms:
        count = len(one.arguments())
        own, left = (when, *left[:count]), left[count:]
        table = _table(one, own, unit, encode) | _part(one, place)
        terms.append(table | ({"scale": factor} if factor != 1.0 else {}))
    if curve.constant:
        terms[0]["offset"] = encode(curve.constant, unit)
    return {SUM: terms}


def _wavelength(argument: Any, encode: Encode) -> dict[str, Any]:
    """Return the key of a wavelength; none for the parameter of that name."""
    usual = isinstance(argument, Parameter) and argument.name == WHEN and argument.quantity == WHEN
    return {} if usual else {WHEN: encode(argument, WAVELENGTH.unit)}
