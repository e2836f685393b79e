"""Numbers of many digits: mpmath, exact floats, and the values of a path in them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.extras import needing
from optipath.kernels.primitives import Primitives
from optipath.materials.material import Material
from optipath.values.operands import Operand, operand_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.parameters import Resolved

with needing("50-digit references"):
    import mpmath as mpmath  # noqa: PLC0414 - for the other references

DIGITS = 50
WORKING_DIGITS = 2 * DIGITS
_HUGE = 1e9


def exactly(number: Any) -> Any:
    """Return a float of any precision as a number of many digits.

    >>> with mpmath.workdps(30):
    ...     print(exactly(np.float64(0.1)))
    0.100000000000000005551115123126
    """
    if np.isinf(number):
        return mpmath.mpf(float(number))
    mantissa, exponent = np.frexp(number)
    high = float(mantissa)
    rest = float(mantissa - type(mantissa)(high))
    return mpmath.ldexp(mpmath.mpf(high) + mpmath.mpf(rest), int(exponent))


def exact_angle(angle: float) -> Any:
    """Return an angle; the float nearest to a multiple of 45 degrees is that multiple.

    >>> with mpmath.workdps(WORKING_DIGITS):
    ...     bool(abs(mpmath.cos(exact_angle(np.pi / 2))) < 1e-99)
    True
    """
    eighth = +mpmath.pi / 4
    multiple = mpmath.nint(mpmath.mpf(angle) / eighth) * eighth
    # Of angles so huge that their rounding is a turn, every one is nearest to some multiple.
    near = float(multiple) == angle and abs(angle) < _HUGE
    return multiple if near else mpmath.mpf(angle)


def cos_sin(angle: Any) -> tuple[Any, Any]:
    """Return the cosine and the sine; what is less than the working precision is 0.

    >>> cos_sin(exact_angle(np.pi / 2))
    (mpf('0.0'), mpf('1.0'))
    """
    least = mpmath.mpf(10) ** -(mpmath.mp.dps - 5)
    c, s = mpmath.cos(angle), mpmath.sin(angle)
    if abs(c) < least:
        return mpmath.mpf(0), mpmath.sign(s)
    return (mpmath.sign(c), mpmath.mpf(0)) if abs(s) < least else (c, s)


_OF_ONE_NAME = ("sqrt", "sin", "cos", "exp", "atan2", "ldexp")

MANY_DIGITS = Primitives(
    **{name: getattr(mpmath, name) for name in _OF_ONE_NAME},
    where=lambda condition, yes, no: yes if condition else no,
    absolute=abs,
    scaling=lambda number: mpmath.frexp(number)[1],
    maximum=max,
    minimum=min,
    two_product=lambda a, b: (a * b, mpmath.mpf(0)),
    below_rounding=lambda larger, number: float(larger) + float(number) == float(larger),
    fixed=lambda value: value,
)
"""For elements of one's own, whose formulas are the only ones there are."""


@dataclass
class Reader:
    """Reads the values of a path as numbers of many digits, and moves one angle a little."""

    given: Mapping[str, Resolved]
    batch: tuple[int, ...]
    at: tuple[int, ...]
    moved: int = -1
    by: Any = 0
    count: int = field(default=0, init=False)
    decades: int = field(default=0, init=False)

    def pick(self, numbers: Any) -> Any:
        """Return that one of the batch."""
        return np.broadcast_to(numbers, self.batch)[self.at]

    def real(self, value: Any, part: str = "") -> Any:
        """Return a number."""
        operand = Operand(value, part) if part else operand_of(value)
        number = exactly(self.pick(operand.numbers(self.given)))
        self.decades += abs(int(mpmath.log10(number))) if 0 < number < mpmath.inf else 0
        return number

    def index(self, value: Any) -> Any:
        """Return an index of refraction."""
        if isinstance(value, Material):
            return mpmath.mpc(self.real(value.n), self.real(value.k))
        return self.complex(value)

    def complex(self, value: Any) -> Any:
        """Return a complex number."""
        return mpmath.mpc(self.real(value, "real"), self.real(value, "imag"))

    def angle(self, value: Any, turns: int = 1) -> Any:
        """Return an angle in rad; its tangent, or that of `turns` times it, may be moved."""
        number = self.pick(operand_of(value).numbers(self.given))
        return self.move(exact_angle(float(number)), turns)

    def angle_along(self, per_length: Any, length: Any, turns: int = 1) -> Any:
        """Return an angle that grows with a length in metres, both given; else as `angle`."""
        return self.near_multiple(self.real(per_length) * self.real(length), turns)

    def near_multiple(self, angle: Any, turns: int = 1) -> Any:
        """Return an angle in rad that is a product; a multiple of 45 degrees is one exactly."""
        nearest = exact_angle(float(angle))
        return self.move(nearest if nearest != float(angle) else angle, turns)

    def exact(self, operand: Operand) -> Any:
        """Return a number, or the cosine or sine of an angle in many digits."""
        if operand.part not in ("cos", "sin"):
            return self.real(operand)
        angle = float(self.pick(Operand(operand.value).numbers(self.given)))
        return cos_sin(exact_angle(angle))[operand.part == "sin"]

    def move(self, angle: Any, turns: int) -> Any:
        """Return an angle, moved if it is the one. Units: angle, the result in radians."""
        self.count += 1
        if self.count - 1 != self.moved:
            return angle
        return angle + self.by * mpmath.sin(2 * turns * angle) / (2 * turns)
