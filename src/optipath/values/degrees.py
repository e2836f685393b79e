"""Degrees given for radians: how they are told from angles in radians, and what was meant."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from optipath.values.units import parse_quantity
from optipath.values.written_units import UNITS_ARE_WRITTEN

if TYPE_CHECKING:
    from collections.abc import Callable

TURN = 2.0 * math.pi * (1.0 + 1e-6)
"""Up to what size an angle is taken for one in radians: a whole turn, however it is rounded."""

_MULTIPLES = 10.0
"""Up to what factor of an angle one has to do with an angle still."""


def is_within_a_turn(low: Any, high: Any) -> bool:
    """Tell whether a range has no angle beyond a whole turn.

    Units: low, high in radians.

    Examples
    --------
    >>> is_within_a_turn(0.0, 1.6), is_within_a_turn(0.0, math.inf)
    (True, False)
    """
    are_numbers = isinstance(low, (int, float)) and isinstance(high, (int, float))
    return are_numbers and abs(low) <= TURN and abs(high) <= TURN


def has_plain_degrees(low: float, high: float) -> bool:
    """Tell whether a range of angles was given by plain numbers that were meant in degrees.

    Units: low, high in radians.

    Examples
    --------
    >>> has_plain_degrees(0.0, 80.0), has_plain_degrees(0.0, math.pi)
    (True, False)
    """
    return any(TURN < abs(end) < math.inf for end in (low, high))


def counts_degrees(scale: float) -> bool:
    """Tell whether an angle is a number times pi/180, computed or typed."""
    return math.isclose(abs(scale), math.pi / 180.0, rel_tol=1e-3)


def is_of_an_angle(scale: float) -> bool:
    """Tell whether a factor is one of angles, and not one that makes angles of pure numbers.

    Examples
    --------
    >>> is_of_an_angle(-1.0), is_of_an_angle(2.5), is_of_an_angle(math.pi / 180.0)
    (True, True, False)
    """
    return abs(scale) <= _MULTIPLES and (2.0 * scale).is_integer()


def meant_in_degrees(number: float, allows: Callable[[float], Any]) -> str:
    """Return what a number that is refused as an angle was meant to be, ready to be put behind.

    Units: number, allows in radians.

    Examples
    --------
    >>> meant_in_degrees(48.0, lambda angle: 0.0 <= angle <= 1.6)
    "; did you mean '48 deg' or np.radians(48)?"
    >>> meant_in_degrees(math.radians(100.0), lambda angle: 0.0 <= angle <= 1.6)
    ''
    """
    # Up to a whole turn, what is no whole number may have been computed.
    meant = abs(number) > TURN or (abs(number) >= 2.0 and float(number).is_integer())
    if not meant or UNITS_ARE_WRITTEN.get() or not allows(math.radians(number)):
        return ""
    return f"; did you mean '{number:.6g} deg' or np.radians({number:.6g})?"


def called(
    number: float, text: str, dimension: str, limits: tuple[float, float]
) -> tuple[str, str]:
    """Return how a number beyond its limits is called, and what it was meant to be.

    Units: number in radians.

    Examples
    --------
    >>> called(5.0, "286 deg", "angle", (0.0, 1.6))
    ('5 rad, which is 286.479 deg', "; did you mean '5 deg' or np.radians(5)?")
    """
    told = _in_few_digits(text, dimension, limits)
    if dimension != "angle":
        return told, ""
    meant = meant_in_degrees(number, lambda angle: limits[0] <= angle <= limits[1])
    return (_in_both(number) if meant else told), meant


def _in_few_digits(text: str, dimension: str, limits: tuple[float, float]) -> str:
    """Return a quantity with six digits, unless it would seem to be within its limits then."""
    number, space, unit = text.partition(" ")
    short = f"{float(number):.6g}{space}{unit}"
    value = parse_quantity(short, dimension)
    if len(short) >= len(text) or limits[0] <= value.real <= limits[1]:
        return text
    return short


def _in_both(number: float) -> str:
    """Write an angle in radians and in degrees.

    Examples
    --------
    >>> _in_both(48.0)
    '48 rad, which is 2750.2 deg'
    """
    return f"{number:.6g} rad, which is {math.degrees(number):.6g} deg"
