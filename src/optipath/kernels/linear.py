"""Columns of a matrix on their way along a path: no light that can be, each component by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

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

    def emit(self, stokes: Components) -> Components:
        """Return the state of what is emitted."""
        return stokes

    def act(self, structure: Structure, numbers: Numbers, state: Components) -> Components:
        """Return the state behind an element."""
        rows = structure.rows(self.xp, numbers)
        first, second, third, fourth = (_product(row, state) for row in rows)
        return first, second, third, fourth

    def add(self, first: Components, second: Components) -> Components:
        """Return the state of two together."""
        s0, s1, s2, s3 = (one + other for one, other in zip(first, second, strict=True))
        return s0, s1, s2, s3

    def read(self, state: Components) -> tuple[Components, Any]:
        """Return the components, and the exponent of the power of two times them."""
        return state, 0


def _product(row: Components, state: Components) -> Any:
    # Entries that a shape of matrix never has are plain zeros.
    terms = [m * s for m, s in zip(row, state, strict=True) if type(m) is not float or m]
    return sum(terms[1:], start=terms[0]) if terms else 0.0 * state[0]
