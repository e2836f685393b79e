"""Writing what depends on the wavelength as the tables that `curve_tables` reads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import PresetError
from optipath.materials.spectrum import Spectrum
from optipath.materials.tables import PageCurve, Tabulated
from optipath.paths.files.curve_tables import (
    CRYSTAL,
    SUM,
    WHEN,
    crystal_of,
    formula_table,
    is_usual_part,
    own_part,
    page_table,
)
from optipath.paths.files.spectrum_tables import spectrum_table, written_wavelengths
from optipath.values.curve import CurveSum
from optipath.values.curve_value import CurveValue
from optipath.values.parameters import Parameter
from optipath.values.wavelength import WAVELENGTH

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.materials.material import Material
    from optipath.values.curve import Curve

    Encode = Callable[[Any, str], Any]


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
    """Return which of several numbers is meant, in words: where k stands, it is another by default.

    A name gives n and k, whatever its page has.
    """
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
