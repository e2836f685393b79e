"""What stands below the symbols of a bench: names, and the values that say most."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.elements.boundary_frames import BoundaryElement
from optipath.elements.medium import Medium
from optipath.plots.space.chain_angles import angles_in_chain
from optipath.plots.space.posture import angles_at, has_axis
from optipath.plots.space.told_values import number, quantity_text, told_incidence
from optipath.values.operands import Operand
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from optipath.elements.element import Element

_FIELDS = (
    "angle",
    "retardance",
    "incidence",
    "reflectance",
    "thickness",
    "length",
    "verdet",
    "field",
    "dichroic_angle",
    "azimuth",
)
"""What is told of an element, in this order."""

_ALWAYS = "angle", "incidence"


def values_below(element: Element) -> list[str]:
    """Return the values of an element that are written below its symbol.

    Examples
    --------
    >>> import optipath as op
    >>> values_below(op.Retarder(retardance="90 deg", angle=op.Parameter("a", 0.0, bound=True)))
    ['a = 0 deg', 'retardance 90 deg']
    """
    domains, found = element.domains(), []
    for name in _FIELDS:
        value: Any = getattr(element, name, None)
        if name not in domains or not isinstance(value, Parameter | float | int):
            continue
        if name == "angle" and isinstance(element, Medium) and not has_axis(element):
            continue
        if isinstance(value, Parameter) or value != 0.0 or name in _ALWAYS:
            found.append(_text(element, name, value, domains[name].unit))
    incidence, turn = angles_in_chain(element)
    if incidence is not None:
        found.append(told_incidence(incidence, number(incidence)).text)
    if isinstance(turn, Parameter | float | int) and (isinstance(turn, Parameter) or turn != 0.0):
        found.append(_text(element, "azimuth", turn, "deg"))
    return found


def _text(element: Element, name: str, value: Any, unit: str) -> str:
    if name == "incidence" and isinstance(element, BoundaryElement):
        return told_incidence(value, angles_at(element)[0]).text
    if not isinstance(value, Parameter):
        said = quantity_text(number(value), unit)
        return said if name == "angle" else f"{name} {said}"
    if not bool(Operand(value, "present").numbers()):
        return f"{value.name} = none"
    said = f"{value.formula} = {quantity_text(number(value), value.unit or unit)}"
    return f"azimuth {said}" if name == "azimuth" else said
