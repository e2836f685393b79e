"""CurveMaterial: a material whose n and k are those of a curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from optipath.values.curves.curve_value import CurveValue, curve_values
from optipath.values.curves.wavelength_range import WavelengthRange
from optipath.values.domains.domain import in_unit_of
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.parameters import Parameter
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from optipath.values.curves.curve import Curve


class CurveMaterial:
    """What a `Material` is made of besides two numbers: a curve, and a wavelength.

    The wavelength is by default the parameter of that name, which is given when a path is traced;
    or another `Parameter`; or a number in metres or a text such as ``"516 nm"``, of which a
    constant material is made.

    Parameters
    ----------
    n, k : float, array_like or Parameter
        The two numbers.
    """

    def __init__(self, n: Any, k: Any = 0.0) -> None:
        raise NotImplementedError

    @classmethod
    def of_curve(cls, curve: Curve, wavelength: Any = None) -> Self:
        """Return the material of a curve with the parts n and k.

        Parameters
        ----------
        curve : Curve
            What its n and k are.
        wavelength : float, str, array_like or Parameter, optional
            In vacuum.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            If the curve is not known at the wavelength.
        """
        if isinstance(wavelength, Parameter) or wavelength is None:
            wavelength = in_unit_of(wavelength or Wavelength(), WAVELENGTH)
            return cls(*curve_values(curve, wavelength))
        there = Wavelength().resolve(wavelength).value
        WavelengthRange.of(curve).check("the wavelength", there)
        found = curve_values(curve, there)
        if isinstance(found[0], CurveValue):
            return cls(*found)  # Its coefficients are given later.
        return cls(*[value.at(there) for value in curve_values(curve, Wavelength())])
