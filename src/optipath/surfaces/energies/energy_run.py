"""EnergyRun: photons walked block by block, and what is known after so many of them."""

from __future__ import annotations

from collections import deque
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from optipath.surfaces.energies.energy_table import Energy
from optipath.surfaces.walk.kept_meshes import kept_meshes
from optipath.surfaces.walk.photon_beam import BLOCK
from optipath.surfaces.walk.walk_code import walk_code

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Future

    import numpy.typing as npt

    from optipath.surfaces.walk.photon_beam import PhotonBeam
    from optipath.surfaces.walk.walked_block import WalkedBlock

_AHEAD = 4
"""How many blocks a thread are handed out before the first of them is waited for."""


class EnergyRun:
    """The sums over the photons that have been walked so far, in the order of their blocks.

    Parameters
    ----------
    beam : PhotonBeam
        The photons.
    threads : int
        How many walk at a time; sums do not depend on it.
    """

    def __init__(self, beam: PhotonBeam, threads: int) -> None:
        self.beam, self.threads = beam, threads
        self.blocks, self.photons = 0, 0
        self._sums: list[npt.NDArray[np.float64]] = []

    def walk(self, photons: int, progress: Callable[[int, int], None] | None = None) -> None:
        """Walk on until there are as many photons in all; what is done stays if it is interrupted.

        Parameters
        ----------
        photons : int
            How many there are to be; they end with a whole block, or with these.
        progress : callable, optional
            Told how many there are, and how many there are to be, whenever a block is done.

        Raises
        ------
        SurfaceError
            If photons meet nothing, or come to what is no number.
        """
        walk_code()
        last = -(-photons // BLOCK)
        todo = range(self.blocks, last)
        executor = ThreadPoolExecutor(self.threads)
        try:
            for walked in self._in_order(executor, todo, photons):
                self._add(walked)
                if progress is not None:
                    progress(self.photons, photons)
        finally:
            executor.shutdown(cancel_futures=True)

    def _in_order(
        self, executor: ThreadPoolExecutor, todo: range, photons: int
    ) -> Iterator[WalkedBlock]:
        """Yield blocks in their order; no more are handed out than keep all threads at work."""
        kept = kept_meshes(self.beam.sample)
        waiting: deque[Future[WalkedBlock]] = deque()
        for number in todo:
            size = min(BLOCK, photons - BLOCK * number)
            # Here and not by a thread, whose warnings nobody would know where from.
            for _, _, surface in self.beam.portions(number, size):
                kept.of(surface)
            waiting.append(executor.submit(self.beam.block, number, size))
            if len(waiting) > _AHEAD * self.threads:
                yield waiting.popleft().result()
        for future in waiting:
            yield future.result()

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
