"""Columns of a matrix on their way along a path: no light that can be, each component by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.numbers.vanishing import products

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import Components
    from optipath.kernels.carriers.parted import Parts, SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure


class MatrixCarrier(Carrier):
    """Carries columns of Mueller matrices: every element is its matrix, and nothing else.

    Examples
    --------
    >>> from optipath.kernels.carriers.structures import BLOCK
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> carrier = MatrixCarrier(FLOAT)
    >>> carrier.act(BLOCK, (0.5, 0.25, 0.125, 0.0, 0.0), carrier.emit((0.0, 1.0, 0.0, 0.0)))
    (0.125, 0.375, 0.0, 0.0)
    """

    def emit(self, stokes: Components, count: int = 4) -> Components:
        del count  # All four, whatever is asked for.
        return stokes

    def act(
        self, structure: Structure, numbers: Numbers, state: Components, count: int = 4
    ) -> Components:
        del count
        rows = structure.rows(self.xp, numbers)
        # Entries that a shape of matrix never has are plain zeros.
        first, second, third, fourth = (products(*zip(row, state, strict=True)) for row in rows)
        return first, second, third, fourth

    def add(self, first: Components, second: Components) -> Components:
        s0, s1, s2, s3 = (one + other for one, other in zip(first, second, strict=True))
        return s0, s1, s2, s3

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Components]) -> dict[int, Components]:
        parts = {junction: _parts(s, solver.count(junction)) for junction, s in arriving.items()}
        return {junction: _whole(found) for junction, found in solver.lights(parts).items()}

    def read(self, state: Components, count: int = 4) -> tuple[Components, Any]:
        del count
        return state, 0


def _parts(state: Components, count: int) -> Parts:
    s0, s1, s2, s3 = state
    return (s0,) if count == 1 else (0.5 * (s0 + s1), 0.5 * (s0 - s1), s2, s3)[:count]


def _whole(parts: Parts) -> Components:
    if len(parts) == 1:
        return parts[0], 0.0, 0.0, 0.0
    x, y, s2, s3 = (*parts, 0.0, 0.0)[:4]
    return x + y, x - y, s2, s3
