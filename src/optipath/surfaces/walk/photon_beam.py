"""Photons that fall on a sample from one direction, block after block."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from optipath.engines.array_address import address
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
    UP,
)
from optipath.surfaces.walk.walked_block import WalkedBlock
from optipath.values.arrays.read_only import same_fields

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.samples.sample_indices import SampleIndices

BLOCK = 1 << 14
"""How many photons share a stream of random numbers."""

PORTION = 1 << 9
"""How many of them walk over one realisation of the surfaces before the next takes its turn."""

TURN = 1 << 19
"""How many photons walk over a realisation before another is drawn in its place."""


@dataclass(frozen=True, eq=False)
class PhotonBeam:
    """What is needed to walk any block of photons; blocks do not depend on each other.

    The sample's surfaces take turns, each for a `PORTION` of photons, and after a `TURN` of them
    others take their places, so that the error of many photons goes down. Block b has the random
    numbers of child b of the seed (`numpy.random.SeedSequence`).
    """

    sample: Sample
    cos: float
    sin: float
    azimuth: float
    indices: SampleIndices
    states: tuple[tuple[float, float, float, float], ...]
    seed: int
    most_events: int

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]

    @cached_property
    def lights(self) -> int:
        """How many lights ride on a photon: for each index of the base, all states."""
        return self.indices.n.size * len(self.states)

    @property
    def plane_azimuth(self) -> float:
        """That of the plane of incidence as directions are told; on an isotropic sample 0."""
        return 0.0 if self.sample.isotropic else self.azimuth

    def smooth_sine(self, outcome: int) -> float:
        """Return the sine of the angle at which a smooth sample sends light up or down."""
        if outcome == UP:
            return self.sin
        return self.sin * self.indices.outside / float(self.indices.n.flat[0])

    @property
    def surfaces(self) -> int:
        """How many realisations of the surfaces take turns; one where nothing is random."""
        return self.sample.surfaces if self._is_random else 1

    @property
    def _is_random(self) -> bool:
        return any(each.is_random for each in self.sample.layers)

    def surface(self, photon: int) -> int:
        """Return over which realisation of the surfaces a photon walks."""
        if not self._is_random:
            return 0
        drawn, place = divmod(photon // PORTION, TURN // PORTION * self.surfaces)
        return drawn * self.surfaces + place % self.surfaces

    def portions(self, number: int, photons: int) -> Iterator[tuple[int, int, int]]:
        """Yield the portions of a block: the first photon, how many, and over which surface."""
        size = PORTION if self._is_random else BLOCK
        for first in range(0, photons, size):
            yield first, min(size, photons - first), self.surface(BLOCK * number + first)

    def block(
        self, number: int, photons: int = BLOCK, wanted: int = -1, *, keeps: bool = False
    ) -> WalkedBlock:
        """Walk the first photons of a block."""
        count, photons = self.lights, photons if wanted < 0 else wanted + 1
        stream = np.random.SFC64(np.random.SeedSequence(self.seed, spawn_key=(number,)))
        state = np.array(stream.state["state"]["state"], np.uint64)
        starts, lights = np.zeros(2 * len(self.sample.layers)), np.zeros((count, CARRIED))
        record = np.zeros((1 if wanted < 0 else 1 + self.most_events, RECORD))
        ends = np.zeros((photons if keeps else 1, ENDS + CARRIED * count))
        azimuth = np.nan if self.sample.isotropic else self.azimuth
        media, base, source = map(address, self._given)
        before = (media, base, len(self.sample.layers), self.cos, self.sin, azimuth, source, count)
        behind = [address(each) for each in (state, starts, lights)]
        code, kept, to_record = walk_code(), kept_meshes(self.sample), address(record)
        sums: dict[int, npt.NDArray[np.float64]] = {}
        for first, size, surface in self.portions(number, photons):
            own = sums.setdefault(surface, np.zeros((OUTCOMES, MOST_COUNTED, count, SUMS)))
            last = wanted - first if first <= wanted else -1
            place = address(ends) + keeps * first * ends.strides[0]
            found = code(
                *kept.of(surface).addresses,
                *before,
                *(size, self.most_events, last if last < size else -1),
                *(*behind, address(own), to_record, place, int(keeps)),
            )
            if not found:
                raise SurfaceError(
                    "photons meet nothing of the sample: its finite fields are too small for this "
                    "incidence; give larger or periodic ones"
                )
        if not all(np.isfinite(own).all() for own in sums.values()):
            raise SurfaceError(f"photons of block {number} come to what is no number")
        return WalkedBlock(photons, sums, record, starts, lights, ends)

    @cached_property
    def _given(self) -> tuple[npt.NDArray[np.float64], ...]:
        """Return the media, the base of each light, and what lights are at first."""
        indices = self.indices
        behind = OPAQUE if indices.opaque else float(indices.n.flat[0])
        media = np.array([indices.outside, *indices.inner, behind])
        base = np.stack([indices.n.ravel(), indices.k.ravel()], axis=-1)
        source = [[*carry(FLOAT, state), state[0]] for state in self.states]
        each = np.repeat(base, len(source), axis=0)
        return media, each, np.tile(np.array(source), (len(base), 1))
