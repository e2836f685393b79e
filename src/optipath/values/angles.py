"""Angles: radians, cosine and sine pairs, and warnings of degrees given for radians."""

from __future__ import annotations

import math
import sys
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import AngleWarning, OptipathError, ParameterError, UnitError, shown
from optipath.values.arrays import (
    Unchanging,
    as_argument,
    broadcast_fault,
    joint_shape,
    numbers_for,
    refuse_too_large,
    same,
)
from optipath.values.jax_values import is_jax, is_traced, namespace
from optipath.values.messages import UNITS_ARE_WRITTEN
from optipath.values.precision import doubles, rounding_of
from optipath.values.units import UNITS, parse_quantity, unit_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.affine import Affine


_APART = 1e-6
_ANGLE = 8
"""How many bytes an angle has."""


class CosSin(Unchanging):
    """An angle by its cosine and sine, as scenes in space have it.

    May be given for any angle when a plan runs: next to the normal and at grazing incidence it
    has more digits than the angle, and no sine need be computed.

    Parameters
    ----------
    cos, sin : float or array_like
        They broadcast together.

    Raises
    ------
    ParameterError
        If one is missing, they do not broadcast, or belong to no angle: cos^2 + sin^2 is not 1.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("npgr026")
    >>> grazing = CosSin(1e-20, 1.0)
    >>> float(100.0 - path.trace(delta=grazing, phi=grazing).intensity) < 1e-12
    True
    """

    __slots__ = ("cos", "sin")

    cos: Any
    sin: Any

    def __init__(self, cos: Any, sin: Any = None) -> None:
        if sin is None:
            raise ParameterError(
                f"CosSin takes a cosine and a sine, not {shown(cos)} alone; give an angle itself, "
                f"without CosSin"
            )
        cos, sin = _numbers("cos", cos), _numbers("sin", sin)
        if faults := broadcast_fault({"cos": np.shape(cos), "sin": np.shape(sin)}):
            raise ParameterError(*faults)
        refuse_too_large(joint_shape(np.shape(cos), np.shape(sin)), _ANGLE, error=ParameterError)
        object.__setattr__(self, "cos", within_right_angle(cos, sin))
        object.__setattr__(self, "sin", sin)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape that both broadcast to."""
        return joint_shape(np.shape(self.cos), np.shape(self.sin))

    @property
    def angle(self) -> Any:
        """The angle in radians; NaN where JAX traces what belongs to no angle."""
        xp = namespace(self.sin if is_jax(self.sin) else self.cos)
        angle = xp.arctan2(self.sin, self.cos)
        if not self.is_traced:
            return angle
        apart = xp.abs(xp.square(self.cos) + xp.square(self.sin) - 1.0)
        return xp.where(apart <= _APART, angle, xp.nan)

    @property
    def is_traced(self) -> bool:
        """Whether JAX traces the cosine or the sine."""
        return is_traced(self.cos) or is_traced(self.sin)

    def check(self, what: str) -> None:
        """Raise unless cosine and sine belong to an angle.

        Raises
        ------
        ParameterError
            Naming what they were given for.
        """
        if not is_angle(self.cos, self.sin):
            raise ParameterError(
                f"{what} is given by a cosine and a sine that belong to no angle: "
                f"cos^2 + sin^2 is not 1; divide both by its root"
            )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CosSin):
            return NotImplemented
        return same(self.cos, other.cos) and same(self.sin, other.sin)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return CosSin, (self.cos, self.sin)

    def __repr__(self) -> str:
        return f"CosSin({self.cos!r}, {self.sin!r})"


def within_right_angle(cos: Any, sin: Any) -> Any:
    """Return cosines; 0 where the angle is beyond a right one by the rounding it is given in.

    >>> within_right_angle(np.cos(np.float32([np.pi / 2.0])), np.ones(1, np.float32))
    array([0.], dtype=float32)
    """
    kind = getattr(cos, "dtype", np.dtype(np.float64))
    if kind.char not in "ef" or is_jax(cos) or is_jax(sin) or not np.any(cos < 0.0):
        return cos
    right = np.abs(np.arctan2(sin, cos)) == kind.type(np.pi / 2.0)
    return np.where((cos < 0.0) & right, kind.type(0.0), cos)


def is_angle(cos: Any, sin: Any) -> bool:
    """Tell whether cosines and sines belong to angles, to the rounding in which they are given.

    >>> is_angle(np.array(0.6), np.array(0.8)), is_angle(np.array(0.6), np.array(0.7))
    (True, False)
    """
    apart = max(_APART, 2.0 * max(rounding_of(cos), rounding_of(sin)))
    cos, sin = doubles(cos), doubles(sin)
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.all(np.abs(np.square(cos) + np.square(sin) - 1.0) <= apart))


def _numbers(name: str, value: Any) -> Any:
    if is_jax(value):
        return value
    value = numbers_for(name, value, _pure, ParameterError)
    array = as_argument(name, value, ParameterError)
    if array.dtype.kind not in "iuf":
        raise ParameterError(f"{name} must be real numbers, not {shown(value)}")
    return array.astype(np.float64) if array.dtype.kind in "iu" else array


def _pure(text: str) -> Any:
    """Return the number that a text stands for, which is a cosine or a sine, and no angle."""
    if unit_of(text):
        raise UnitError(
            f"'{text}' has a unit, but a cosine and a sine are pure numbers; give the angle itself "
            f"in place of a CosSin"
        )
    return parse_quantity(text, "")


TURN = 2.0 * math.pi * (1.0 + 1e-6)
"""Up to what size an angle is taken for one in radians: a whole turn, however it is rounded."""

_MULTIPLES = 10.0
"""Up to what factor of an angle one has to do with an angle still."""


def is_within_a_turn(low: Any, high: Any) -> bool:
    """Tell whether a range, in rad, has no angle beyond a whole turn.

    >>> is_within_a_turn(0.0, 1.6), is_within_a_turn(0.0, math.inf)
    (True, False)
    """
    are_numbers = isinstance(low, (int, float)) and isinstance(high, (int, float))
    return are_numbers and abs(low) <= TURN and abs(high) <= TURN


def has_plain_degrees(low: float, high: float) -> bool:
    """Tell whether a range of angles, in rad, was given by plain numbers meant in degrees.

    >>> has_plain_degrees(0.0, 80.0), has_plain_degrees(0.0, math.pi)
    (True, False)
    """
    return any(TURN < abs(end) < math.inf for end in (low, high))


def counts_degrees(scale: float) -> bool:
    """Tell whether an angle is a number times pi/180, computed or typed."""
    return math.isclose(abs(scale), math.pi / 180.0, rel_tol=1e-3)


def is_of_an_angle(scale: float) -> bool:
    """Tell whether a factor is one of angles, and not one that makes angles of pure numbers.

    >>> is_of_an_angle(-1.0), is_of_an_angle(2.5), is_of_an_angle(math.pi / 180.0)
    (True, True, False)
    """
    return abs(scale) <= _MULTIPLES and (2.0 * scale).is_integer()


def meant_in_degrees(number: float, allows: Callable[[float], Any]) -> str:
    """Return what a number, refused as an angle in rad, was meant to be, as a suffix.

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

    >>> called(5.0, "286 deg", "angle", (0.0, 1.6))
    ('5 rad, which is 286.479 deg', "; did you mean '5 deg' or np.radians(5)?")
    """
    message = _in_few_digits(text, dimension, limits)
    if dimension != "angle":
        return message, ""
    meant = meant_in_degrees(number, lambda angle: limits[0] <= angle <= limits[1])
    return (_in_both(number) if meant else message), meant


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

    >>> _in_both(48.0)
    '48 rad, which is 2750.2 deg'
    """
    return f"{number:.6g} rad, which is {math.degrees(number):.6g} deg"


_MOST = 1 << 1000
"""Beyond, whole numbers are no floats."""

_LOOKED_AT = 1000
"""At how many numbers of an array one looks; degrees are seen in any of them."""


def warn_of_degrees(what: str, value: Any, place: Affine | None = None) -> None:
    """Warn of a plain number beyond a whole turn; texts with units are what they say.

    The sentence is the same for all values, so that Python shows it once a place.

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
        entries = as_argument("", value).ravel().tolist()
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

    >>> largest([0.5, -90.0]), largest(["720 deg", 0.5]), largest(None)
    (-90.0, 0.5, 0.0)
    """
    if type(value) is float:
        return value
    if value is None or isinstance(value, str) or is_traced(value):
        return 0.0
    try:
        array = as_argument("", value)
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


_PASSED = ("optipath", "dataclasses", "functools")


def calls_up() -> int:
    """Return how many calls up from the one that warns the library was called."""
    level = 2
    frame: Any = sys._getframe(level)  # noqa: SLF001 - as warnings itself looks
    while frame.f_back is not None and (
        frame.f_globals.get("__name__", "").partition(".")[0] in _PASSED
        # The makers of dataclasses and own elements are made of texts.
        or frame.f_code.co_filename.startswith("<")
    ):
        frame, level = frame.f_back, level + 1
    return level
