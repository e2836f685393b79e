"""Light as text: ``str(light)`` and the digits of its numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.light.frame import Frame
from optipath.values.jax_values import is_traced
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from optipath.values.parameters import Parameter


_SHOWN = 6
"""How many lights of a batch are shown."""


def text_of(numbers: Any, frame: Frame) -> str:
    """Return light (..., 4) as one writes it, a few of very many."""
    most = 4 * _SHOWN
    messages = [
        repr(numbers)
        if is_traced(numbers)
        else np.array2string(numbers, separator=", ", threshold=most, edgeitems=2, prefix="Light(")
    ]
    if frame != Frame():
        messages.append("frame=" + repr(frame))
    if numbers.size > most:
        messages.append(f"shape={numbers.shape[:-1]}")
    return f"Light({', '.join(messages)})"


class Numbers(NamedTuple):
    """How numbers are written."""

    digits: int

    def text(self, number: float, noise: float = 0.0) -> str:
        """Return a number as it is printed."""
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

    def stokes(self, light: Any, index: tuple[int, ...] = ()) -> list[str]:
        """Return the four components of a light."""
        noise = float(light.noise[index])
        return [self.text(component, noise) for component in light.stokes[index].tolist()]
