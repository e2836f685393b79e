"""Beam and sensor: photons on a sample, summed by pixels."""

from __future__ import annotations

from contextlib import closing
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.faults import shown
from optipath.surfaces.ends import turned_directions
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.beam import BLOCK, PORTION, walked_in_order
from optipath.surfaces.walk.code import walk_code
from optipath.values.arrays import ComparedByFields
from optipath.values.precision import real_number

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.surfaces.hemisphere.sensor import Sensor
    from optipath.surfaces.walk.beam import PhotonBeam
    from optipath.values.precision import Numbers


CHUNK = 1 << 22
"""How many photons are summed up by themselves: the least that is kept, or sent to a worker."""

Side: TypeAlias = Literal["reflected", "transmitted"]
SIDES = {"reflected": layout.UP, "transmitted": layout.DOWN}
"""What the hemispheres are called, and the ends of the photons that get there."""

STATES = ((1.0, 0.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.0), (1.0, 0.0, 1.0, 0.0), (1.0, 0.0, 0.0, 1.0))
"""The states of the source that ride on one photon: between them they say its Mueller matrix."""


PIXELS = ("side", "y", "x", "wavelength")
"""The dimensions of what is known of each pixel."""

_MATRIX = tuple(f"M{row}{column}" for row in range(4) for column in range(4))

OF_BEAM = "cos", "sin", "azimuth", "seed", "most_events"
"""What a file keeps of the photons besides sample, indices and states."""

Polarized: TypeAlias = Literal["both", "polarized", "scalar"]
NUMBERS = {"both": (*_MATRIX, "scalar"), "polarized": _MATRIX, "scalar": ("scalar",)}
"""What may be measured, and the names of the numbers of a light that are summed up for it."""


@dataclass(frozen=True, eq=False)
class SensedBeam(ComparedByFields):
    """Photons, and how they are seen; chunks of them do not depend on each other."""

    beam: PhotonBeam
    sensor: Sensor
    polarized: Polarized
    events: int | None

    @property
    def sides(self) -> tuple[str, ...]:
        """The hemispheres that light gets to."""
        return tuple(SIDES)[: 1 if self.beam.indices.opaque else 2]

    @property
    def shape(self) -> tuple[int, ...]:
        """That of the sums: (parts, sides, rows, columns, wavelengths, numbers)."""
        side, lights = self.sensor.pixels, self.beam.indices.n.size
        return self.sensor.parts, len(self.sides), side, side, lights, len(NUMBERS[self.polarized])

    @property
    def facts(self) -> dict[str, Any]:
        """All of what is measured but for the sample itself and the indices of its base."""
        return {
            **{name: getattr(self.beam, name) for name in OF_BEAM},
            "outside": self.beam.indices.outside,
            "inner": self.beam.indices.inner,
            **asdict(self.sensor),
            "polarized": self.polarized,
            "events": None if self.events is None else int(self.events),
        }

    def chunk(
        self,
        number: int,
        photons: int,
        threads: int,
        progress: Callable[[int, int], None] | None = None,
    ) -> PartSums:
        """Walk the photons of a chunk, and sum them up in their order."""
        result, add, done = PartSums.none(self.shape), walk_code("pixel_sums"), CHUNK * number
        stored = [int(self.polarized != other) for other in ("scalar", "polarized")]
        lights = self.beam.indices.n.size
        wanted = min(photons, CHUNK * (number + 1))
        todo = range(CHUNK * number // BLOCK, -(-wanted // BLOCK))
        walked = walked_in_order(self.beam, todo, wanted, threads, self._seen)
        with closing(walked):
            for parts, places, turns, ends in walked:
                sizes = len(places), lights, len(self.beam.states)
                add(places, turns, ends, *sizes, *stored, result.sums)
                pixels = places[places >= 0] % result.counts.size
                result.counts.reshape(-1)[:] += np.bincount(pixels, minlength=result.counts.size)
                result.photons[:] += np.bincount(parts, minlength=self.sensor.parts)
                done += len(places)
                if progress is not None:
                    progress(done, photons)
        return result

    def _seen(self, number: int, photons: int) -> tuple[npt.NDArray[Any], ...]:
        """Walk a block; return parts and pixels of its photons, turns into frames, and ends."""
        ends = self.beam.block(number, photons, keeps=True).ends
        k, _, turns = turned_directions(self.beam, ends)
        side = np.full(photons, -1)
        for place, name in enumerate(self.sides):
            side[ends[:, layout.OUTCOME] == SIDES[name]] = place
        if self.events is not None:
            side[ends[:, layout.EVENTS] != self.events] = -1
        parts = self._parts(number, photons)
        image = self.sensor.pixels**2
        places = (parts * len(self.sides) + side) * image + self.sensor.place(k)
        return parts, np.where(side < 0, -1, places), turns, ends

    def _parts(self, number: int, photons: int) -> npt.NDArray[np.int64]:
        """Return to which part each photon belongs; all that walk over one surface to the same."""
        part = (BLOCK * number + np.arange(photons)) // PORTION
        if self.beam.surfaces > 1:
            for first, size, surface in self.beam.portions(number, photons):
                part[first : first + size] = surface
        return part % self.sensor.parts


_MIRRORED = np.outer([1.0, 1.0, -1.0, -1.0], [1.0, 1.0, -1.0, -1.0]).ravel()
"""What a Mueller matrix is multiplied by in a mirror that is the plane of incidence."""


class PartSums(NamedTuple):
    """Sums over photons, part by part; or, where none are walked, light that is known exactly.

    Shapes: sums (parts, sides, rows, columns, wavelengths, numbers); counts (sides, rows, columns);
    photons (parts,).
    """

    sums: Numbers
    counts: npt.NDArray[np.int64]
    photons: npt.NDArray[np.int64]

    @classmethod
    def none(cls, shape: tuple[int, ...]) -> Self:
        """Return the sums over no photons."""
        zero = np.zeros(shape)
        return cls(zero, np.zeros(shape[1:4], np.int64), np.zeros(shape[0], np.int64))

    def add(self, other: PartSums) -> None:
        """Add the sums over other photons to these."""
        for mine, its in zip(self, other, strict=True):
            np.add(mine, its, out=mine)

    def mirrored(self) -> PartSums:
        """Return the means of a symmetric sample and its mirror image, which have less noise."""
        numbers = self.sums.shape[-1]
        signs = np.append(_MIRRORED, 1.0)[-numbers if numbers == 1 else slice(numbers)]
        return self._replace(sums=0.5 * (self.sums + self.sums[:, :, ::-1] * signs))

    def estimate(self, result: Callable[[Numbers], Numbers]) -> tuple[Numbers, Numbers]:
        """Return the result of the pixels, and its standard error by the jackknife.

        B. Efron, The Jackknife, the Bootstrap and Other Resampling Plans, SIAM 1982, eq. 3.13.
        """
        total, photons = self.sums.sum(axis=0), self.photons.sum()
        with np.errstate(invalid="ignore", divide="ignore"):
            value = np.asarray(result(total / (photons or 1)))
            if value.dtype.kind not in "iuf":
                raise SurfaceError(
                    f"what is estimated is {shown(value)}; let the function return real numbers"
                )
            if not photons:
                return value, np.zeros_like(value)
            # Of the differences from the whole, since the squares of the values cancel.
            mean, square, parts = np.zeros_like(value), np.zeros_like(value), 0
            for part, size in zip(self.sums, self.photons, strict=True):
                if size:
                    apart = result((total - part) / (photons - size)) - value
                    mean, square, parts = mean + apart, square + apart * apart, parts + 1
            if parts < 2:
                return value, np.full_like(value, np.nan)
            variance = (parts - 1) / parts * np.maximum(square - mean * mean / parts, 0.0)
            return value, np.sqrt(variance)


@dataclass(frozen=True)
class PixelMask:
    """Pixels that count where light with polarisation and without are compared.

    Without a mask, the largest difference would be that of dim or noisy pixels.
    """

    brighter_than: float = 0.2
    noise: float | None = 0.2
    known_to: float = 0.001

    def __post_init__(self) -> None:
        """Refuse all faults."""
        faults = [
            f"{name} is {shown(value)}; give a number from 0, such as 0.2"
            for name, value in vars(self).items()
            if not (name == "noise" and value is None)
            and (real_number(value) is None or value < 0.0)
        ]
        SurfaceError.raise_for(faults)

    def bright(self, light: Numbers) -> npt.NDArray[np.bool_]:
        """Return which pixels (rows, columns) are bright enough."""
        return np.asarray(light > self.brighter_than * np.nanmean(light))

    def known(self, difference: Numbers, error: Numbers) -> npt.NDArray[np.bool_]:
        """Return which differences (...) are known well enough."""
        if self.noise is None:
            return ~np.isnan(difference)
        return np.asarray(error <= np.maximum(self.noise * np.abs(difference), self.known_to))

    def __str__(self) -> str:
        bright = f"light without polarisation above {self.brighter_than:g} of the mean over the"
        known = f"of the difference, or at most {self.known_to:g}"
        noise = self.noise
        told = "any noise" if noise is None else f"standard error at most {noise:g} {known}"
        return f"{bright} hemisphere's pixels, {told}"
