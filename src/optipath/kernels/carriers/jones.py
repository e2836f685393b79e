"""Light carried as two Jones columns: two fully polarised lights that add incoherently.

What comes out is never polarised by more than 100 %, however long the path; but S1 is the
difference of the intensities along x and y, and a matrix that depolarises has no place here.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.carriers.carried import (
    Carried,
    Components,
    along_axes,
    at_most_polarised,
    carry,
    stokes_of,
)
from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.carriers.scaled import ScaledCarrier
from optipath.kernels.carriers.structures import Column, Columns

if TYPE_CHECKING:
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.primitives import Primitives


JonesState: TypeAlias = tuple[Columns, Any]
"""The fields are the first times two to the power of the second."""


class JonesCarrier(Carrier):
    """Carries light as two Jones columns, with an integer exponent.

    >>> from optipath.kernels.carriers.structures import SCALE
    >>> from optipath.kernels.primitives import FLOAT
    >>> carrier = JonesCarrier(FLOAT)
    >>> light = carrier.act(SCALE, (0.25,), carrier.emit((1.0, 0.0, 0.0, 1.0)))
    >>> stokes, exponent = carrier.read(light)
    >>> [round(x * 2.0**exponent, 12) for x in stokes]
    [0.25, 0.0, 0.0, 0.25]
    """

    def __init__(self, xp: Primitives) -> None:
        super().__init__(xp)
        self._incoherent = ScaledCarrier(xp)

    def emit(self, stokes: Components, count: int = 4) -> JonesState:
        del count  # A column is carried whole.
        return self._resolved(_columns(self.xp, carry(self.xp, stokes)), 0)

    def act(
        self, structure: Structure, numbers: Numbers, state: JonesState, count: int = 4
    ) -> JonesState:
        del count
        columns, exponent = state
        return self._resolved(structure.jones_for(self.xp)(numbers, columns), exponent)

    def add(self, first: JonesState, second: JonesState) -> JonesState:
        carried, exponent = self._incoherent.add(self._carried(first), self._carried(second))
        # Fields have half the exponent of intensities, which is made even.
        odd = exponent % 2
        carried = tuple(self.xp.ldexp(component, odd) for component in carried)
        return self._resolved(_columns(self.xp, carried), (exponent - odd) // 2)

    def read(self, state: JonesState, count: int = 4) -> tuple[Components, Any]:
        del count
        carried, exponent = self._carried(state)
        return stokes_of(self.xp, carried), exponent

    def _carried(self, state: JonesState) -> tuple[Carried, Any]:
        columns, exponent = state
        x, y, s2, s3 = (sum(parts) for parts in zip(*map(_pure, columns), strict=True))
        carried = self.xp.minimum(x, y), x - y, s2, s3
        return at_most_polarised(self.xp, carried), 2 * exponent

    def _resolved(self, columns: Columns, exponent: Any) -> JonesState:
        xp = self.xp
        size = reduce(xp.maximum, (xp.absolute(part) for column in columns for part in column))
        shift = xp.scaling(size)
        first, second = (tuple(xp.ldexp(part, -shift) for part in column) for column in columns)
        return (first, second), exponent + shift


def _pure(column: Column) -> tuple[Any, ...]:
    """Return the intensities along x and y, and S2 and S3, of one column."""
    a, b, c, d = column
    return a * a + b * b, c * c + d * d, 2.0 * (a * c + b * d), 2.0 * (a * d - b * c)


def _columns(xp: Primitives, carried: Carried) -> Columns:
    """Return the columns of a light: the Cholesky factor of its coherency matrix."""
    sqrt, where = xp.sqrt, xp.where
    x, y = along_axes(xp, carried)
    _, _, s2, s3 = carried
    re, im = 0.5 * s2, 0.5 * s3
    along_x = x >= y
    strong = sqrt(where(along_x, x, y))
    divisor = where(strong > 0.0, strong, 1.0)
    re, im = re / divisor, im / divisor
    rest = sqrt(xp.maximum(where(along_x, y, x) - (re * re + im * im), 0.0))
    first = (
        where(along_x, strong, re),
        where(along_x, 0.0, -im),
        where(along_x, re, strong),
        where(along_x, im, 0.0),
    )
    # Not a plain 0, which has no precision of its own.
    none = 0.0 * rest
    return first, (where(along_x, none, rest), none, where(along_x, rest, none), none)
