"""One block of a sweep, as it travels to who computes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.sweeps.chunked.block_light import run_block

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from optipath.sweeps.axes.sweep_grid import SweepGrid
    from optipath.sweeps.chunked.plan_recipe import PlanRecipe
    from optipath.sweeps.labels.light_quantities import LightQuantity


@dataclass(frozen=True)
class SweepBlock:
    """A block of a `SweepJob`, with its own part of the axes: whole ones may be large."""

    recipe: PlanRecipe
    grid: SweepGrid
    region: tuple[slice, ...]
    quantities: Mapping[str, LightQuantity]

    def compute(self, number: int) -> dict[str, tuple[tuple[slice, ...], npt.NDArray[Any]]]:  # noqa: ARG002 - it is one block
        """Return the part of each variable that the block is, and what is in it."""
        light = run_block(self.recipe, self.grid)
        front = (slice(0, len(light.lights)),) if len(light.lights) > 1 else ()
        return {
            name: ((*front, *self.region), light.of(each)) for name, each in self.quantities.items()
        }
