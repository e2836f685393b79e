"""Warnings of degrees given for radians, where a plain number is too large to be an angle."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import AngleWarning, OptipathError
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced
from optipath.values.calls_up import calls_up
from optipath.values.degrees import TURN, is_of_an_angle
from optipath.values.units import UNITS, unit_of
from optipath.values.written_units import UNITS_ARE_WRITTEN

if TYPE_CHECKING:
    from optipath.values.affine import Affine

_MOST = 1 << 1000
"""Beyond, whole numbers are no floats."""

_LOOKED_AT = 1000
"""At how many numbers of an array one looks; degrees are seen in any of them."""


def warn_of_degrees(what: str, value: Any, place: Affine | None = None) -> None:
    """Warn of a plain number beyond a whole turn; texts with units are what they say.

    The sentence is the same for all values, so that Python shows it once a place.

    Examples
    --------
    >>> warn_of_degrees("a turn", 1.0)
    >>> warn_of_degrees("a turn", "720 deg")
    """
    if place is not None and not is_of_an_angle(place.scale):
        return
    if TURN < abs(largest(value)) < math.inf and not UNITS_ARE_WRITTEN.get():
        warnings.warn(
            f"{what} is a plain number beyond 2 pi, in radians; write degrees as '48 deg', and "
            f"radians as '48 rad'",
            AngleWarning,
            stacklevel=calls_up(),
        )


def warn_of_two_factors(name: str, value: Any) -> None:
    """Warn of a text in degrees for a parameter of which pi/180 makes radians once more."""
    try:
        entries = as_given("", value).ravel().tolist()
    except OptipathError:
        return  # For validation to name.
    units = (UNITS.get(unit_of(entry)) for entry in entries if isinstance(entry, str))
    if any(unit is not None and unit.dimension == "angle" for unit in units):
        warnings.warn(
            f"parameter '{name}' has a unit, and the path multiplies it by pi / 180; give degrees "
            f"as a plain number",
            AngleWarning,
            stacklevel=calls_up(),
        )


def largest(value: Any) -> float:
    """Return the plain number of the largest size in a value, out of a thousand; 0 without any.

    Examples
    --------
    >>> largest([0.5, -90.0]), largest(["720 deg", 0.5]), largest(None)
    (-90.0, 0.5, 0.0)
    """
    if type(value) is float:
        return value
    if value is None or isinstance(value, str) or is_traced(value):
        return 0.0
    try:
        array = as_given("", value)
    except OptipathError:
        return 0.0  # For validation to name.
    if array.size > _LOOKED_AT:
        flat = array.reshape(-1) if array.flags.c_contiguous else array.flat
        array = flat[np.linspace(0, array.size - 1, _LOOKED_AT).astype(np.intp)]
    if array.dtype.kind == "O":
        numbers = [n for n in array.ravel().tolist() if isinstance(n, (float, np.floating))]
        numbers += [float(n) for n in array.ravel().tolist() if type(n) is int and abs(n) < _MOST]
        array = np.array(numbers, np.float64)
    if array.dtype.kind not in "iuf" or not array.size:
        return 0.0
    at = np.argmax(np.abs(np.where(np.isfinite(array), array, 0.0)))
    return float(array.reshape(-1)[at])
