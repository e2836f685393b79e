"""The light of one block of a sweep, as it goes from task to task."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.variable_names import detectors_of
from optipath.values.written_units import units_are_written

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.light_quantities import LightQuantity
    from optipath.sweeps.plan_recipe import PlanRecipe
    from optipath.sweeps.sweep_grid import SweepGrid


@dataclass(frozen=True)
class BlockLight:
    """The light of all detectors, for the points of one block.

    Attributes
    ----------
    lights : tuple of Light
        In the order of the detectors.

    Examples
    --------
    >>> import optipath as op
    >>> from optipath.sweeps.light_quantities import COMPONENTS
    >>> block = BlockLight((op.Light([[1.0, 0.0, 0.0, 0.0]] * 2),))
    >>> block.of(COMPONENTS[0]), block.__sizeof__()
    (array([1., 1.]), 128)
    """

    lights: tuple[Light, ...]

    def of(self, quantity: LightQuantity) -> npt.NDArray[Any]:
        """Return the numbers of a quantity; of several detectors, along the first axis.

        They are a copy: a view would keep the light alive for as long as anybody has it.
        """
        if len(self.lights) == 1:
            return np.array(quantity.of(self.lights[0]))
        return np.stack([quantity.of(light) for light in self.lights])

    def __sizeof__(self) -> int:
        # What Dask takes for its memory: Stokes vectors and, once it is asked for, their noise.
        return sum(light.mantissa.nbytes for light in self.lights) * 2


def run_block(recipe: PlanRecipe, block: SweepGrid) -> BlockLight:
    """Return the light of a block.

    Parameters
    ----------
    recipe : PlanRecipe
        What is run; its plan is made once a process.
    block : SweepGrid
        The part of a sweep that the block is.

    Returns
    -------
    BlockLight
    """
    plan, given = recipe.plan, block.given()
    with units_are_written():  # Who reads the axes has told of degrees among them.
        lights = plan.run_all(**given)
    return BlockLight(tuple([lights[name] for name in detectors_of(plan)]))
