"""How light is carried along a program where nothing is too faint for plain numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.kernels.carriers.intensity_carrier import IntensityCarrier
from optipath.kernels.carriers.stokes_carrier import StokesCarrier

if TYPE_CHECKING:
    from optipath.engines.program.program import Program
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.kernels.numbers.primitives import Primitives

_SPARE = 2.0**60
"""How far the numbers of a quotient keep from where they lose digits."""


def carrying(
    program: Program, carrier: type[Carrier], xp: Primitives, dtype: str
) -> tuple[Program, Carrier]:
    """Return what is done to light, and its carrier: intensities alone where that will do."""
    if carrier is StokesCarrier and program.for_powers is not None:
        return program.for_powers, IntensityCarrier(xp, float(np.finfo(dtype).tiny) * _SPARE)
    return program, carrier(xp)
