"""Input keys: which number is given for a parameter, before anything is done to it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.values.multiples import affine

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping


class InputKey(NamedTuple):
    """A number that is given for a parameter, before anything is done to it."""

    name: str
    part: str | int = "value"
    scale: float = 1.0
    offset: float = 0.0

    def __str__(self) -> str:
        plain = f"{self.name} {self.part}"
        return f"{self.scale} * {plain} + {self.offset}" if self.is_affine else plain

    @property
    def is_affine(self) -> bool:
        """Whether it is a multiple of what is given, or has an offset."""
        return self.scale != 1.0 or self.offset != 0.0

    @property
    def quantity(self) -> Hashable:
        """What it is a part of: the parameter by its name, or a multiple of it with an offset."""
        return (self.name, self.scale, self.offset) if self.is_affine else self.name

    def limits_in(self, ranges: Mapping[Hashable, tuple[float, float]]) -> tuple[float, float]:
        """Return its least and its largest number, for the ranges of quantities."""
        low, high = ranges[self.quantity]
        # An index that is never 0 absorbs nothing all the same.
        return (min(low, 0.0), high) if self.part == "imag" else (low, high)

    def placed(self, numbers: Any, limits: tuple[float, float]) -> Any:
        """Return numbers for it."""
        return affine(self.scale, self.offset, numbers, limits) if self.is_affine else numbers
