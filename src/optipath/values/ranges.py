"""Ranges: the least and the largest number of each quantity that is given."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.values.multiples import affine

if TYPE_CHECKING:
    from collections.abc import Hashable


class Ranges(dict["Hashable", "tuple[float, float]"]):
    """The ranges of quantities, by what `InputKey.quantity` says.

    A multiple that no element has as a value, as ``couplings()`` may make one of a field, has the
    range that follows from that of its parameter.

    Examples
    --------
    >>> Ranges({"f": (0.0, 1.0)})["f", -2.0, 1.0]
    (-1.0, 1.0)
    """

    def __missing__(self, quantity: tuple[str, float, float]) -> tuple[float, float]:
        name, scale, offset = quantity
        low, high = sorted(affine(scale, offset, end) for end in self[name])
        self[quantity] = low, high
        return low, high
