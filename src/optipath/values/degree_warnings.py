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
from optipath.values.degrees import TURN, in_both, in_degrees, is_in_radians, is_of_an_angle
from optipath.values.units import UNITS, parse_quantity, unit_of
from optipath.values.written_units import UNITS_ARE_WRITTEN

if TYPE_CHECKING:
    from optipath.values.affine import Affine

_TYPED = 6
"""How many characters a number has at most that somebody has typed, and not computed."""

_PERHAPS_ROUNDED = 1e-3
"""How far pi/180 may be off where somebody has typed it."""

_MOST = 1 << 1000
"""Beyond, whole numbers are no floats."""

_LOOKED_AT = 1000
"""At how many numbers of an array one looks; degrees are seen in any of them."""


def warn_of_degrees(what: str, value: Any, place: Affine | None = None) -> bool:
    """Warn where a plain number is beyond a whole turn; texts with units are what they say.

    Of a multiple, the angle is beyond a whole turn, too; one of a pure number is never warned of.

    Parameters
    ----------
    what : str
        What the angle is given for.
    value : Any
        What is given: a number, a text, an array or a list of either, or anything else.
    place : Affine, optional
        What the angle is of the number, where that is a multiple with an offset.

    Returns
    -------
    bool
        Whether it was warned.

    Examples
    --------
    >>> warn_of_degrees("a turn", 1.0), warn_of_degrees("a turn", "720 deg")
    (False, False)
    """
    if place is not None and not is_of_an_angle(place.scale):
        return False
    number = largest(value)
    if not TURN < abs(number) < math.inf or is_in_radians(number):
        return False
    told = in_both(number)
    if place is not None and abs(place.scale) != 1.0:
        angle = place.placed(number)
        if not TURN < abs(angle) < math.inf or is_in_radians(angle):
            return False
        told = f"{number:.6g}, and {place.formula} is {in_both(angle)}"
    several = "has a value of" if np.ndim(value) else "is"
    warnings.warn(
        f"{what} {several} {told}; did you mean {in_degrees(number)}?",
        AngleWarning,
        stacklevel=calls_up(),
    )
    return True


def counts_degrees(place: Affine) -> bool:
    """Tell whether an angle is a number times pi/180."""
    return math.isclose(abs(place.scale), math.pi / 180.0, rel_tol=_PERHAPS_ROUNDED)


def warn_of_two_factors(what: str, value: Any, place: Affine) -> bool:
    """Warn where a text with an angle's unit is given for what pi/180 makes radians of once more.

    Parameters
    ----------
    what : str
        What the angle is given for.
    value : Any
        What is given: a text, or an array or a list with texts among its entries.
    place : Affine
        What the angle is of the number.

    Returns
    -------
    bool
        Whether it was warned.
    """
    if not counts_degrees(place):
        return False
    try:
        entries = as_given("", value).ravel().tolist()
    except OptipathError:
        return False  # For validation to name.
    texts = [entry for entry in entries if isinstance(entry, str) and unit_of(entry) in UNITS]
    angles = (text for text in texts if UNITS[unit_of(text)].dimension == "angle")
    if (text := next(angles, None)) is None:
        return False
    angle = math.degrees(place.placed(parse_quantity(text, "angle")))
    warnings.warn(
        f"{what} is '{text}', and {place.formula} is {angle:.6g} deg; give the degrees as a plain "
        f"number, or leave the factor pi / 180 out where the path is built",
        AngleWarning,
        stacklevel=calls_up(),
    )
    return True


def warn_of_turning(what: str, rate: Any, length: float, usual: str) -> bool:
    """Warn where a plain number per metre, typed by hand, is beyond a whole turn over a length.

    Parameters
    ----------
    what : str
        What the angle per length is given for.
    rate : Any
        What is given: a number, a text, an array or a list of either, or anything else.
    length : float
        Over how many metres.
    usual : str
        The unit that is usual for it.

    Returns
    -------
    bool
        Whether it was warned.

    Examples
    --------
    >>> warn_of_turning("a rotation", 66.5, 0.01, "deg/dm")
    False
    """
    size = largest(rate)
    # What has been computed has many digits.
    typed = len(f"{abs(size):.12g}") <= _TYPED
    if not typed or not TURN < abs(size * length) < math.inf or UNITS_ARE_WRITTEN.get():
        return False
    warnings.warn(
        f"{what} is {size:.6g} rad/m, which over {length:.6g} m is {in_both(size * length)}; did "
        f"you mean '{size:.6g} {usual}'? (if not, write '{size:.6g} rad/m')",
        AngleWarning,
        stacklevel=calls_up(),
    )
    return True


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
