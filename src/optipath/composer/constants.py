"""Constants: steps whose numbers are all known, multiplied before a plan runs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from optipath.kernels.carriers.structures import BLOCK, DEPOLARIZING_BLOCK, FULL, ROTATION, SCALE
from optipath.kernels.catalogue import (
    ATTENUATOR,
    CONSTANT_BLOCK,
    CONSTANT_DEPOLARIZING_BLOCK,
    GIVEN_TURN,
    MATRIX,
)
from optipath.kernels.numbers.primitives import FLOAT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.kernels.carriers.kernel import Kernel
    from optipath.kernels.carriers.structures import Structure

_KERNELS = {
    "scale": ATTENUATOR,
    "rotation": GIVEN_TURN,
    "full": MATRIX,
    BLOCK.name: CONSTANT_BLOCK,
    DEPOLARIZING_BLOCK.name: CONSTANT_DEPOLARIZING_BLOCK,
}
_COSTS = {"scale": 4, "rotation": 16, BLOCK.name: 14, DEPOLARIZING_BLOCK.name: 14, "full": 34}
_EXTINCT = 0.01
"""Where less than this share of some light passes, a product of matrices may lose its digits."""

_LEAST = 1e-60


class Constant(NamedTuple):
    """The numbers of a step, as its structure has them."""

    structure: Structure
    numbers: tuple[float, ...]

    @property
    def kernel(self) -> Kernel:
        """The kernel that is given these numbers."""
        return _KERNELS[self.structure.name]

    @property
    def cost(self) -> int:
        """About how many operations it takes."""
        return _COSTS[self.structure.name]

    @property
    def is_identity(self) -> bool:
        """Whether it leaves every light as it is."""
        return tuple(self.numbers) == self.structure.identity

    @property
    def lets_through(self) -> bool:
        """Whether no light is nearly extinguished by it."""
        first = self._rows()[0]
        return first[0] - math.hypot(*first[1:]) > _EXTINCT * first[0]

    def _rows(self) -> Sequence[tuple[float, ...]]:
        return self.structure.rows(FLOAT, self.numbers)

    def as_full(self) -> Constant:
        """Return the same with all sixteen entries."""
        return Constant(FULL, tuple(float(entry) for row in self._rows() for entry in row))

    def then(self, later: Constant) -> Constant | None:
        """Return both as one of the same sort, no digit lost; None where they have none.

        Examples
        --------
        >>> Constant(SCALE, (0.5,)).then(Constant(SCALE, (0.5,))).numbers
        (0.25,)
        """
        sorts = self.structure, later.structure
        if sorts == (ROTATION, ROTATION):
            (c1, s1), (c2, s2) = self.numbers, later.numbers
            return Constant(ROTATION, (c1 * c2 - s1 * s2, s1 * c2 + c1 * s2))
        if sorts == (BLOCK, BLOCK):
            return _kept(Constant(BLOCK, _blocks(self.numbers, later.numbers)))
        for one, other in ((self, later), (later, self)):
            if one.structure == SCALE and other.structure != ROTATION:
                t = one.numbers[0]
                product = tuple(t * number for number in other.numbers)
                return _kept(Constant(other.structure, product))
        return None


def multiplied(first: Constant, second: Constant) -> Constant | None:
    """Return two constants in the order of travel as one matrix; None if it is too faint."""
    one, other = first.as_full().numbers, second.as_full().numbers
    rows, columns = [other[i : i + 4] for i in (0, 4, 8, 12)], [one[i::4] for i in range(4)]
    product = tuple(a * e + b * f + c * g + d * h for a, b, c, d in rows for e, f, g, h in columns)
    found = _kept(Constant(FULL, product))
    return found if found and found.lets_through else None


def _kept(product: Constant) -> Constant | None:
    """Return a product unless its intensity is so faint, or so large, that it might get lost."""
    first = product.structure.rows(FLOAT, product.numbers)[0][0]
    return product if _LEAST < first < 1.0 / _LEAST else None


def _blocks(first: tuple[float, ...], second: tuple[float, ...]) -> tuple[float, ...]:
    Fs1, Fp1, B1, C1, S1 = first
    Fs2, Fp2, B2, C2, S2 = second
    B = 0.5 * (B1 * (Fs2 + Fp2) + B2 * (Fs1 + Fp1))
    return Fs1 * Fs2, Fp1 * Fp2, B, C1 * C2 - S1 * S2, C1 * S2 + S1 * C2
