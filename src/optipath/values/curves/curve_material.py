"""CurveMaterial: a material whose n and k are those of a curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from optipath.values.curves.curve_at import curve_at

if TYPE_CHECKING:
    from optipath.values.curves.curve import Curve


class CurveMaterial:
    """What a `Material` is made of besides two numbers: a curve, and a wavelength.

    The wavelength is by default the parameter of that name, which is given when a path is traced;
    or another `Parameter`; or a number in metres or a text such as ``"516 nm"``, of which a
    constant material is made.
    """

    def __init__(self, n: Any, k: Any = 0.0) -> None:
        raise NotImplementedError

    @classmethod
    def of_curve(cls, curve: Curve, wavelength: Any = None, k: Any = 0.0) -> Self:
        """Return the material of a curve with the parts n and k, or with n alone.

        Parameters
        ----------
        curve : Curve
            What its n and k are.
        wavelength : float, str, array_like or Parameter, optional
            In vacuum.
        k : float or Parameter, optional
            The extinction coefficient, the same at all wavelengths, of a curve of n alone. That
            it is 0 is known to whoever composes a path, that a curve of k is 0 is not.

        Returns
        -------
        Material

        Raises
        ------
        ValueFault
            If the curve is not known at the wavelength.
        """
        n, *rest = curve_at(curve, wavelength)
        return cls(n, rest[0] if rest else k)
