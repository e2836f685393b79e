"""Tables of what depends on the wavelength: a material where an index stands, or one number."""

from __future__ import annotations

from functools import reduce
from inspect import Parameter as Argument
from inspect import signature
from operator import add, sub
from typing import TYPE_CHECKING, Any

from optipath.errors import PresetError, shown
from optipath.paths.format.faults import Faults, unknown_keys
from optipath.paths.format.samples import samples_of, wavelengths_of
from optipath.paths.format.schema import as_meant
from optipath.values.curves.curve_value import curve_values
from optipath.values.curves.tabulated import Tabulated
from optipath.values.domains.domain import Domain
from optipath.values.domains.indices import IndexDomain, OutsideDomain
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.materials import Material
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.values.parameters import Parameter

    Decode = Callable[[Any, Domain], Any]

NAMED, SAMPLES, SUM, DIFFERENCE = "material", "wavelengths", "sum", "difference"
FORMULAS = ("sellmeier", "cauchy", "drude_lorentz", "tauc_lorentz")
"""The formulas that give a material, by the names of the constructors of `Material`."""

FORMS = (NAMED, SAMPLES, *FORMULAS, SUM, DIFFERENCE)
"""The keys by which a table is known for one of these."""

OF_SAMPLES = ("unit", "interpolation", "extrapolate", "name")
OF_NUMBER = ("part", "scale", "offset")
WHEN = "wavelength"
"""The key, and the name of the parameter that is taken where it is left out."""


def is_curve(raw: Any) -> bool:
    """Tell whether a value is a table of what depends on the wavelength.

    Examples
    --------
    >>> is_curve({"material": "gold"}), is_curve({"n": 1.5}), is_curve("gold")
    (True, False, False)
    """
    return isinstance(raw, dict) and not raw.keys().isdisjoint(FORMS)


def decode_curve(
    raw: Mapping[str, Any], domain: Domain, parameters: Mapping[str, Parameter], decode: Decode
) -> Any:
    """Return what stands for a table of what depends on the wavelength.

    Parameters
    ----------
    raw : mapping
        What stands in the file.
    domain : Domain
        What the field may be.
    parameters : mapping of str to Parameter
        What is declared.
    decode : callable
        Returns the value of one entry, which may be a parameter.

    Returns
    -------
    Material, Parameter or float
        A material where an index stands; elsewhere one number, known or not.

    Raises
    ------
    PresetError
        With all faults of the table.
    """
    forms = [key for key in FORMS if key in raw]
    if len(forms) > 1:
        one, other = forms[:2]
        raise PresetError(f"'{one}' and '{other}' are two ways to say one thing; leave one out")
    of_index = isinstance(domain, (IndexDomain, OutsideDomain))
    if "name" in raw and not isinstance(raw["name"], str):
        raise PresetError(f"'name' must be a text, not {shown(raw['name'])}")
    if forms[0] in (SUM, DIFFERENCE):
        if of_index:
            one = f"{{ n = {{ {forms[0]} = ... }} }}"
            raise PresetError(f"'{forms[0]}' is of one number; give it for n, as {one}")
        return _several(raw, forms[0], domain, decode)
    if not of_index:
        return _number(raw, forms[0], domain, parameters, decode)
    return _material(raw, forms[0], parameters, decode)


def _material(
    raw: Mapping[str, Any], form: str, parameters: Mapping[str, Parameter], decode: Decode
) -> Material:
    """Return a material, made by the constructor that has the name of the form."""
    if form == SAMPLES:
        keys = (SAMPLES, *OF_SAMPLES, "n", "k", WHEN)
        raw, found = _known(raw, keys, "n")
        columns = {
            key: found.attempt(f".{key}", samples_of, raw[key], "")
            for key in ("n", "k")
            if key in raw
        }
        axis = found.attempt(f".{SAMPLES}", wavelengths_of, raw[SAMPLES], raw.get("unit"))
        kept = {key: raw[key] for key in OF_SAMPLES[1:] if key in raw}
        return _made("tabulated", (axis,), columns | kept, raw, found, parameters, decode)
    made = _constructor("named" if form == NAMED else form)
    arguments = [
        a for a in signature(made).parameters.values() if a.kind is not Argument.VAR_KEYWORD
    ]
    apart = [a.name for a in arguments if a.kind is Argument.KEYWORD_ONLY and a.name != WHEN]
    own = [a for a in arguments if a.name not in (*apart, WHEN)]
    if form == NAMED:
        raw, found = _known(raw, (form, *apart, WHEN))
        if not isinstance(raw[form], str):
            found.append(f"'{form}' must be a name, such as \"gold\", not {shown(raw[form])}")
        given = _options(raw, apart, found, decode)
        return _made("named", (raw[form],), given, raw, found, parameters, decode)
    raw, found = _known(raw, (form, *apart, WHEN))
    inner = _coefficients(raw[form], form, own, found, decode)
    given = _options(raw, apart, found, decode)
    return _made(form, (), inner | given, raw, found, parameters, decode)


def _options(
    raw: Mapping[str, Any], names: list[str], found: Faults, decode: Decode
) -> dict[str, Any]:
    """Return what else a material is made by: numbers for n and k, and texts."""
    for key in names:
        if key in raw and key not in ("n", "k") and not isinstance(raw[key], str):
            found.append(f"'{key}' must be a text, not {shown(raw[key])}")
    return {
        key: found.attempt(f".{key}", decode, raw[key], Domain("number"))
        if key in ("n", "k")
        else raw[key]
        for key in names
        if key in raw
    }


def _coefficients(
    raw: Any, form: str, own: list[Argument], found: Faults, decode: Decode
) -> dict[str, Any]:
    """Return the coefficients of a formula, each a number, a parameter, or a list of these."""
    names = [argument.name for argument in own]
    if not isinstance(raw, dict):
        found.append(
            f"'{form}' must be a table of its coefficients ({', '.join(names)}), not {shown(raw)}"
        )
        return {}
    found += [f"{form}: {fault}" for fault in unknown_keys(raw, names)]
    raw = as_meant(raw, names)
    found += [
        f"{form}: '{a.name}' is missing"
        for a in own
        if a.default is Argument.empty and a.name not in raw
    ]
    return {
        key: found.attempt(f".{form}.{key}", _nested, value, decode) for key, value in raw.items()
    }


def _nested(raw: Any, decode: Decode) -> Any:
    if not isinstance(raw, list):
        return decode(raw, Domain("coefficient"))
    faults = Faults()
    found = [faults.attempt(f"[{i}]", _nested, entry, decode) for i, entry in enumerate(raw)]
    if faults:
        raise PresetError(*faults)
    return found


def _number(
    raw: Mapping[str, Any],
    form: str,
    domain: Domain,
    parameters: Mapping[str, Parameter],
    decode: Decode,
) -> Any:
    """Return one number by wavelength: samples of its own, or a part of a material."""
    whole = {key: value for key, value in raw.items() if key not in OF_NUMBER}
    faults = Faults()
    if form == SAMPLES and "n" not in raw:
        value = faults.attempt("", _sampled, whole, domain, parameters, decode)
    else:
        part = raw.get("part", "n")
        if part not in ("n", "k"):
            raise PresetError(f'\'part\' must be "n" or "k", not {shown(part)}')
        material = faults.attempt("", _material, whole, form, parameters, decode)
        value = getattr(material, part, None)
    return _placed(value, raw, domain, faults, decode)


def _sampled(
    raw: Mapping[str, Any], domain: Domain, parameters: Mapping[str, Parameter], decode: Decode
) -> Any:
    """Return one number by wavelength out of samples of it."""
    column = next((key for key in ("n", "k") if key in raw), "values")
    raw, found = _known(raw, (SAMPLES, *OF_SAMPLES, column, WHEN), column)
    axis = found.attempt(f".{SAMPLES}", wavelengths_of, raw[SAMPLES], raw.get("unit"))
    unit = domain.unit if column == "values" else ""
    values = found.attempt(f".{column}", samples_of, raw.get(column), unit)
    when = found.attempt(f".{WHEN}", _when, raw, parameters, decode)
    if found:
        raise PresetError(*found)
    kept = {key: raw[key] for key in ("interpolation", "extrapolate") if key in raw}
    curve = Tabulated(
        raw.get("name", f"{domain.name} by wavelength"), ("value",), axis, [values], **kept
    )
    return curve_values(curve, when)[0]


def _several(raw: Mapping[str, Any], form: str, domain: Domain, decode: Decode) -> Any:
    """Return a sum or a difference of numbers by wavelength."""
    raw, faults = _known(raw, (form, *OF_NUMBER[1:]))
    terms = raw[form]
    if not isinstance(terms, list) or len(terms) < 2 or (form == DIFFERENCE and len(terms) > 2):
        many = "two" if form == DIFFERENCE else "two or more"
        raise PresetError(f"'{form}' must be a list of {many} tables, not {shown(terms)}")
    found = [faults.attempt(f".{form}[{i}]", decode, term, domain) for i, term in enumerate(terms)]
    value = None if faults else reduce(sub if form == DIFFERENCE else add, found)
    return _placed(value, raw, domain, faults, decode)


def _placed(
    value: Any, raw: Mapping[str, Any], domain: Domain, faults: Faults, decode: Decode
) -> Any:
    """Return a multiple of a value with an offset, where the table says so."""
    scale, offset = (
        faults.attempt(f".{key}", decode, raw.get(key, usual), of)
        for key, usual, of in (
            ("scale", 1.0, Domain("scale")),
            ("offset", 0.0, domain if "offset" in raw else Domain("offset")),
        )
    )
    if faults:
        raise PresetError(*faults)
    if scale != 1.0:
        value = scale * value
    return value + offset if offset else value


def _known(
    raw: Mapping[str, Any], keys: tuple[str, ...], needed: str = ""
) -> tuple[dict[str, Any], Faults]:
    """Return a table with its keys as they were meant, and what is wrong with them."""
    faults = unknown_keys(raw, keys)
    raw = as_meant(raw, keys)
    if needed and needed not in raw:
        faults.append(f"a table of {SAMPLES} needs '{needed}', a list with a number for each")
    return raw, faults


def _constructor(name: str) -> Callable[..., Material]:
    made: Callable[..., Material] = getattr(Material, name)
    return made


def _made(
    name: str,
    arguments: tuple[Any, ...],
    keywords: Mapping[str, Any],
    raw: Mapping[str, Any],
    faults: Faults,
    parameters: Mapping[str, Parameter],
    decode: Decode,
) -> Material:
    """Return a material by a constructor, unless faults have been found already."""
    when = faults.attempt(f".{WHEN}", _when, raw, parameters, decode)
    if faults:
        raise PresetError(*faults)
    try:
        return _constructor(name)(*arguments, **keywords, wavelength=when)
    except TypeError as error:
        raise PresetError(f"this table makes no material: {error}") from None


def _when(raw: Mapping[str, Any], parameters: Mapping[str, Parameter], decode: Decode) -> Any:
    """Return the wavelength of a table; by default the parameter of that name."""
    if WHEN in raw:
        return decode(raw[WHEN], WAVELENGTH)
    return parameters.get(WHEN) or Wavelength()
