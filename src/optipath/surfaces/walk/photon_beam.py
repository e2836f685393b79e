"""Photons that fall on a sample from one direction, block after block."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.kernels.carriers.carried import carry
from optipath.kernels.numbers.primitives import FLOAT
from optipath.surfaces.walk.kept_meshes import kept_meshes
from optipath.surfaces.walk.walk_code import walk_code
from optipath.surfaces.walk.walk_layout import (
    CARRIED,
    ENDS,
    MOST_COUNTED,
    OPAQUE,
    OUTCOMES,
    RECORD,
    SUMS,
)

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.samples.sample_indices import SampleIndices

BLOCK = 1 << 14
"""How many photons share a stream of random numbers, and one realisation of the surfaces."""

TURNS = 32
"""How many blocks are walked over a random surface before another is drawn in its place."""


class WalkedBlock(NamedTuple):
    """What has become of the photons of a block.

    Attributes
    ----------
    photons : int
        How many there were.
    sums : ndarray, shape (OUTCOMES, MOST_COUNTED, lights, SUMS)
        As `walk_layout` says.
    record : ndarray, shape (events + 1, RECORD)
        The photon that was wanted.
    starts : ndarray, shape (2 layers,)
        Where on each mesh the last photon has started, along x and along y.
    lights : ndarray, shape (lights, CARRIED)
        The lights of the last photon.
    ends : ndarray, shape (photons, ENDS + CARRIED lights)
        The end of every photon, where these are kept.
    """

    photons: int
    sums: npt.NDArray[np.float64]
    record: npt.NDArray[np.float64]
    starts: npt.NDArray[np.float64]
    lights: npt.NDArray[np.float64]
    ends: npt.NDArray[np.float64]


@dataclass(frozen=True)
class PhotonBeam:
    """What is needed to walk any block of photons; blocks do not depend on each other.

    Blocks take the sample's surfaces in turn, and after `TURNS` of them new ones, so that the
    error of many photons goes down. Block b has the random numbers of child b of the seed
    (`numpy.random.SeedSequence`).

    Attributes
    ----------
    sample : Sample
        What they fall on.
    cos, sin : float
        Of the angle of incidence.
    azimuth : float
        Towards which side they go, from x towards y, unless the sample is isotropic, where each
        photon has an azimuth of its own.
    indices : SampleIndices
        Of the media; of the base, one for each light that rides on a photon.
    stokes : tuple of float
        The Stokes vector of the source; the x of its frame is horizontal.
    seed : int
        Of all random numbers.
    most_events : int
        How often a photon may meet a facet before it is given up.
    """

    sample: Sample
    cos: float
    sin: float
    azimuth: float
    indices: SampleIndices
    stokes: tuple[float, float, float, float]
    seed: int
    most_events: int

    @cached_property
    def lights(self) -> int:
        """How many lights ride on a photon."""
        return self.indices.n.size

    @property
    def surfaces(self) -> int:
        """How many realisations of the surfaces take turns; one where nothing is random."""
        return self.sample.surfaces if self._is_random else 1

    @property
    def _is_random(self) -> bool:
        return any(each.is_random for each in self.sample.layers)

    def surface(self, number: int) -> int:
        """Return over which realisation of the surfaces a block is walked.

        Parameters
        ----------
        number : int
            The block.

        Returns
        -------
        int
        """
        if not self._is_random:
            return 0
        drawn, place = divmod(number, TURNS * self.surfaces)
        return drawn * self.surfaces + place % self.surfaces

    def block(
        self, number: int, photons: int = BLOCK, wanted: int = -1, *, keeps: bool = False
    ) -> WalkedBlock:
        """Walk the first photons of a block.

        Parameters
        ----------
        number : int
            Which block.
        photons : int, optional
            How many photons.
        wanted : int, optional
            Which of them is recorded, the last to be walked.
        keeps : bool, optional
            Whether the end of every photon is kept.

        Returns
        -------
        WalkedBlock
        """
        from optipath.engines.machine_code import address  # noqa: PLC0415 - an extra

        meshes = kept_meshes(self.sample).of(self.surface(number))
        layers, count = len(self.sample.layers), self.lights
        stream = np.random.SFC64(np.random.SeedSequence(self.seed, spawn_key=(number,)))
        state = np.array(stream.state["state"]["state"], np.uint64)
        starts, lights = np.zeros(2 * layers), np.zeros((count, CARRIED))
        sums = np.zeros((OUTCOMES, MOST_COUNTED, count, SUMS))
        record = np.zeros((1 if wanted < 0 else 1 + self.most_events, RECORD))
        media, base, source = self._given
        azimuth = np.nan if self.sample.isotropic else self.azimuth
        photons = photons if wanted < 0 else wanted + 1
        ends = np.zeros((photons if keeps else 1, ENDS + CARRIED * count))
        found = walk_code()(
            *map(address, (*meshes, media, base)),
            *(layers, self.cos, self.sin, azimuth, address(source)),
            *(count, photons, self.most_events, wanted),
            *map(address, (state, starts, lights, sums, record, ends)),
            int(keeps),
        )
        return WalkedBlock(found, sums, record, starts, lights, ends)

    def checked(self, walked: WalkedBlock, number: int) -> WalkedBlock:
        """Return a block; refuse one that is none.

        Parameters
        ----------
        walked : WalkedBlock
            What was walked.
        number : int
            Which block it is.

        Returns
        -------
        WalkedBlock

        Raises
        ------
        SurfaceError
            If photons meet nothing, or come to what is no number.
        """
        if not walked.photons:
            raise SurfaceError(
                "photons meet nothing of the sample: its finite fields are too small for this "
                "incidence; give larger or periodic ones"
            )
        if not np.isfinite(walked.sums).all():
            raise SurfaceError(f"photons of block {number} come to what is no number")
        return walked

    @cached_property
    def _given(self) -> tuple[npt.NDArray[np.float64], ...]:
        """Return the media, the base of each light, and what lights are at first."""
        indices = self.indices
        behind = OPAQUE if indices.opaque else float(indices.n.flat[0])
        media = np.array([indices.outside, *indices.inner, behind])
        base = np.stack([indices.n.ravel(), indices.k.ravel()], axis=-1)
        light = [*carry(FLOAT, self.stokes), self.stokes[0]]
        return media, base, np.tile(np.array(light), (self.lights, 1))
