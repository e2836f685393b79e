"""The values of a path in many digits, one member of a batch at a time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.lab.accuracy.many_digits import cos_sin, exact_angle, exactly, mpmath
from optipath.values.materials import Material
from optipath.values.operands import Operand, operand_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.resolved import Resolved


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
        """Return an angle; its tangent, or that of `turns` times it, is what may be moved.

        Units: value, the result in radians.
        """
        return self.move(
            exact_angle(float(self.pick(operand_of(value).numbers(self.given)))), turns
        )

    def angle_along(self, per_length: Any, length: Any, turns: int = 1) -> Any:
        """Return an angle that grows with a length, both given; else as `angle`.

        Units: per_length, the result in radians; length in metres.
        """
        return self.near_multiple(self.real(per_length) * self.real(length), turns)

    def near_multiple(self, angle: Any, turns: int = 1) -> Any:
        """Return an angle that is a product; a multiple of 45 degrees is one exactly.

        Units: angle, the result in radians.
        """
        nearest = exact_angle(float(angle))
        # A multiple of 45 degrees is one, however its factors are rounded.
        return self.move(nearest if nearest != float(angle) else angle, turns)

    def exact(self, operand: Operand) -> Any:
        """Return a number, or the cosine or sine of an angle in many digits."""
        if operand.part not in ("cos", "sin"):
            return self.real(operand)
        angle = float(self.pick(Operand(operand.value).numbers(self.given)))
        return cos_sin(exact_angle(angle))[operand.part == "sin"]

    def move(self, angle: Any, turns: int) -> Any:
        """Return an angle, moved if it is the one.

        Units: angle, the result in radians.
        """
        self.count += 1
        if self.count - 1 != self.moved:
            return angle
        return angle + self.by * mpmath.sin(2 * turns * angle) / (2 * turns)
