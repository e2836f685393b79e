"""How thick a plate of a crystal is that retards by so much at a wavelength."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.affine import real_number
from optipath.values.crystals import Crystal
from optipath.values.curves.curve_value import CurveValue
from optipath.values.domains.quantities import ANGLE
from optipath.values.wavelength import Wavelength

_TURN = 2.0 * math.pi


def plate_for(retardance: Any, at: Any, crystal: Any, order: Any) -> tuple[float, Any, Any]:
    """Return thickness, birefringence and wavelength of a plate.

    Units: retardance in radians; at, thickness in metres.

    Examples
    --------
    >>> thickness, _, _ = plate_for("90 deg", "589.3 nm", 0.0091, 0)
    >>> round(thickness * 1e6, 3)
    16.19
    """
    whole = real_number(order)
    if whole is None or whole < 0.0 or not whole.is_integer():
        raise ValueFault(
            f"order is {shown(order)}; give how many whole waves there are, 0, 1, 2, ..."
        )
    phase = _one("retardance", ANGLE.check("retardance", retardance))
    where = _one("at", Wavelength("at").resolve(at).value)
    if phase < 0.0:
        raise ValueFault(
            f"retardance is {phase:g}; give one of 0 or more, and turn the angle by 90 deg"
        )
    birefringence = _birefringence(crystal)
    there = _at(birefringence, where)
    if not np.isfinite(there) or there == 0.0:
        raise ValueFault(
            f"crystal has a birefringence of {there:g} at {where * 1e9:.10g} nm; give one that "
            f"retards"
        )
    thickness = (whole + phase / _TURN) * where / abs(there)
    when = birefringence.given_by[0] if isinstance(birefringence, CurveValue) else Wavelength()
    return thickness, -birefringence if there < 0.0 else birefringence, when


def _birefringence(crystal: Any) -> Any:
    if isinstance(crystal, str):
        crystal = Crystal.named(crystal)
    found = crystal.birefringence if isinstance(crystal, Crystal) else crystal
    if isinstance(found, CurveValue) or real_number(found) is not None:
        return found
    raise ValueFault(
        f"crystal is {shown(crystal)}; give a name such as 'quartz', a Crystal, or a birefringence "
        f"as a number or by wavelength"
    )


def _at(birefringence: Any, wavelength: float) -> float:
    known = isinstance(birefringence, CurveValue)
    return float(birefringence.at(wavelength) if known else birefringence)


def _one(name: str, number: Any) -> float:
    if np.ndim(number):
        raise ValueFault(f"{name} has shape {np.shape(number)}; give one number for one plate")
    return float(number)
