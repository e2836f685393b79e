"""Numbers as they are printed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from optipath.values.units import in_unit

if TYPE_CHECKING:
    from optipath.light.light import Light
    from optipath.values.parameters import Parameter


class Numbers(NamedTuple):
    """How numbers are written.

    Attributes
    ----------
    digits : int
        How many of them, leading zeros aside.
    """

    digits: int

    def text(self, number: float, noise: float = 0.0) -> str:
        """Return a number as it is printed.

        Parameters
        ----------
        number : float
            NaN where a detector does not read it.
        noise : float, optional
            What is smaller is rounding, and is printed as 0.

        Returns
        -------
        str
        """
        if math.isnan(number):
            return "not read"
        return f"{0.0 if abs(number) < noise else number + 0.0:.{self.digits}g}"

    def state(self, number: float) -> str:
        """Return a number of the polarisation; NaN where light has none."""
        return "-" if math.isnan(number) else self.text(number)

    def value_of(self, parameter: Parameter) -> str:
        """Return the value of a parameter, in its unit."""
        value = parameter.default
        if not isinstance(value, float):
            return parameter.text(value)
        return f"{in_unit(value, parameter.unit):.{self.digits}g} {parameter.unit}".strip()

    def stokes(self, light: Light, index: tuple[int, ...] = ()) -> list[str]:
        """Return the four components of a light.

        Parameters
        ----------
        light : Light
            One, or a batch.
        index : tuple of int, optional
            Which of a batch.

        Returns
        -------
        list of str
        """
        noise = float(light.noise[index])
        return [self.text(component, noise) for component in light.stokes[index].tolist()]
