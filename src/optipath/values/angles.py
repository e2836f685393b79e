"""Angles: cosine and sine pairs, and warnings of degrees given for radians."""

from __future__ import annotations

import inspect
import math
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import AngleWarning, OptipathError, ParameterError, UnitError
from optipath.faults import Cure, shown
from optipath.values.arrays import (
    MOST_AXES,
    ComparedByFields,
    Unchanging,
    as_argument,
    broadcast_fault,
    joint_shape,
    numbers_for,
    refuse_too_large,
)
from optipath.values.jax_values import is_jax, is_traced, namespace
from optipath.values.precision import as_doubles, doubles, real_number, rounding_of
from optipath.values.units import dimension_of, format_quantity, in_unit, parse_quantity, unit_of

if TYPE_CHECKING:
    from collections.abc import Callable


_APART = 1e-6
_ANGLE = 8
"""How many bytes an angle has."""


@dataclass(frozen=True, eq=False, repr=False)
class CosSin(Unchanging, ComparedByFields):
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

    cos: Any
    sin: Any = None

    def __post_init__(self) -> None:
        if self.sin is None:
            what = f"CosSin takes a cosine and a sine, not {shown(self.cos)} alone"
            raise ParameterError(f"{what}; give an angle itself")
        cos, sin = _numbers("cos", self.cos), _numbers("sin", self.sin)
        ParameterError.raise_for(broadcast_fault({"cos": np.shape(cos), "sin": np.shape(sin)}))
        refuse_too_large(joint_shape(np.shape(cos), np.shape(sin)), _ANGLE, error=ParameterError)
        vars(self).update(cos=within_right_angle(cos, sin), sin=sin)

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
                f"cosine and sine of {what} belong to no angle; divide both by hypot(cos, sin)"
            )

    def __repr__(self) -> str:
        return f"CosSin({self.cos!r}, {self.sin!r})"


def within_right_angle(cos: Any, sin: Any) -> Any:
    """Return cosines; 0 where the angle is beyond a right one by the rounding of float32."""
    kind = getattr(cos, "dtype", np.dtype(np.float64))
    if kind != np.float32 or is_jax(cos) or is_jax(sin) or not np.any(cos < 0.0):
        return cos
    right = np.abs(np.arctan2(sin, cos)) == np.float32(np.pi / 2.0)
    return np.where((cos < 0.0) & right, np.float32(0.0), cos)


def is_angle(cos: Any, sin: Any) -> bool:
    """Tell whether cosines and sines belong to angles, to the rounding in which they are given."""
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
    return array if array.dtype == np.float32 else doubles(array)


def _pure(text: str) -> Any:
    """Return the number that a text stands for, which is a cosine or a sine, and no angle."""
    if unit_of(text):
        raise UnitError(
            f"'{text}' has a unit, but cosines and sines are pure numbers; give the angle itself"
        )
    return parse_quantity(text, "")


TURN = 2.0 * math.pi * (1.0 + 1e-6)
"""Up to what size an angle is taken for one in radians: a whole turn, however it is rounded."""

_RADIANS = "; plain numbers are in radians, write degrees as '48 deg'"

_LOOKED_AT = 1000
"""At how many numbers of an array one looks; degrees are seen in any of them."""


def warn_of_degrees(what: str, value: Any, place: Callable[[Any], Any] | None = None) -> None:
    """Warn of plain numbers beyond a whole turn that make angles beyond a turn, too.

    The sentence is the same for all values, so that Python shows it once a line.
    """
    is_small = type(value) is float and (-TURN <= value <= TURN or math.isinf(value))
    if is_small or isinstance(value, str):
        return
    numbers = _plain_numbers(value)
    beyond = np.abs(numbers) > TURN
    if place is not None:
        beyond &= np.abs(place(numbers)) > TURN
    if np.any(beyond & np.isfinite(numbers)):
        warn(
            f"{what} is a plain number beyond 2 pi, in radians; write degrees as '48 deg', and "
            f"radians as '48 rad'",
            AngleWarning,
        )


def refused(number: float, unit: str, limits: tuple[float, float]) -> tuple[str, str]:
    """Return a number beyond its limits as a text, and what was meant; mostly nothing.

    >>> refused(48.0, "deg", (0.0, 1.6))
    ('48 rad', "; plain numbers are in radians, write degrees as '48 deg'")
    """
    dimension = dimension_of(unit)
    hint = _RADIANS if dimension == "angle" and abs(number) > TURN else ""
    unit = "rad" if hint else unit
    short = f"{in_unit(number, unit):.6g} {unit}".strip()
    # Six digits may say a number that is allowed.
    is_allowed = limits[0] <= parse_quantity(short, dimension).real <= limits[1]
    return format_quantity(number, unit) if is_allowed else short, hint


def range_cure(wanted: str, hint: str) -> Cure:
    """Return the cure of a refused number; texts at the command line are in no radians."""
    usual = f"give {wanted}" + ("" if hint == _RADIANS else hint)
    return Cure(f"give {wanted}{hint}", command=usual, page=usual)


def _plain_numbers(value: Any) -> Any:
    """Return the numbers in a value that are no texts; of a long array about a thousand."""
    if value is None or isinstance(value, str) or is_traced(value):
        return np.empty(0)
    try:
        array = as_argument("", value)
    except OptipathError:
        return np.empty(0)  # For validation to name.
    if array.dtype.kind not in "iufO" or array.ndim > MOST_AXES:
        return np.empty(0)
    numbers = array.flat[:: 1 + array.size // _LOOKED_AT]
    if array.dtype.kind == "O":
        known = (real_number(number) for number in numbers)
        numbers = np.array([number for number in known if number is not None], np.float64)
    return as_doubles(numbers)


_PASSED = ("optipath", "dataclasses", "functools")


def warn(sentence: str, category: type[Warning]) -> None:
    """Warn where the library was called."""
    level = 1
    frame: Any = inspect.currentframe()
    while frame.f_back is not None and (
        frame.f_globals.get("__name__", "").partition(".")[0] in _PASSED
        # The makers of dataclasses and own elements are made of texts.
        or frame.f_code.co_filename.startswith("<")
    ):
        frame, level = frame.f_back, level + 1
    warnings.warn(sentence, category, stacklevel=level)
