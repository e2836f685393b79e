"""Texts that refer to a parameter: ``"$name"`` and ``"-$name"``, and what is meant for one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, PresetError, did_you_mean
from optipath.paths.format.formula_texts import is_arithmetic, table_for

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.domains.domain import Domain
    from optipath.values.parameters import Parameter


def named(raw: str, domain: Domain) -> Any:
    """Return what a word stands for that is the name of a parameter, too."""
    try:
        return domain.parse(raw)
    except OptipathError:
        raise PresetError(
            f"'{raw}' is no number; write \"${raw.strip()}\" for the parameter"
        ) from None


def referred(raw: str, parameters: Mapping[str, Parameter]) -> Parameter:
    """Return the parameter that ``"$name"`` or ``"-$name"`` stands for."""
    sign, _, name = raw.partition("$")
    if sign in ("", "-") and name in parameters:
        return -parameters[name] if sign else parameters[name]
    if raw.count("$") > 1:
        raise PresetError(
            f"'{raw}' is of several parameters, but a value takes one; declare a parameter for "
            f"the whole"
        )
    if is_arithmetic(raw):
        raise PresetError(f"'{raw}' is no name of a parameter; write {table_for(raw)}")
    known = [f"${parameter}" for parameter in parameters]
    raise PresetError(f"parameter '{raw}' is not declared{did_you_mean(raw, known)}")


def references_in(raw: Any) -> set[str]:
    """Return the names of the parameters that a part of a document refers to.

    Examples
    --------
    >>> mirror = {"index": {"n": "$n1", "k": 0.1}, "azimuth": {"parameter": "rho", "scale": -2}}
    >>> sorted(references_in([mirror, "-$phi"]))
    ['n1', 'phi', 'rho']
    """
    found, left = set(), [raw]
    while left:
        entry = left.pop()
        if isinstance(entry, str):
            sign, dollar, name = entry.partition("$")
            if dollar and sign in ("", "-"):
                found.add(name)
        elif isinstance(entry, dict):
            left += entry.values()
            multiple = entry.get("parameter")
            if isinstance(multiple, str):
                found.add(multiple)
        elif isinstance(entry, list):
            left += entry
    return found


def wavelength_names(raw: Any) -> set[str]:
    """Return the names of the parameters that stand as a wavelength in a part of a document.

    That which is called ``wavelength`` is one of them, since materials take it by themselves.

    Examples
    --------
    >>> sorted(wavelength_names([{"wavelength": "$lam"}, {"thickness": "$d"}]))
    ['lam', 'wavelength']
    """
    found, left = {"wavelength"}, [raw]
    while left:
        entry = left.pop()
        if isinstance(entry, dict):
            found |= references_in(entry["wavelength"]) if "wavelength" in entry else set()
            left += entry.values()
        elif isinstance(entry, list):
            left += entry
    return found
