"""CosSin: an angle given by its cosine and its sine."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.errors import ParameterError, UnitError, shown
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_jax, is_traced, namespace
from optipath.values.arrays.memory import refuse_too_large
from optipath.values.arrays.read_only import Unchanging, same
from optipath.values.arrays.shapes import broadcast_fault, joint_shape
from optipath.values.roundings import doubles, rounding_of
from optipath.values.texts import numbers_for
from optipath.values.units import parse_quantity, unit_of

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

    Examples
    --------
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

    Examples
    --------
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
    array = as_given(name, value, ParameterError)
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
