"""Formulas of n and k in preset files: ``{ sellmeier = { b = [...], c = [...] } }``."""

from __future__ import annotations

from inspect import Parameter as Argument
from inspect import signature
from typing import TYPE_CHECKING, Any

from optipath.errors import PresetError, shown
from optipath.paths.format.faults import Faults, unknown_keys
from optipath.paths.format.schema import as_meant
from optipath.values.curves.coefficients import REAL
from optipath.values.curves.formula_curve import EVERYWHERE
from optipath.values.curves.oscillator_curve import DrudeLorentz, TaucLorentz
from optipath.values.curves.sellmeier_curve import Cauchy, Sellmeier
from optipath.values.domains.wavelengths import WAVELENGTH

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.values.curves.curve import Curve
    from optipath.values.curves.formula_curve import FormulaCurve
    from optipath.values.domains.domain import Domain

    Decode = Callable[[Any, Domain], Any]
    Encode = Callable[[Any, str], Any]

FORMULAS: dict[str, type[FormulaCurve]] = {
    "sellmeier": Sellmeier,
    "cauchy": Cauchy,
    "drude_lorentz": DrudeLorentz,
    "tauc_lorentz": TaucLorentz,
}
"""The formulas by the keys under which their coefficients stand."""

BESIDE = ("name", "span")
"""The keys that stand beside that of the formula."""


def formula_of(raw: Mapping[str, Any], form: str, decode: Decode) -> Curve:
    """Return the curve of a table with a formula."""
    known = _coefficients_of(form)
    table = raw[form]
    if not isinstance(table, dict):
        raise PresetError(
            f"'{form}' must be a table of its coefficients ({', '.join(known)}), not {shown(table)}"
        )
    faults = Faults(f".{form}: {fault}" for fault in unknown_keys(table, [*known]))
    table = as_meant(table, known)
    faults += [
        f".{form}: '{name}' is missing"
        for name, usual in known.items()
        if usual is Argument.empty and name not in table
    ]
    given = {
        name: faults.attempt(f".{form}.{name}", _nested, value, decode)
        for name, value in table.items()
    }
    if "span" in raw:
        given["span"] = faults.attempt(".span", _span, raw["span"], decode)
    if faults:
        raise PresetError(*faults)
    return FORMULAS[form](raw.get("name", f"the formula '{form}'"), **given)


def formula_table(curve: Curve, encode: Encode) -> dict[str, Any] | None:
    """Return the table of a formula; None for another curve."""
    form = next((form for form, of in FORMULAS.items() if type(curve) is of), None)
    if form is None:
        return None
    given = {name: getattr(curve, name) for name in _coefficients_of(form)}
    table = {name: encode(value, "") for name, value in given.items() if value is not None}
    found: dict[str, Any] = {form: table, "name": curve.label}
    if curve.span != EVERYWHERE:
        found["span"] = [encode(end, WAVELENGTH.unit) for end in curve.span]
    return found


def _coefficients_of(form: str) -> dict[str, Any]:
    """Return the names of the coefficients of a formula, with what they are by default."""
    arguments = signature(FORMULAS[form]).parameters.values()
    return {a.name: a.default for a in arguments if a.name not in ("label", "span")}


def _nested(raw: Any, decode: Decode) -> Any:
    """Return a coefficient, or a list of such, or of lists of them."""
    if not isinstance(raw, list):
        return decode(raw, REAL)
    faults = Faults()
    found = [faults.attempt(f"[{i}]", _nested, entry, decode) for i, entry in enumerate(raw)]
    if faults:
        raise PresetError(*faults)
    return found


def _span(raw: Any, decode: Decode) -> tuple[Any, ...]:
    if not isinstance(raw, list):
        raise PresetError(f'must be two wavelengths, ["400 nm", "700 nm"], not {shown(raw)}')
    faults = Faults()
    ends = [faults.attempt(f"[{i}]", decode, end, WAVELENGTH) for i, end in enumerate(raw)]
    if faults:
        raise PresetError(*faults)
    return tuple(ends)
