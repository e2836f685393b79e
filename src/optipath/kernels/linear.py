"""Columns of a matrix on their way along a path: no light that can be, each component by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.carried import products

if TYPE_CHECKING:
    from optipath.kernels.carried import Components
    from optipath.kernels.primitives import Primitives
    from optipath.kernels.structures import Numbers, Structure


class Linear:
    """The way for Mueller matrices: every element is its matrix, and nothing else.

    Examples
    --------
    >>> from optipath.kernels import BLOCK, FLOAT
    >>> way = Linear(FLOAT)
    >>> way.act(BLOCK, (0.5, 0.25, 0.125, 0.0, 0.0), way.emit((0.0, 1.0, 0.0, 0.0)))
    (0.125, 0.375, 0.0, 0.0)
    """

    def __init__(self, xp: Primitives) -> None:
        self.xp = xp

    def emit(self, stokes: Components, count: int = 4) -> Components:
        """Return the state of what is emitted; all four components, whatever is asked for."""
        del count
        return stokes

    def act(
        self, structure: Structure, numbers: Numbers, state: Components, count: int = 4
    ) -> Components:
        """Return the state behind an element."""
        del count
        rows = structure.rows(self.xp, numbers)
        # Entries that a shape of matrix never has are plain zeros.
        first, second, third, fourth = (products(*zip(row, state, strict=True)) for row in rows)
        return first, second, third, fourth

    def add(self, first: Components, second: Components) -> Components:
        """Return the state of two together."""
        s0, s1, s2, s3 = (one + other for one, other in zip(first, second, strict=True))
        return s0, s1, s2, s3

    def read(self, state: Components, count: int = 4) -> tuple[Components, Any]:
        """Return the components, and the exponent of the power of two times them."""
        del count
        return state, 0
