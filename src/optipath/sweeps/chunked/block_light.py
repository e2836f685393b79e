"""The light of one block of a sweep, as it goes from task to task."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.running.pieces import pieces
from optipath.sweeps.labels.variable_names import detectors_of
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.axes.sweep_grid import SweepGrid
    from optipath.sweeps.chunked.plan_recipe import PlanRecipe
    from optipath.sweeps.labels.light_quantities import LightQuantity

_AT_ONCE = 1 << 18
"""How many points are run at a time: what is made on the way stays small, and in the cache."""


@dataclass(frozen=True)
class BlockLight:
    """The light of all detectors, for the points of one block.

    Examples
    --------
    >>> import optipath as op
    >>> from optipath.sweeps.labels.light_quantities import COMPONENTS
    >>> lights = op.Light([1.0, 0.0, 0.0, 0.0]), op.Light([2.0, 0.0, 0.0, 0.0])
    >>> block = BlockLight((2, 1), (lights,))
    >>> block.of(COMPONENTS[0])
    array([[1.],
           [2.]])
    """

    shape: tuple[int, ...]
    lights: tuple[tuple[Light, ...], ...]
    ran: tuple[int, ...] | None = None

    def of(self, quantity: LightQuantity) -> npt.NDArray[Any]:
        """Return the numbers of a quantity; of several detectors, along the first axis.

        They are a copy: a view would keep the light alive for as long as anybody has it.
        """
        numbers = [
            np.concatenate([np.ravel(quantity.of(light)) for light in several])
            for several in self.lights
        ]
        front = (len(numbers),) if len(numbers) > 1 else ()
        found = np.concatenate(numbers).reshape(*front, *(self.ran or self.shape))
        return found if self.ran is None else np.broadcast_to(found, (*front, *self.shape))

    def __sizeof__(self) -> int:
        # What Dask takes for its memory: Stokes vectors and, once it is asked for, their noise.
        return sum(light.mantissa.nbytes for several in self.lights for light in several) * 2


def run_block(recipe: PlanRecipe, block: SweepGrid) -> BlockLight:
    """Return the light of a block."""
    plan, varied = recipe.plan, block.varied
    with units_are_written():  # Who reads the axes has told of degrees among them.
        found = [
            plan.run_all(**varied.given(_region(piece.where, varied.shape)))
            for piece in pieces(varied.shape, _AT_ONCE)
        ]
    lights = [tuple([light[name] for light in found]) for name in detectors_of(plan)]
    return BlockLight(block.shape, tuple(lights), None if varied is block else varied.shape)


def _region(where: tuple[int | slice, ...], shape: tuple[int, ...]) -> list[slice]:
    """Return an index as a slice for each dimension."""
    told = [each if isinstance(each, slice) else slice(each, each + 1) for each in where]
    return told + [slice(None)] * (len(shape) - len(told))
