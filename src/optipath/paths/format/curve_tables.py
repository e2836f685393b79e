"""Tables of what depends on the wavelength: a material where an index stands, or one number."""

from __future__ import annotations

from functools import reduce
from operator import add, sub
from typing import TYPE_CHECKING, Any

from optipath.errors import PresetError, shown
from optipath.paths.format.crystal_tables import CRYSTAL, number_of_crystal
from optipath.paths.format.faults import Faults, unknown_keys
from optipath.paths.format.formula_tables import BESIDE, FORMULAS, formula_of
from optipath.paths.format.page_tables import NAMED, OF_PAGES, material_by_name
from optipath.paths.format.samples import sampled_curve
from optipath.paths.format.schema import as_meant
from optipath.values.curves.curve_value import curve_values
from optipath.values.curves.wavelength_range import WavelengthRange
from optipath.values.domains.domain import Domain
from optipath.values.domains.indices import IndexDomain, OutsideDomain
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.materials import K, Material
from optipath.values.parameters import Parameter
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.values.curves.curve import Curve

    Decode = Callable[[Any, Domain], Any]

SAMPLES, SUM, DIFFERENCE = "wavelengths", "sum", "difference"
FORMS = (NAMED, SAMPLES, *FORMULAS, CRYSTAL, SUM, DIFFERENCE)
"""The keys by which a table is known for one of these."""

WHEN = "wavelength"
"""The key, and the name of the parameter that is taken where it is left out."""

_OF_SAMPLES = ("unit", "interpolation", "extrapolate", "name")
_OF_NUMBER = ("part", "scale", "offset")


def is_curve(raw: Mapping[str, Any]) -> bool:
    """Tell whether a table is one of what depends on the wavelength.

    Examples
    --------
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
    for key in ("name", "unit", "interpolation", "extrapolate", "page", "part", NAMED, CRYSTAL):
        if key in raw and not isinstance(raw[key], str):
            raise PresetError(f"'{key}' must be a text, not {shown(raw[key])}")
    if domain.tail:
        raise PresetError(
            f"'{form}' gives one number, but several are asked for that belong together; give "
            f"them for each wavelength, as a parameter"
        )
    of_index = isinstance(domain, (IndexDomain, OutsideDomain))
    if form in (SUM, DIFFERENCE) and not of_index:
        return _together(raw, form, domain, decode)
    if form in (SUM, DIFFERENCE):
        one = f"{{ n = {{ {form} = ... }} }}"
        raise PresetError(f"'{form}' gives one number; write it for n, as {one}")
    whole = {key: raw[key] for key in raw if of_index or key not in _OF_NUMBER}
    found = _parts(whole, form, domain, of_index, parameters, decode)
    if of_index and _has_k_beside(raw, form):
        return _with_k(found, raw, form, decode)
    if of_index:
        return Material(**found)
    return _placed(_chosen(found, raw, domain), raw, domain, decode)


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
    keys = own.get(form, (*BESIDE, "k") if of_index else BESIDE)
    faults = unknown_keys(raw, (form, *keys, WHEN))
    raw = as_meant(raw, (form, *keys, WHEN))
    if form == SAMPLES and columns == ("n", "k") and of_index and "n" not in raw:
        faults.append(f"a table of {SAMPLES} needs 'n', a list with a number for each")
    if WHEN in raw:
        when = faults.attempt(f".{WHEN}", decode, raw[WHEN], WAVELENGTH)
    else:
        when = parameters.get(WHEN) or Wavelength()
    if faults:
        raise PresetError(*faults)
    if form == NAMED:
        return material_by_name(raw, when, decode)
    if form == CRYSTAL:
        return {CRYSTAL: number_of_crystal(raw[CRYSTAL], domain, when)}
    if of_index and form == SAMPLES and _has_k_beside(raw, form):
        columns = ("n",)
    curve = (
        sampled_curve(raw, columns, domain) if form == SAMPLES else formula_of(raw, form, decode)
    )
    return _at(curve, when)


def _has_k_beside(raw: Mapping[str, Any], form: str) -> bool:
    """Tell whether the k of a material stands beside a formula or samples, and is none of it."""
    sampled = form == SAMPLES and isinstance(raw.get("k"), list)
    return form in (SAMPLES, *FORMULAS) and "k" in raw and not sampled


def _with_k(
    found: Mapping[str, Any], raw: Mapping[str, Any], form: str, decode: Decode
) -> Material:
    """Return the material of a formula or of samples of n, with the k that stands beside it."""
    if "k" in found:
        raise PresetError(f"'{form}' gives k as well; leave k out")
    faults = Faults()
    k = faults.attempt(".k", decode, raw["k"], K)
    if faults:
        raise PresetError(*faults)
    return Material(found["n"], k)


def _at(curve: Curve, when: Any) -> dict[str, Any]:
    if not isinstance(when, Parameter):
        WavelengthRange.of(curve).check(WHEN, when)
    return dict(zip(curve.parts, curve_values(curve, when), strict=True))


def _chosen(found: Mapping[str, Any], raw: Mapping[str, Any], domain: Domain) -> Any:
    """Return the number of a table where one is asked for: of n and k the k for a k, else n."""
    usual = "k" if domain is K and "k" in found else next(iter(found))
    part = raw.get("part", usual)
    if part not in found:
        raise PresetError(f"'part' is '{part}', but the table has {' and '.join(found)}")
    return found[part]


def _together(raw: Mapping[str, Any], form: str, domain: Domain, decode: Decode) -> Any:
    """Return a sum or a difference of numbers by wavelength."""
    faults = unknown_keys(raw, (form, *_OF_NUMBER[1:]))
    terms = raw[form]
    if not isinstance(terms, list) or len(terms) < 2 or (form == DIFFERENCE and len(terms) > 2):
        many = "two tables" if form == DIFFERENCE else "two tables or more"
        faults.append(f"'{form}' must be a list of {many}, not {shown(terms)}")
        raise PresetError(*faults)
    found = [faults.attempt(f".{form}[{i}]", decode, term, domain) for i, term in enumerate(terms)]
    if faults:
        raise PresetError(*faults)
    return _placed(reduce(sub if form == DIFFERENCE else add, found), raw, domain, decode)


def _placed(value: Any, raw: Mapping[str, Any], domain: Domain, decode: Decode) -> Any:
    """Return a multiple of a value with an offset, where the table says so."""
    faults = Faults()
    if "scale" in raw:
        scale = faults.attempt(".scale", decode, raw["scale"], Domain("scale"))
        value = value if scale is None else scale * value
    if "offset" in raw:
        offset = faults.attempt(".offset", decode, raw["offset"], domain)
        value = value if offset is None else value + offset
    if faults:
        raise PresetError(*faults)
    return value
