"""SensedBeam: photons that fall on a sample, and the sensor on which they end."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.surfaces.ends.turned_ends import turned_ends
from optipath.surfaces.hemispheres.part_sums import PartSums
from optipath.surfaces.hemispheres.pixel_adder import add_to_pixels
from optipath.surfaces.walk.photon_beam import BLOCK, PORTION
from optipath.surfaces.walk.walk_layout import DOWN, UP
from optipath.surfaces.walk.walked_in_order import walked_in_order

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
    """What a block of photons adds: where, and how much."""

    photons: npt.NDArray[np.int64]
    places: npt.NDArray[np.int64]
    lights: npt.NDArray[np.float64]


@dataclass(frozen=True)
class SensedBeam:
    """Photons, and how they are seen; chunks of them do not depend on each other.

    Attributes
    ----------
    beam : PhotonBeam
        What falls on the sample: `STATES`, or unpolarised light.
    sensor : Sensor
        Where they end.
    polarized : {"both", "polarized", "scalar"}
        Whether the Mueller matrix is summed up, what it is without polarisation, or both.
    events : int or None
        After how many events photons are seen; None is after any number.
    """

    beam: PhotonBeam
    sensor: Sensor
    polarized: str
    events: int | None

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
        """Walk the photons of a chunk, and sum them up in their order.

        Parameters
        ----------
        number : int
            Which chunk.
        photons : int
            How many photons there are in all chunks.
        threads : int
            How many walk at a time; the sums do not depend on it.
        progress : callable, optional
            Told how many have been walked since it was told.

        Returns
        -------
        PartSums
        """
        found = PartSums.none(self.shape)
        sums = found.sums.reshape(-1, self.shape[-2] * self.shape[-1])
        ends = min(photons, CHUNK * (number + 1))
        todo = range(CHUNK * number // BLOCK, -(-ends // BLOCK))
        walked = walked_in_order(self.beam, todo, ends, threads, self._seen)
        with closing(walked):
            for seen in walked:
                add_to_pixels(seen.places, seen.lights, sums)
                np.add.at(found.counts.reshape(-1), self._pixels(seen.places), 1)
                found.photons[:] += seen.photons
                if progress is not None:
                    progress(int(seen.photons.sum()))
        return found

    def _pixels(self, places: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
        """Return the pixels of all parts alike."""
        return places[places >= 0] % (len(self.sides) * self.sensor.pixels**2)

    def _seen(self, number: int, photons: int) -> _Seen:
        """Walk a block."""
        beam, sensor, parts = self.beam, self.sensor, self.sensor.parts
        ends = turned_ends(beam, beam.block(number, photons, keeps=True).ends)
        part = self._parts(number, photons)
        side = np.full(photons, -1)
        for place, name in enumerate(self.sides):
            side[ends.outcomes == SIDES[name]] = place
        if self.events is not None:
            side[ends.events != self.events] = -1
        places = (part * len(self.sides) + side) * sensor.pixels**2 + sensor.place(ends.directions)
        lights = ends.stokes.reshape(photons, -1, len(beam.states), 4)
        scalar = ends.scalar.reshape(photons, -1, len(beam.states))[..., :1]
        return _Seen(
            np.bincount(part, minlength=parts),
            np.where(side < 0, -1, places),
            self._carried(lights, scalar),
        )

    def _parts(self, number: int, photons: int) -> npt.NDArray[np.int64]:
        """Return to which part each photon belongs; all that walk over one surface to the same."""
        part = (BLOCK * number + np.arange(photons)) // PORTION
        if self.beam.surfaces > 1:
            for first, size, surface in self.beam.portions(number, photons):
                part[first : first + size] = surface
        return part % self.sensor.parts

    def _carried(
        self, lights: npt.NDArray[np.float64], scalar: npt.NDArray[np.float64]
    ) -> npt.NDArray[np.float64]:
        """Return the numbers of each photon, of which the sums are made."""
        found = [scalar] if self.polarized == "scalar" else [_matrices(lights)]
        if self.polarized == "both":
            found.append(scalar)
        return np.ascontiguousarray(np.concatenate(found, axis=-1)).reshape(len(scalar), -1)


def _matrices(lights: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return Mueller matrices, row by row, of what has become of the `STATES`."""
    columns = lights.copy()
    columns[..., 1:, :] -= lights[..., :1, :]
    rows = np.swapaxes(columns, -1, -2)
    return rows.reshape(*rows.shape[:-2], 16)
