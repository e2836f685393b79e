"""Degrees given for radians: said wherever a plain number is too large to be an angle."""

from __future__ import annotations

import math
import sys
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import AngleWarning, OptipathError
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced
from optipath.values.units import UNITS, parse_quantity, unit_of
from optipath.values.written_units import UNITS_ARE_WRITTEN

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.affine import Affine

TURN = 2.0 * math.pi * (1.0 + 1e-6)
"""Up to what size an angle is taken for one in radians: a whole turn, however it is rounded."""

_LEAST = 2.0
"""From what size on a number that is refused may have been one of degrees."""

_TYPED = 6
"""How many characters a number has at most that somebody has typed, and not computed."""

_PERHAPS_ROUNDED = 1e-3
"""How far pi/180 may be off where somebody has typed it."""

_MOST = 1 << 1000
"""Beyond, whole numbers are no floats."""

_LOOKED_AT = 1000
"""At how many numbers of an array one looks; degrees are seen in any of them."""


def is_within_a_turn(low: Any, high: Any) -> bool:
    """Tell whether a range has no angle beyond a whole turn.

    Parameters
    ----------
    low, high : Any
        Its ends, in radians.

    Returns
    -------
    bool
        False also where an end is no number.

    Examples
    --------
    >>> is_within_a_turn(0.0, 1.6), is_within_a_turn(0.0, math.inf)
    (True, False)
    """
    are_numbers = isinstance(low, (int, float)) and isinstance(high, (int, float))
    return are_numbers and abs(low) <= TURN and abs(high) <= TURN


def warn_of_degrees(what: str, value: Any, place: Affine | None = None) -> bool:
    """Warn where a plain number is beyond a whole turn; texts with units are what they say.

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
    if place is None or place.is_signed:
        if type(value) is float and not TURN < abs(value) < math.inf:
            return False
        angle = number = largest(value)
        told = in_both(angle)
    else:
        number = largest(value, place.zero)
        angle = place.placed(number)
        told = f"{number:.6g}, and {place.formula} is {in_both(angle)}"
    if not TURN < abs(angle) < math.inf or _is_in_radians(number) or _is_in_radians(angle):
        return False
    several = "has a value of" if np.ndim(value) else "is"
    warnings.warn(
        f"{what} {several} {told}; did you mean {_in_degrees(number)}?",
        AngleWarning,
        stacklevel=_outside(),
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
    texts = [entry for entry in entries if isinstance(entry, str)]
    angles = (
        text for text in texts if getattr(UNITS.get(unit_of(text)), "dimension", 0) == "angle"
    )
    if (text := next(angles, None)) is None:
        return False
    angle = math.degrees(place.placed(parse_quantity(text, "angle")))
    warnings.warn(
        f"{what} is '{text}', and {place.formula} is {angle:.6g} deg; give the degrees as a plain "
        f"number, or leave the factor pi / 180 out where the path is built",
        AngleWarning,
        stacklevel=_outside(),
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
        stacklevel=_outside(),
    )
    return True


def meant_in_degrees(number: float, allows: Callable[[float], Any]) -> str:
    """Return what a number that is refused as an angle was meant to be, ready to be put behind.

    Parameters
    ----------
    number : float
        In radians.
    allows : callable
        Tells whether an angle in radians is allowed.

    Returns
    -------
    str
        ``"; did you mean '48 deg' or np.radians(48)?"``; nothing where degrees are refused too,
        or have been turned into radians already.

    Examples
    --------
    >>> meant_in_degrees(48.0, lambda angle: 0.0 <= angle <= 1.6)
    "; did you mean '48 deg' or np.radians(48)?"
    >>> meant_in_degrees(math.radians(100.0), lambda angle: 0.0 <= angle <= 1.6)
    ''
    """
    # A little beyond a right angle, it is a slip; up to a whole turn, it may have been computed.
    typed = abs(number) > TURN or len(f"{number:.12g}") + 3 < len(f"{math.degrees(number):.12g}")
    if abs(number) < _LEAST or not typed or _is_in_radians(number):
        return ""
    return f"; did you mean {_in_degrees(number)}?" if allows(math.radians(number)) else ""


def called(
    number: float, text: str, dimension: str, limits: tuple[float, float]
) -> tuple[str, str]:
    """Return how a number beyond its limits is called, and what it was meant to be.

    Parameters
    ----------
    number : float
        In radians, if it is an angle.
    text : str
        How it is called in its unit.
    dimension : str
        What it measures.
    limits : tuple of float
        What is allowed.

    Returns
    -------
    tuple of str
        The second to be put behind the sentence; empty but for degrees given for radians.

    Examples
    --------
    >>> called(2.5, "143 deg", "angle", (0.0, 1.6))
    ('2.5 rad, which is 143.239 deg', "; did you mean '2.5 deg' or np.radians(2.5)?")
    """
    told = _in_few_digits(text, dimension, limits)
    if dimension != "angle":
        return told, ""
    meant = meant_in_degrees(number, lambda angle: limits[0] <= angle <= limits[1])
    return (in_both(number) if meant else told), meant


def _in_few_digits(text: str, dimension: str, limits: tuple[float, float]) -> str:
    """Return a quantity with six digits, unless it would seem to be within its limits then."""
    number, space, unit = text.partition(" ")
    short = f"{float(number):.6g}{space}{unit}"
    value = parse_quantity(short, dimension)
    if len(short) >= len(text) or limits[0] <= value.real <= limits[1]:
        return text
    return short


def in_both(number: float) -> str:
    """Write an angle in radians and in degrees.

    Examples
    --------
    >>> in_both(48.0)
    '48 rad, which is 2750.2 deg'
    """
    return f"{number:.6g} rad, which is {math.degrees(number):.6g} deg"


def largest(value: Any, zero: float = 0.0) -> float:
    """Return the plain number of the largest size in a value, out of a thousand.

    Parameters
    ----------
    value : Any
        What is given: a number, a text, an array or a list of either, or anything else.
    zero : float, optional
        From where sizes are counted; returned where there is no number.

    Returns
    -------
    float

    Examples
    --------
    >>> largest([0.5, -90.0]), largest(["720 deg", 0.5]), largest(None)
    (-90.0, 0.5, 0.0)
    >>> largest([50.0, 80.0], zero=90.0)
    50.0
    """
    if type(value) is float:
        return value
    if value is None or isinstance(value, str) or is_traced(value):
        return zero
    try:
        array = as_given("", value)
    except OptipathError:
        return zero  # For validation to name.
    if array.size > _LOOKED_AT:
        flat = array.reshape(-1) if array.flags.c_contiguous else array.flat
        array = flat[np.linspace(0, array.size - 1, _LOOKED_AT).astype(np.intp)]
    if array.dtype.kind == "O":
        numbers = [n for n in array.ravel().tolist() if isinstance(n, (float, np.floating))]
        numbers += [float(n) for n in array.ravel().tolist() if type(n) is int and abs(n) < _MOST]
        array = np.array(numbers, np.float64)
    if array.dtype.kind not in "iuf" or not array.size:
        return zero
    at = np.argmax(np.abs(np.where(np.isfinite(array), array, zero) - zero))
    return float(array.reshape(-1)[at])


def _is_in_radians(number: float) -> bool:
    """Tell whether an angle is surely meant in radians: written so, or a round one in degrees."""
    degrees = math.degrees(number)
    return UNITS_ARE_WRITTEN.get() or len(f"{degrees:.12g}") < len(f"{number:.12g}")


def _in_degrees(number: float) -> str:
    return f"'{number:.6g} deg' or np.radians({number:.6g})"


def _outside() -> int:
    """Return how many calls up from the one that warns the library was called."""
    level = 2
    frame: Any = sys._getframe(level)  # noqa: SLF001 - as warnings itself looks
    while frame.f_back is not None and (
        frame.f_globals.get("__name__", "").partition(".")[0] in ("optipath", "dataclasses")
        # The makers of dataclasses and own elements are made of texts.
        or frame.f_code.co_filename.startswith("<")
    ):
        frame, level = frame.f_back, level + 1
    return level
