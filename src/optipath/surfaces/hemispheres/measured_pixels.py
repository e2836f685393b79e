"""MeasuredPixels: the light of each pixel of a hemisphere, as photons have brought it there."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown
from optipath.values.arrays.read_only import same

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.part_sums import PartSums
    from optipath.surfaces.hemispheres.sensed_beam import SensedBeam
    from optipath.surfaces.hemispheres.sensor import Sensor

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredPixels:
    """The light of each pixel, and standard errors: what a `Hemisphere` is made of.

    Shape: wavelengths (wavelengths,). Units: wavelengths in metres.
    """

    seen: SensedBeam
    parts: PartSums
    wavelengths: Numbers
    symmetric: bool

    def __eq__(self, other: object) -> Any:
        if type(other) is not type(self):
            return NotImplemented
        assert isinstance(other, MeasuredPixels)  # noqa: S101 - for who checks types
        mine, its = ((each.seen, each.parts, each.symmetric) for each in (self, other))
        # No wavelength is NaN, which is here the same as itself.
        alike = np.array_equal(self.wavelengths, other.wavelengths, equal_nan=True)
        return alike and same(mine, its)

    __hash__ = None  # type: ignore[assignment]

    @property
    def sensor(self) -> Sensor:
        """The pixels."""
        return self.seen.sensor

    @property
    def photons(self) -> int:
        """How many have been walked; none where all interfaces are flat, and light is known."""
        return int(self.parts.photons.sum())

    @cached_property
    def own(self) -> PartSums:
        """The sums by which all is estimated: those counted, or means with their mirror images."""
        return self.parts.mirrored() if self.symmetric else self.parts

    @cached_property
    def mueller(self) -> tuple[Numbers, Numbers]:
        """The Mueller matrices and their errors: (sides, rows, columns, wavelengths, 4, 4)."""
        return self.own.estimate(self.matrices)

    @cached_property
    def scalar(self) -> tuple[Numbers, Numbers]:
        """The shares without polarisation and their errors: (sides, rows, columns, wavelengths)."""
        return self.own.estimate(self.intensities)

    @cached_property
    def difference(self) -> tuple[Numbers, Numbers]:
        """The shares of unpolarised light less those without polarisation, and their errors."""
        return self.own.estimate(
            lambda light: self.matrices(light)[..., 0, 0] - self.intensities(light)
        )

    def matrices(self, light: Numbers) -> Numbers:
        """Return the Mueller matrices among the numbers of `PartSums.estimate`.

        Parameters
        ----------
        light : ndarray, shape (..., numbers)
            The mean of all numbers.

        Returns
        -------
        ndarray, shape (..., 4, 4)

        Raises
        ------
        SurfaceError
            If they have not been measured.
        """
        if self.seen.polarized == "scalar":
            raise SurfaceError(_missing("Mueller matrix", "polarized"))
        return light[..., :16].reshape(*light.shape[:-1], 4, 4)

    def intensities(self, light: Numbers) -> Numbers:
        """Return the light without polarisation among the numbers of `PartSums.estimate`.

        Parameters
        ----------
        light : ndarray, shape (..., numbers)
            The mean of all numbers.

        Returns
        -------
        ndarray, shape (...)

        Raises
        ------
        SurfaceError
            If it has not been measured.
        """
        if self.seen.polarized == "polarized":
            raise SurfaceError(_missing("light without polarisation", "scalar"))
        return light[..., -1]

    def scalar_light(self, side: int) -> Numbers:
        """Return the light without polarisation by which pixels count.

        Parameters
        ----------
        side : int
            The place of the side.

        Returns
        -------
        ndarray, shape (rows, columns)
            The sum over photons, the mean over wavelengths; NaN beyond the horizon.
        """
        light = self.intensities(self.own.sums.sum(axis=0))[side].mean(axis=-1)
        return np.where(np.isnan(self.sensor.theta), np.nan, light)

    def side(self, name: Any) -> int:
        """Return the place of a hemisphere.

        Parameters
        ----------
        name : {"reflected", "transmitted"}
            Above the sample, or below.

        Returns
        -------
        int

        Raises
        ------
        SurfaceError
            If no light gets there, or none is called so.
        """
        sides = self.seen.sides
        if name not in sides:
            why = ": nothing goes through an opaque sample" if name == "transmitted" else ""
            raise SurfaceError(f"no side is called {shown(name)}{why}; give {' or '.join(sides)}")
        return sides.index(name)


def _missing(what: str, kind: str) -> str:
    return f"the {what} has not been measured; measure with polarized='both' or '{kind}'"
