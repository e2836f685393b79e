"""Stokes vectors of any size over one power of ten, so that axes can have their numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.light import Light
from optipath.light.underflow import normalise_exponent
from optipath.values.arrays.jax_values import known

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt

_PLAIN = range(-3, 5)
"""The powers of ten that numbers on an axis are written without."""


def without_noise(light: Light) -> Light:
    """Return light with 0 for what is no more than rounding.

    Examples
    --------
    >>> import optipath as op
    >>> without_noise(op.load_preset("senarmont").trace()).stokes
    array([0., 0., 0., 0.])
    """
    numbers, floor = known(light.mantissa), np.asarray(light.noise_floor)[..., np.newaxis]
    noise = (np.abs(numbers) < floor) & np.isfinite(floor)
    return Light.of(np.where(noise, 0.0, numbers), light.frame, light.exponent, measured=True)


def power_of_ten(lights: Sequence[Light], others: Iterable[npt.NDArray[np.float64]]) -> int:
    """Return over which power of ten some Stokes vectors are drawn; 0 where they need none.

    Examples
    --------
    >>> import optipath as op
    >>> power_of_ten([op.Light([2e-300, 0.0, 0.0, 0.0])], []), power_of_ten([], [np.array([99.0])])
    (-300, 0)
    """
    largest = [float(light.log10_intensity) for light in lights]
    with np.errstate(divide="ignore"):
        largest += [float(np.log10(np.nanmax(np.abs(each), initial=0.0))) for each in others]
    finite = [power for power in largest if np.isfinite(power)]
    power = int(np.floor(max(finite, default=0.0)))
    return 0 if power in _PLAIN else power


def scaled_to(stokes: Any, exponent: Any, power: int) -> npt.NDArray[np.float64]:
    """Return numbers times two to an exponent over a power of ten, be they floats or not.

    Shapes: stokes (4,); returns (4,).

    Examples
    --------
    >>> scaled_to(np.array([2e-300, 0.0, np.nan, 1e-300]), 0, -300).round(12)
    array([ 2.,  0., nan,  1.])
    """
    infinite = np.isinf(stokes)
    numbers = np.where(infinite, np.nan, np.asarray(stokes, float))
    if not power:
        scaled = np.ldexp(numbers, exponent)
    else:
        mantissa, own = normalise_exponent(numbers, exponent)
        with np.errstate(under="ignore"):
            scaled = mantissa * np.exp2(float(own) - power * np.log2(10.0))
    return np.asarray(np.where(infinite, stokes, scaled))
