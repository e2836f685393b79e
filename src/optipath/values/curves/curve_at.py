"""What stands for a curve at a wavelength that somebody gives, or that a run will."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.values.curves.curve_value import CurveValue, curve_values
from optipath.values.curves.wavelength_range import WavelengthRange
from optipath.values.domains.domain import in_unit_of
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.parameters import Parameter
from optipath.values.wavelength import Wavelength, read_within

if TYPE_CHECKING:
    from optipath.values.curves.curve import Curve


def curve_at(curve: Curve, wavelength: Any = None) -> tuple[Any, ...]:
    """Return what stands for each part of a curve.

    Examples
    --------
    >>> from optipath.values.curves.tabulated import Tabulated
    >>> table = Tabulated("gold", ("n",), ["500 nm", "600 nm"], [[0.9, 0.3]])
    >>> curve_at(table, "500 nm"), curve_at(table)
    ((0.9,), (<n of gold, by wavelength>,))
    """
    if wavelength is None or isinstance(wavelength, Parameter):
        return curve_values(curve, in_unit_of(wavelength or Wavelength(), WAVELENGTH))
    there = read_within(curve.span, wavelength)
    WavelengthRange.of(curve).check("the wavelength", there)
    values = curve_values(curve, there)
    if isinstance(values[0], CurveValue):
        return values  # Its coefficients are given later.
    return tuple([one.at(there) for one in curve_values(curve, Wavelength())])
