"""Reading the declaration of a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.paths.format import schema
from optipath.paths.format.codec import decode, decode_given
from optipath.values.domains.domain import Domain
from optipath.values.parameters import Parameter
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    from optipath.paths.format.faults import Faults


def read_parameter(name: str, table: dict[str, Any], faults: Faults) -> Parameter:
    """Return the parameter that a table declares; a bare one where the table is faulty.

    Parameters
    ----------
    name : str
        What it is called.
    table : dict
        What stands in the file.
    faults : Faults
        Takes what is wrong.

    Returns
    -------
    Parameter
        By its name, or "unknown" where that is none.
    """
    where = f"parameters.{name}"
    bare = faults.attempt(where, Parameter, name) or Parameter("unknown")
    before = len(faults)
    faults += schema.type_faults(where, table, schema.PARAMETER)
    unit = table.get("unit", "")
    dimension = faults.attempt(where, dimension_of, unit) if isinstance(unit, str) else None
    if dimension is None or len(faults) > before:
        return bare
    domain = Domain("value", dimension, own_unit=unit)
    low, high = _range(where, table, domain, faults)
    words = {
        word: faults.attempt(f"{where}.words.{word}", decode, raw, domain, {})
        for word, raw in table.get("words", {}).items()
    }
    keys: dict[str, Any] = {k: table[k] for k in ("help", "optional", "bound") if k in table}
    keys |= {"unit": unit, "minimum": low, "maximum": high, "words": words}
    default = None
    if "default" in table and len(faults) == before:
        open_one = Parameter(name, **{**keys, "bound": False})
        at = f"{where}.default"
        default = faults.attempt(at, decode_given, table["default"], open_one)
    if len(faults) > before:
        if not unit and any(f.startswith(where) and "has the unit" in f for f in faults):
            faults.append(f'{where} declares no unit; if its values have one, add unit = "..."')
        return bare
    return faults.attempt(where, Parameter, name, default, **keys) or bare


def _range(where: str, table: dict[str, Any], domain: Domain, faults: Faults) -> tuple[Any, Any]:
    limits = table.get("range", [-np.inf, np.inf])
    if len(limits) != 2:
        faults.append(f"{where}: 'range' must have two ends, not {len(limits)}")
        return None, None
    low, high = (faults.attempt(f"{where}.range", decode, end, domain, {}) for end in limits)
    if isinstance(low, list) or isinstance(high, list):
        faults.append(f"{where}: the ends of 'range' must be single values")
    return low, high
