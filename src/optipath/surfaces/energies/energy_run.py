"""EnergyRun: photons walked block by block, and what is known after so many of them."""

from __future__ import annotations

from contextlib import closing
from typing import TYPE_CHECKING

import numpy as np

from optipath.surfaces.energies.energy_table import Energy
from optipath.surfaces.walk.photon_beam import BLOCK
from optipath.surfaces.walk.walked_in_order import walked_in_order

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.surfaces.walk.photon_beam import PhotonBeam
    from optipath.surfaces.walk.walked_block import WalkedBlock


class EnergyRun:
    """The sums over the photons that have been walked so far, in the order of their blocks."""

    def __init__(self, beam: PhotonBeam, threads: int) -> None:
        self.beam, self.threads = beam, threads
        self.blocks, self.photons = 0, 0
        self._sums: list[npt.NDArray[np.float64]] = []

    def walk(self, photons: int, progress: Callable[[int, int], None] | None = None) -> None:
        """Walk on until there are as many photons in all; an interruption loses nothing."""
        todo = range(self.blocks, -(-photons // BLOCK))
        walked = walked_in_order(self.beam, todo, photons, self.threads, self.beam.block)
        with closing(walked):
            for block in walked:
                self._add(block)
                if progress is not None:
                    progress(self.photons, photons)

    def _add(self, walked: WalkedBlock) -> None:
        for surface, sums in walked.sums.items():
            while len(self._sums) <= surface:
                self._sums.append(np.zeros_like(sums))
            self._sums[surface] += sums
        self.blocks, self.photons = self.blocks + 1, self.photons + walked.photons

    @property
    def energy(self) -> Energy:
        """What is known so far."""
        return Energy.of(self.beam, np.array(self._sums))
