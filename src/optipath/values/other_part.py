"""The other part of a complex index, where the two are parameters or numbers of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import UnitError
from optipath.values.curves.curve_value import CurveValue
from optipath.values.materials import Material
from optipath.values.open_materials import waits_for
from optipath.values.parameters import Parameter
from optipath.values.units import parse_quantity

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from optipath.values.use import Use

_OTHER = {"n": "k", "k": "n"}


def other_part(uses: Iterable[Use], name: str, how: Callable[[str], str] = str) -> str:
    """Say how the other part of a complex index is given; nothing where there is none."""
    values = {use.owner: use.value for use in uses}
    for owner, value in values.items():
        place, _, part = owner.rpartition(".")
        if isinstance(value, Parameter) and value.name == name and part in _OTHER:
            other = _OTHER[part]
            found = values.get(f"{place}.{other}")
            if isinstance(found, CurveValue):
                return f"{other} is that of {found.curve.label}; give {part} alone, a real number"
            if isinstance(found, Parameter):
                return f"give {other} by {how(found.name)}"
            if isinstance(found, (int, float)):
                return f"{other} is {found:g} where the path is built; make it a parameter there"
    return ""


def places_of(uses: Iterable[Use], name: str) -> list[Use]:
    """Return where a parameter stands."""
    return [u for u in uses if isinstance(u.value, Parameter) and u.value.name == name]


def extinctions_beside(uses: Iterable[Use], name: str) -> dict[str, Any]:
    """Return what k is wherever a parameter stands as the n of an index."""
    values = {use.owner: use.value for use in uses}
    found: dict[str, Any] = {}
    for owner, value in values.items():
        place, _, part = owner.rpartition(".")
        if isinstance(value, Parameter) and value.name == name and part == "n":
            k = f"{place}.k"
            found |= {k: values[k]} if k in values else {}
    return found


def of_complex(faults: Iterable[str], uses: Iterable[Use], name: str, value: Any) -> list[str]:
    """Return sentences on a value; those on a complex one with how its other part is given."""
    cure = other_part(uses, name) if _is_complex(value) else ""
    return [f"{fault}; {cure}" if cure else fault for fault in faults]


def _is_complex(value: Any) -> bool:
    if isinstance(value, Material):
        return not waits_for(value) and not (isinstance(value.k, (int, float)) and value.k == 0.0)
    if isinstance(value, str):
        try:
            value = parse_quantity(value, "")
        except UnitError:
            return False
    several = isinstance(value, np.ndarray) and value.dtype.kind == "c"
    return several or isinstance(value, (complex, np.complexfloating))
