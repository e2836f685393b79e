"""PlaneCut: the light of a measured sample in the plane of incidence."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from optipath.light.frames import Frame
from optipath.light.light import Light
from optipath.surfaces.facets.directions import frame_along

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.plots.hemispheres.seen_side import SeenSide

    Numbers = npt.NDArray[np.float64]

_ROUNDED = 64.0 * np.finfo(float).eps


@dataclass(frozen=True)
class PlaneCut:
    """The light of one side of a measured sample in the plane of incidence.

    It is that of the row of pixels in the plane, or the mean of the two that it lies between, in
    frames with x perpendicular to the plane.
    """

    seen: SeenSide

    @property
    def _rows(self) -> slice:
        pixels = self.seen.measured.sensor.pixels
        return slice((pixels - 1) // 2, pixels // 2 + 1)

    @cached_property
    def angles(self) -> Numbers:
        """The angle of each pixel to the normal, in radians, below 0 on the side of the source."""
        sensor = self.seen.measured.sensor
        return np.asarray(np.copysign(sensor.theta[self._rows][0], sensor.coordinates))

    @cached_property
    def _frames(self) -> tuple[Frame, Frame]:
        """Those of the pixels, and those with x perpendicular to the plane of incidence."""
        up = self.seen.side == "reflected"
        directions = self.seen.measured.sensor.directions[self._rows]
        directions = directions * (1.0, 1.0, 1.0 if up else -1.0)
        own = frame_along("direction", directions, up=up)
        return own, Frame.from_direction(own.z, (0.0, 1.0, 0.0))

    def light(self, numbers: Numbers) -> Light:
        """Return the light per steradian among the numbers of `PartSums.estimate`.

        Shapes: numbers (sides, rows, columns, wavelengths, numbers); returns (columns,).
        """
        own, plane = self._frames
        matrices = self.seen.measured.matrices(self._pixels(numbers))
        seen = Light.of(matrices @ np.array(self.seen.source), own, measured=True)
        stokes = self._mean(seen.in_frame(plane).stokes)
        noise = _ROUNDED * self.seen.source[0] * self._mean(matrices[..., 0, 0])
        return Light.of(stokes, Frame(), noise=noise, measured=True)

    def scalar(self, numbers: Numbers) -> Numbers:
        """Return the light per steradian that there is without polarisation.

        Shapes: numbers (sides, rows, columns, wavelengths, numbers); returns (columns,).
        """
        return self._mean(self.seen.measured.intensities(self._pixels(numbers)))

    def _pixels(self, numbers: Numbers) -> Numbers:
        at = self.seen.measured.side(self.seen.side)
        return numbers[at, self._rows, :, self.seen.place]

    def _mean(self, pixels: Numbers) -> Numbers:
        area = self.seen.measured.sensor.solid_angle[self._rows].sum(axis=0)
        total = pixels.sum(axis=0)
        return np.asarray(total / area.reshape(-1, *[1] * (total.ndim - 1)))
