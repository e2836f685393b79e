"""Materials and curves that are not known before the path runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import listed
from optipath.values.curves.computed_values import parameters_among
from optipath.values.curves.curve import Curve
from optipath.values.curves.curve_value import CurveValue, curve_values
from optipath.values.materials import Material
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Sequence


def is_curve(given: Any) -> bool:
    """Return whether something is one curve, or what it comes to at a wavelength."""
    return isinstance(given, CurveValue) or (isinstance(given, Curve) and len(given.parts) == 1)


def is_by_wavelength(given: Any) -> bool:
    """Return whether something is put in place of a parameter: a material, or one curve.

    Examples
    --------
    >>> is_by_wavelength(Material(1.5)), is_by_wavelength(1.5)
    (True, False)
    """
    return isinstance(given, Material) or is_curve(given)


def waits_for(given: Any) -> Sequence[str]:
    """Return the names of the parameters that a material or curve depends on; else none.

    Examples
    --------
    >>> from optipath.values.parameters import Parameter
    >>> waits_for(Material(1.5, Parameter("k"))), waits_for(Material(1.5))
    (['k'], [])
    """
    if not is_by_wavelength(given):
        return []
    if isinstance(given, Curve):
        given = curve_values(given, Wavelength())[0]
    found = parameters_among([given.n, given.k] if isinstance(given, Material) else [given])
    return [*dict.fromkeys(p.name for p in found if not isinstance(p, CurveValue))]


def given_too_late(name: str, given: Any) -> str:
    """Return the fault of a material or curve that is given while a path runs; mostly none."""
    if not (names := waits_for(given)):
        return ""
    return (
        f"parameter '{name}' depends on {listed(names)}, and is put in place "
        f"before a path runs; write path.bind({name}=...), or load_preset(..., {name}=...)"
    )
