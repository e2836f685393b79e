"""What a random surface is made of: its roughness, its mesh, its waves and its seed."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from optipath.errors import SurfaceError
from optipath.surfaces.fields.given_fields import (
    cells_of,
    length_faults,
    pair_of,
    period_faults,
    period_or_not,
    seed_of,
)
from optipath.surfaces.fields.mesh_resolution import converged_cells, warn_of_coarse
from optipath.surfaces.fields.random_waves import RandomWaves
from optipath.values.arrays.memory import enough_for
from optipath.values.whole_numbers import whole_number

Array = np.ndarray[Any, Any]

_CELL, _WAVE = 32, 128
"""How many bytes a cell and a wave take, with what is made of them."""
_FEWER = "take fewer cells, or a smaller field"


class RandomField(NamedTuple):
    """A random surface to be drawn."""

    alpha: tuple[float, float]
    size: tuple[float, float]
    cells: tuple[int, int]
    waves: int
    seed: np.random.SeedSequence
    periodic: bool

    @classmethod
    def of(
        cls,
        alpha: Any,
        alpha_y: Any,
        size: Any,
        cells: Any,
        waves: Any,
        seed: Any,
        *,
        periodic: Any,
    ) -> RandomField:
        """Read what `HeightField.beckmann` is given."""
        faults = length_faults("alpha", alpha, " (HeightField.flat() is a flat surface)")
        if alpha_y is not None:
            faults += length_faults("alpha_y", alpha_y)
        sides = pair_of("size", size, faults)
        faults += period_or_not(periodic)
        rough = (1.0, 1.0)
        if not faults:
            rough = float(alpha), float(alpha if alpha_y is None else alpha_y)
            faults += period_faults(rough, sides) if periodic else []
        meshed = converged_cells(rough, sides) if cells is None else cells_of(cells, faults)
        sequence = seed_of(seed, faults)
        faults += whole_number("waves", waves)
        if faults:
            raise SurfaceError(*faults)
        return cls(rough, sides, meshed, int(waves), sequence, bool(periodic))

    def heights(self) -> Array:
        """Draw the surface, and return the heights of its vertices.

        Shape: returns (rows, columns).
        """
        with (
            enough_for(self.cells, _CELL, _FEWER, SurfaceError, "mesh of {:.3g} cells"),
            enough_for(
                (self.waves,), _WAVE, "take fewer waves", SurfaceError, "sum of {:.3g} waves"
            ),
        ):
            warn_of_coarse(self.alpha, self.size, self.cells)
            period = self.size if self.periodic else None
            x, y = (
                np.arange(cells + (not self.periodic)) * (side / cells)
                for cells, side in zip(self.cells, self.size, strict=True)
            )
            return RandomWaves.drawn(self.alpha, self.waves, self.seed, period).heights(x, y)
