"""Noise: how much of light that a path leaves may be no more than the rounding of what it took.

Light that is filtered later leaves its rounding behind: behind crossed polarizers there is nothing
else. A rounding is light of unknown polarization, so each element dims it by its mean, M00, and
adds its own. Where an element acts on the intensities along x and y by themselves, each has its own
rounding: what is weak from the start, as behind two gray filters or near Brewster's angle, keeps
its digits. At Brewster's angle itself the amplitude that is left is rounding, and its intensity the
square of it.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.carriers.carried import along_axes, stokes_of
from optipath.kernels.carriers.carrier import Carrier, ScaledCarrier
from optipath.kernels.carriers.structures import BLOCK, DEPOLARIZING_BLOCK, POWERS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import Components, SolvedLoop
    from optipath.kernels.carriers.carrier import ScaledState
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.primitives import Primitives


_OF_WAVES = BLOCK, DEPOLARIZING_BLOCK, POWERS
"""Where the amplitudes of waves are added up."""

_ROUNDINGS = 4.0
"""How many roundings each of them has."""


class Noisy(NamedTuple):
    """Light, and what of it may be rounding."""

    light: ScaledState
    x: Any
    y: Any


class NoiseCarrier(Carrier):
    """Carries light with its roundings; what is read is S0 and the noise."""

    def __init__(self, xp: Primitives, eps: float) -> None:
        super().__init__(xp)
        self.eps = eps
        self.inner = ScaledCarrier(xp)

    def emit(self, stokes: Components, count: int = 4) -> Noisy:
        light = self.inner.emit(stokes, count)
        return Noisy(light, *self._rounded(light))

    def act(self, structure: Structure, numbers: Numbers, state: Noisy, count: int = 4) -> Noisy:
        light = self.inner.act(structure, numbers, state.light, count)
        rows = structure.rows(self.xp, numbers)
        across = [entry for row in rows[:2] for entry in row[2:]]
        if all(isinstance(entry, float) and entry == 0.0 for entry in across):
            x, y = self._through(rows, state)
            if structure in _OF_WAVES:
                share = (_ROUNDINGS * self.eps) ** 2
                before_x, before_y = along_axes(self.xp, state.light[0])
                x, y = x + share * before_x, y + share * before_y
            x, y = self._moved((x, y), state.light, light)
            more_x, more_y = self._rounded(light)
            return Noisy(light, x + more_x, y + more_y)
        mean = self.xp.absolute(rows[0][0])
        half = 0.5 * mean * (state.x + state.y + self.eps * self._intensity(state.light))
        return Noisy(light, *self._moved((half, half), state.light, light))

    def add(self, first: Noisy, second: Noisy) -> Noisy:
        light = self.inner.add(first.light, second.light)
        x1, y1 = self._moved(first[1:], first.light, light)
        x2, y2 = self._moved(second[1:], second.light, light)
        more_x, more_y = self._rounded(light)
        return Noisy(light, x1 + x2 + more_x, y1 + y2 + more_y)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Noisy]) -> dict[int, Noisy]:
        result = self.inner.meet(solver, {k: state.light for k, state in arriving.items()})
        lit = [self._share(state) for state in arriving.values()]
        # Each unknown is a sum over all of them.
        share = reduce(self.xp.maximum, lit) + self.eps * sum(map(solver.count, result))
        brightest = reduce(self.inner.add, result.values())
        half = 0.5 * share * self._intensity(brightest)
        return {k: Noisy(s, *self._moved((half, half), brightest, s)) for k, s in result.items()}

    def read(self, state: Noisy, _: int = 4) -> tuple[Components, Any]:
        return (self._intensity(state.light), state.x + state.y, 0.0, 0.0), state.light[1]

    def _rounded(self, light: ScaledState) -> tuple[Any, Any]:
        x, y = along_axes(self.xp, light[0])
        return self.eps * x, self.eps * y

    def _through(self, rows: Any, state: Noisy) -> tuple[Any, Any]:
        """Return noise behind an element that acts along x and along y by themselves."""
        (a, b), (c, d) = rows[0][:2], rows[1][:2]
        size, x, y = self.xp.absolute, state.x, state.y
        along = size(a + b + c + d) * x + size(a - b + c - d) * y
        across = size(a + b - c - d) * x + size(a - b - c + d) * y
        return 0.5 * along, 0.5 * across

    def _moved(self, noise: Any, before: ScaledState, after: ScaledState) -> tuple[Any, Any]:
        """Return noise times the power of two of other light."""
        x, y = (self.xp.ldexp(part, before[1] - after[1]) for part in noise)
        return x, y

    def _intensity(self, light: ScaledState) -> Any:
        return stokes_of(self.xp, light[0])[0]

    def _share(self, state: Noisy) -> Any:
        intensity = self._intensity(state.light)
        there = intensity > 0.0
        return self.xp.where(there, (state.x + state.y) / self.xp.where(there, intensity, 1.0), 0.0)
