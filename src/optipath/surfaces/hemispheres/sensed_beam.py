"""SensedBeam: photons that fall on a sample, and the sensor on which they end."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.engines.array_address import address
from optipath.surfaces.ends.turned_ends import turned_directions
from optipath.surfaces.hemispheres.part_sums import PartSums
from optipath.surfaces.walk.photon_beam import BLOCK, PORTION
from optipath.surfaces.walk.walk_code import pixel_code
from optipath.surfaces.walk.walk_layout import DOWN, EVENTS, OUTCOME, UP
from optipath.surfaces.walk.walked_in_order import walked_in_order
from optipath.values.arrays.read_only import same_fields

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.surfaces.hemispheres.sensor import Sensor
    from optipath.surfaces.walk.photon_beam import PhotonBeam

CHUNK = 1 << 22
"""How many photons are summed up by themselves: the least that is kept, or sent to a worker."""

SIDES = {"reflected": UP, "transmitted": DOWN}
"""What the hemispheres are called, and the ends of the photons that get there."""

STATES = (
    (1.0, 0.0, 0.0, 0.0),
    (1.0, 1.0, 0.0, 0.0),
    (1.0, 0.0, 1.0, 0.0),
    (1.0, 0.0, 0.0, 1.0),
)
"""The states of the source that ride on one photon: between them they say its Mueller matrix."""


class _Seen(NamedTuple):
    """Where the photons of a block are seen, and what `pixel_sums` needs of them."""

    parts: npt.NDArray[np.int64]
    places: npt.NDArray[np.int64]
    turns: npt.NDArray[np.float64]
    ends: npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SensedBeam:
    """Photons, and how they are seen; chunks of them do not depend on each other."""

    beam: PhotonBeam
    sensor: Sensor
    polarized: str
    events: int | None

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]

    @property
    def sides(self) -> tuple[str, ...]:
        """The hemispheres that light gets to."""
        return tuple(SIDES)[: 1 if self.beam.indices.opaque else 2]

    @property
    def numbers(self) -> int:
        """How many are summed up of a light: those of a Mueller matrix, its scalar, or both."""
        return {"both": 17, "polarized": 16, "scalar": 1}[self.polarized]

    @property
    def shape(self) -> tuple[int, ...]:
        """That of the sums: (parts, sides, rows, columns, wavelengths, numbers)."""
        side, lights = self.sensor.pixels, self.beam.indices.n.size
        return self.sensor.parts, len(self.sides), side, side, lights, self.numbers

    def chunk(
        self,
        number: int,
        photons: int,
        threads: int,
        progress: Callable[[int], None] | None = None,
    ) -> PartSums:
        """Walk the photons of a chunk, and sum them up in their order."""
        found, add = PartSums.none(self.shape), pixel_code()
        kept = [int(self.polarized != other) for other in ("scalar", "polarized")]
        lights = self.beam.indices.n.size
        wanted = min(photons, CHUNK * (number + 1))
        todo = range(CHUNK * number // BLOCK, -(-wanted // BLOCK))
        walked = walked_in_order(self.beam, todo, wanted, threads, self._seen)
        with closing(walked):
            for seen in walked:
                arrays = map(address, (seen.places, seen.turns, seen.ends))
                size = len(seen.places)
                add(*arrays, size, lights, len(self.beam.states), *kept, address(found.sums))
                pixels = seen.places[seen.places >= 0] % found.counts.size
                found.counts.reshape(-1)[:] += np.bincount(pixels, minlength=found.counts.size)
                found.photons[:] += np.bincount(seen.parts, minlength=self.sensor.parts)
                if progress is not None:
                    progress(size)
        return found

    def _seen(self, number: int, photons: int) -> _Seen:
        """Walk a block."""
        ends = self.beam.block(number, photons, keeps=True).ends
        directions = turned_directions(self.beam, ends)
        side = np.full(photons, -1)
        for place, name in enumerate(self.sides):
            side[ends[:, OUTCOME] == SIDES[name]] = place
        if self.events is not None:
            side[ends[:, EVENTS] != self.events] = -1
        parts = self._parts(number, photons)
        image = self.sensor.pixels**2
        places = (parts * len(self.sides) + side) * image + self.sensor.place(directions.k)
        return _Seen(parts, np.where(side < 0, -1, places), directions.turns, ends)

    def _parts(self, number: int, photons: int) -> npt.NDArray[np.int64]:
        """Return to which part each photon belongs; all that walk over one surface to the same."""
        part = (BLOCK * number + np.arange(photons)) // PORTION
        if self.beam.surfaces > 1:
            for first, size, surface in self.beam.portions(number, photons):
                part[first : first + size] = surface
        return part % self.sensor.parts
