"""Tristimulus values: what spectral light comes to for the standard observer."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ColourWarning, LightError, ValueFault, shown, unknown
from optipath.light.colour.observer import LUMENS_PER_WATT, Observer, observer_called
from optipath.light.integration import spectral_axis, weighted_sum
from optipath.light.light import Light
from optipath.light.underflow import times_two_to
from optipath.values.arrays.jax_values import is_traced, known
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.calls_up import calls_up
from optipath.values.curves.curve_value import CurveValue
from optipath.values.spectra.grid_bins import NANOMETRES
from optipath.values.spectra.spectrum import Spectrum

if TYPE_CHECKING:
    from optipath.values.roundings import Array

_VISIBLE = (380.0, 780.0)
_COARSE = 20.0
"""Nanometres between wavelengths, above which colours of smooth spectra are seen to be off."""

_ROUNDING = 1e-6


def tristimulus(light: Light, white: Any, observer: str, outside: str) -> Array:
    """Return X, Y and Z of spectral light; see `Light.to_xyz`.

    Shape: returns (..., 3).
    """
    standard = observer_called(observer)
    total, power = _sums(light, standard, outside)
    warn_of(light, standard, outside)
    if white is None:
        absolute: Array = LUMENS_PER_WATT * _plain(total, power)
        return absolute
    of_white, power_of_white = white_sums(light, white, standard, outside)
    check_broadcast({"light": total.shape[:-1], "white": of_white.shape[:-1]})
    if is_traced(total) or is_traced(of_white):
        relative: Array = _plain(total, power) / _plain(of_white, power_of_white)[..., 1:2]
        return relative
    return times_two_to(total / of_white[..., 1:2], power - power_of_white)


def _plain(total: Any, power: Any) -> Any:
    return total if is_traced(total) else times_two_to(total, power)


def white_sums(light: Light, white: Any, observer: Observer, outside: str) -> tuple[Any, Any]:
    """Return X, Y and Z of what is white, as a mantissa and the exponent of its power of two.

    Shape: returns total (..., 3).
    """
    if isinstance(white, Light):
        total, power = _sums(white, observer, outside)
    elif isinstance(white, (Spectrum, CurveValue)):
        grid, _ = spectral_axis(light)
        values = np.asarray(white.at(grid), np.float64)[:, np.newaxis]
        weights = _weights(grid, observer, outside)
        total, power = weighted_sum(values, np.zeros(len(grid), np.int64), weights, 0)
    else:
        raise ValueFault(
            f"white is {shown(white)}, which has no spectrum; give the light of the same path "
            f"without the sample, or a Spectrum such as op.Spectrum.illuminant('D65')"
        )
    if not is_traced(total) and not np.all(total[..., 1] > 0.0):
        raise ValueFault("white is dark (Y = 0), and nothing is relative to that")
    return total, power


def _sums(light: Light, observer: Observer, outside: str) -> tuple[Any, Any]:
    """Return X, Y and Z as sums, and the exponent of the power of two times these."""
    grid, axis = spectral_axis(light)
    weights = _weights(grid, observer, outside)
    return weighted_sum(known(light.mantissa)[..., :1], light.exponent, weights, axis)


def _weights(grid: Array, observer: Observer, outside: str) -> Array:
    """Return what each wavelength adds to X, Y and Z, in the order of the grid."""
    if faults := unknown("outside", outside, ("dark", "nearest")):
        raise ValueFault(*faults)
    rises = grid[-1] > grid[0]
    rising = NANOMETRES * (grid if rises else grid[::-1])
    weights = observer.weights(rising, nearest=outside == "nearest")
    return weights if rises else weights[::-1]


def warn_of(light: Light, observer: Observer, outside: str) -> None:
    """Say what colour loses by wavelengths that are few, or end within what is seen."""
    grid = np.sort(spectral_axis(light)[0]) * NANOMETRES
    first, last = grid[[0, -1]]
    if last < _VISIBLE[0] or first > _VISIBLE[1]:
        raise LightError(
            f"light of {first:.6g} nm .. {last:.6g} nm is not seen; colour needs wavelengths "
            f"within 380 nm .. 780 nm"
        )
    ends_within = first > _VISIBLE[0] + _ROUNDING or last < _VISIBLE[1] - _ROUNDING
    if ends_within and outside == "dark":
        warnings.warn(
            f"the light is known from {first:.6g} nm to {last:.6g} nm, and taken for dark "
            f"beyond, where white light has up to {100 * observer.left_out(grid):.3g} % of its X, "
            f"Y or Z; compute it from 380 nm to 780 nm, or write outside='nearest'",
            ColourWarning,
            stacklevel=calls_up(),
        )
    inside = grid[(grid >= _VISIBLE[0]) & (grid <= _VISIBLE[1])]
    widest = np.max(np.diff(inside if len(inside) > 1 else grid))
    if widest > _COARSE + _ROUNDING:
        warnings.warn(
            f"wavelengths are {widest:.6g} nm apart, and the light is linear between them: what "
            f"is narrower in its spectrum is not seen, and colours may be off by some per cent; "
            f"steps of 5 nm cost little",
            ColourWarning,
            stacklevel=calls_up(),
        )
