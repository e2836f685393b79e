"""Wavelengths of light, found when somebody asks for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import LightError, ShapeError
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.read_only import locked
from optipath.values.displayed import displayed
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.roundings import Array

_ROUNDING = 2.0 * float(np.finfo(np.float32).eps)
"""By how much, as a share, wavelengths differ that are one, given in single precision."""


def common_wavelength(light: Any, other: Any) -> Any:
    """Return what light has that is made of this, and of another one if there is one."""
    mine = light.kept_wavelength
    if other is None or mine is None or mine is other.kept_wavelength:
        return mine
    # Found now, lest sums of many lights keep what finds those of each.
    one, two = light.wavelength, other.wavelength
    if one is None or two is None or is_traced(one) or is_traced(two):
        return None
    if (apart := np.abs(one - two) > _ROUNDING * one).any():
        pair = [displayed(np.broadcast_to(w, apart.shape)[apart][0], "nm") for w in (one, two)]
        raise LightError(
            f"lights of different wavelengths, {pair[0]} and {pair[1]}, have no sum; "
            f"add light.integrate() of each, or, of powers, op.Light(light.stokes, light.frame)"
        )
    return light.wavelength


def part_of_wavelength(light: Any, change: Callable[[Any], Any]) -> Any:
    """Return what returns the wavelengths of a part of the batch; None where there are none."""
    kept, batch = light.kept_wavelength, light.shape
    if kept is None or light.wavelengths_in_doubt:
        return kept

    def part() -> Any:
        found = kept() if callable(kept) else kept
        if found is None:
            return None
        xp = namespace(found)
        found = change(xp.broadcast_to(found, batch))
        return namespace(found).asarray(found)

    return part


def wavelengths_for(batch: tuple[int, ...], given: Any) -> Array:
    """Return wavelengths that somebody gives for light.

    Units: given, the result in metres.

    Examples
    --------
    >>> wavelengths_for((2,), ["500 nm", "2.4 eV"]).round(9)
    array([5.00e-07, 5.17e-07])
    """
    found = Wavelength().resolve(given).value
    shape = tuple(found.shape)
    if len(shape) > len(batch) or any(
        own not in (1, whole) for own, whole in zip(shape[::-1], batch[::-1], strict=False)
    ):
        raise ShapeError(
            f"wavelengths of shape {shape} do not fit light of shape {batch}; give one for each "
            f"light, or an array that broadcasts to them, such as wavelengths[:, None]"
        )
    wavelengths: Array = found if is_traced(found) else locked(np.array(found, np.float64))
    return wavelengths
