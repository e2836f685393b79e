"""Carriers: light along a path as Stokes vectors, matrix or Jones columns, or with an exponent.

Light carried as Jones columns is never polarized by more than 100 %, however long the path; but
S1 is a difference of intensities along x and y, and no matrix may depolarize.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import reduce
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.carriers.carried import (
    Carried,
    Components,
    add,
    along_axes,
    at_most_polarised,
    carry,
    leaving,
    light_of,
    parts_of,
    stokes_of,
)
from optipath.kernels.carriers.structures import Column, Columns
from optipath.kernels.primitives import products

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.kernels.carriers.carried import Parts, SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.kernel import Kernel
    from optipath.kernels.primitives import Primitives


class Carrier(ABC):
    """How light is carried: as a state, which nobody but the carrier looks into."""

    def __init__(self, xp: Primitives) -> None:
        self.xp = xp

    def made_for(self, xp: Primitives) -> Carrier:
        """Return the same carrier for other primitives."""
        return type(self)(xp)

    def evaluated(self, kernel: Kernel, arguments: Sequence[Any]) -> Numbers:
        """Return the numbers that a kernel makes of its arguments."""
        return kernel.made_for(self.xp)(*arguments)

    @abstractmethod
    def emit(self, stokes: Components, count: int = 4) -> Any:
        """Return the state of emitted light."""

    @abstractmethod
    def act(self, structure: Structure, numbers: Numbers, state: Any, count: int = 4) -> Any:
        """Return the state behind an element."""

    @abstractmethod
    def add(self, first: Any, second: Any) -> Any:
        """Return the state of two lights together, incoherently."""

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Any]) -> dict[int, Any]:
        """Return the states at the junctions of a loop; not every carrier goes through loops."""
        raise NotImplementedError(f"{type(self).__name__} carries no light through loops")

    @abstractmethod
    def read(self, state: Any, count: int = 4) -> tuple[Components, Any]:
        """Return the Stokes components, and the exponent of the power of two times them."""


class StokesCarrier(Carrier):
    """Carries light along short paths, whose light gathers few roundings and does not underflow."""

    def emit(self, stokes: Components, count: int = 4) -> Carried:
        return carry(self.xp, stokes, count)

    def act(
        self, structure: Structure, numbers: Numbers, state: Carried, count: int = 4
    ) -> Carried:
        return structure.action(self.xp, numbers, state, count)

    def add(self, first: Carried, second: Carried) -> Carried:
        return add(self.xp, first, second)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Carried]) -> dict[int, Carried]:
        parts = {k: parts_of(self.xp, state, solver.count(k)) for k, state in arriving.items()}
        return {k: light_of(self.xp, result) for k, result in solver.lights(parts).items()}

    def read(self, state: Carried, count: int = 4) -> tuple[Components, Any]:
        read = at_most_polarised(self.xp, leaving(self.xp, state, count))
        return stokes_of(self.xp, read), 0


class MatrixCarrier(Carrier):
    """Carries columns of Mueller matrices: every element is its matrix, and nothing else."""

    def emit(self, stokes: Components, _: int = 4) -> Components:
        return stokes

    def act(
        self, structure: Structure, numbers: Numbers, state: Components, _: int = 4
    ) -> Components:
        rows = structure.rows(self.xp, numbers)
        # Entries that a shape of matrix never has are plain zeros.
        first, second, third, fourth = (products(*zip(row, state, strict=True)) for row in rows)
        return first, second, third, fourth

    def add(self, first: Components, second: Components) -> Components:
        s0, s1, s2, s3 = (one + other for one, other in zip(first, second, strict=True))
        return s0, s1, s2, s3

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Components]) -> dict[int, Components]:
        parts = {junction: _parts(s, solver.count(junction)) for junction, s in arriving.items()}
        return {junction: _whole(result) for junction, result in solver.lights(parts).items()}

    def read(self, state: Components, _: int = 4) -> tuple[Components, Any]:
        return state, 0


def _parts(state: Components, count: int) -> Parts:
    s0, s1, s2, s3 = state
    return (s0,) if count == 1 else (0.5 * (s0 + s1), 0.5 * (s0 - s1), s2, s3)[:count]


def _whole(parts: Parts) -> Components:
    if len(parts) == 1:
        return parts[0], 0.0, 0.0, 0.0
    x, y, s2, s3 = (*parts, 0.0, 0.0)[:4]
    return x + y, x - y, s2, s3


JonesState: TypeAlias = tuple[Columns, Any]
"""The fields are the first times two to the power of the second."""


class JonesCarrier(Carrier):
    """Carries light as two Jones columns, with an integer exponent."""

    def emit(self, stokes: Components, _: int = 4) -> JonesState:
        return self._resolved(_columns(self.xp, carry(self.xp, stokes)), 0)

    def act(
        self, structure: Structure, numbers: Numbers, state: JonesState, _: int = 4
    ) -> JonesState:
        columns, exponent = state
        assert structure.jones is not None  # noqa: S101 - the composer refuses what may depolarise
        return self._resolved(structure.jones(self.xp, numbers, columns), exponent)

    def add(self, first: JonesState, second: JonesState) -> JonesState:
        lights = self._carried(first), self._carried(second)
        carried, exponent = ScaledCarrier(self.xp).add(*lights)
        # Fields have half the exponent of intensities, which is made even.
        odd = exponent % 2
        carried = tuple(self.xp.ldexp(component, odd) for component in carried)
        return self._resolved(_columns(self.xp, carried), (exponent - odd) // 2)

    def read(self, state: JonesState, _: int = 4) -> tuple[Components, Any]:
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


_DARK = -(2**30)
"""An exponent below those of all light, of the size of integers that scaling gives."""

ScaledState: TypeAlias = tuple[Carried, Any]
"""The light is the first times two to the power of the second."""


class ScaledCarrier(Carrier):
    """Carries light along long paths.

    After every element the light is scaled to near 1 by an integer power of two, and DoP rounded
    beyond 1 is reset.
    """

    def emit(self, stokes: Components, count: int = 4) -> ScaledState:
        return self._resolved(carry(self.xp, stokes, count), 0)

    def act(
        self, structure: Structure, numbers: Numbers, state: ScaledState, count: int = 4
    ) -> ScaledState:
        carried, exponent = state
        return self._resolved(structure.action(self.xp, numbers, carried, count), exponent)

    def add(self, first: ScaledState, second: ScaledState) -> ScaledState:
        (light, exponent), (other, of_other) = first, second
        # Dark light has no exponent of its own.
        exponent = self.xp.where(_size(self.xp, light) > 0.0, exponent, of_other)
        of_other = self.xp.where(_size(self.xp, other) > 0.0, of_other, exponent)
        most = self.xp.maximum(exponent, of_other)
        light = _times_two_to(self.xp, light, exponent - most)
        other = _times_two_to(self.xp, other, of_other - most)
        return self._resolved(add(self.xp, light, other), most)

    def meet(
        self, solver: SolvedLoop, arriving: Mapping[int, ScaledState]
    ) -> dict[int, ScaledState]:
        where, states = self.xp.where, arriving.values()
        lit = [where(_size(self.xp, light) > 0.0, exponent, _DARK) for light, exponent in states]
        most = reduce(self.xp.maximum, lit)
        most = where(most > _DARK, most, 0)
        parts = {}
        for junction, (carried, exponent) in arriving.items():
            light = _times_two_to(self.xp, carried, exponent - most)
            parts[junction] = parts_of(self.xp, light, solver.count(junction))
        lights = solver.lights(parts).items()
        return {k: self._resolved(light_of(self.xp, result), most) for k, result in lights}

    def read(self, state: ScaledState, count: int = 4) -> tuple[Components, Any]:
        carried, exponent = state
        return stokes_of(self.xp, leaving(self.xp, carried, count)), exponent

    def _resolved(self, carried: Carried, exponent: Any) -> ScaledState:
        carried = at_most_polarised(self.xp, carried)
        shift = self.xp.scaling(_size(self.xp, carried))
        return _times_two_to(self.xp, carried, -shift), exponent + shift


def _size(xp: Primitives, carried: Carried) -> Any:
    return reduce(xp.maximum, map(xp.absolute, carried))


def _times_two_to(xp: Primitives, carried: Carried, power: Any) -> Any:
    return tuple(xp.ldexp(component, power) for component in carried)
