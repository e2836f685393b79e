"""Light carried with an integer exponent, so that nothing underflows on a path of any length."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.kernels.carriers.carried import (
    Carried,
    Components,
    add,
    at_most_polarised,
    carry,
    leaving,
    light_of,
    parts_of,
    stokes_of,
)
from optipath.kernels.carriers.carrier import Carrier

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.kernels.carriers.carried import SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.primitives import Primitives


_DARK = -(2**30)
"""An exponent below those of all light, of the size of integers that scaling gives."""

ScaledState: TypeAlias = tuple[Carried, Any]
"""The light is the first times two to the power of the second."""


class ScaledCarrier(Carrier):
    """Carries light along long paths.

    After every element the light is brought near 1 and its power of two is kept as an
    integer; and what rounding has polarised beyond 100 % is taken back, lest it
    gathers over thousands of elements.

    >>> from optipath.kernels.carriers.structures import SCALE
    >>> from optipath.kernels.primitives import FLOAT
    >>> carrier = ScaledCarrier(FLOAT)
    >>> state = carrier.emit((1.0, 0.0, 0.0, 0.0))
    >>> for _ in range(4):
    ...     state = carrier.act(SCALE, (1e-300,), state)
    >>> _, exponent = carrier.read(state)
    >>> exponent
    -3987
    """

    def emit(self, stokes: Components, count: int = 4) -> ScaledState:
        return self._resolved(carry(self.xp, stokes, count), 0)

    def act(
        self, structure: Structure, numbers: Numbers, state: ScaledState, count: int = 4
    ) -> ScaledState:
        carried, exponent = state
        return self._resolved(structure.made_for(self.xp)(numbers, carried, count), exponent)

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
        most = reduce(self.xp.maximum, (self._exponent(state) for state in arriving.values()))
        most = self.xp.where(most > _DARK, most, 0)
        parts = {}
        for junction, (carried, exponent) in arriving.items():
            light = _times_two_to(self.xp, carried, exponent - most)
            parts[junction] = parts_of(self.xp, light, solver.count(junction))
        lights = solver.lights(parts).items()
        return {k: self._resolved(light_of(self.xp, result), most) for k, result in lights}

    def _exponent(self, state: ScaledState) -> Any:
        """Return the exponent of light, below all others where it is dark."""
        carried, exponent = state
        return self.xp.where(_size(self.xp, carried) > 0.0, exponent, _DARK)

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
