"""What a hemisphere tells of the light of its pixels: BRDF, Stokes vectors, and what follows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.light.frames import Frame
from optipath.light.light import Light
from optipath.surfaces.hemispheres.measured_pixels import MeasuredPixels
from optipath.surfaces.walk.given_beam import UNPOLARISED, given_state
from optipath.sweeps.labels.light_quantities import DERIVED

if TYPE_CHECKING:
    import xarray as xr

Numbers = npt.NDArray[np.float64]

_ROUNDED = 64.0 * np.finfo(float).eps
"""By how much of a pixel's light sums over photons are rounded, with room."""

_QUANTITIES = {each.variable: each for each in DERIVED}


class PixelLight(MeasuredPixels):
    """A hemisphere of which the light of each pixel is known, for a source of any state.

    Each method gives an `xarray.DataArray` over (side, y, x, wavelength), and what it is of, with
    units. Its coordinate ``se`` is the standard error of each of its numbers: by the jackknife, so
    that ratios and angles have theirs; NaN where all photons of a pixel are of one part.
    """

    def brdf(self, *, polarized: bool = True) -> xr.DataArray:
        """Return the light of each pixel per steradian, over the cosine of its centre.

        Parameters
        ----------
        polarized : bool, optional
            Whether it is the Mueller matrix, or what there is without polarisation.

        Returns
        -------
        xarray.DataArray
            In 1/sr, (side, y, x, wavelength, out, in) or without the last two; NaN where the
            centre of a pixel is beyond the horizon. Of the lower hemisphere it is the BTDF.

        Raises
        ------
        SurfaceError
            If it has not been measured.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
        >>> brdf = found.brdf()
        >>> brdf.dims, brdf.units, brdf.se.dims == brdf.dims
        (('side', 'y', 'x', 'wavelength', 'out', 'in'), '1/sr', True)
        """
        area = (self.sensor.solid_angle * np.cos(self.sensor.theta))[:, :, np.newaxis]
        if not polarized:
            value, error = (each / area for each in self.scalar)
            return self._array("brdf", (value, error), "BRDF without polarisation", "1/sr")
        value, error = (each / area[..., np.newaxis, np.newaxis] for each in self.mueller)
        what = "Mueller matrix of the BRDF"
        return self._array("brdf", (value, error), what, "1/sr", ("out", "in"))

    def stokes(self, source: npt.ArrayLike = UNPOLARISED) -> xr.DataArray:
        """Return the Stokes vector of the light that goes into each pixel.

        Parameters
        ----------
        source : array_like, shape (4,), optional
            The Stokes vector of the light that comes in, in the frame whose x is horizontal;
            unpolarised by default.

        Returns
        -------
        xarray.DataArray
            (side, y, x, wavelength, out), in the frames of the pixels: where S0 of the source is
            1, the share of its light that goes into each.

        Raises
        ------
        SurfaceError
            If no Mueller matrix has been measured, or the source is no light.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
        >>> light = found.stokes([1.0, 1.0, 0.0, 0.0]).sel(out="S0", side="reflected")
        >>> print(light.sum().round(6).item())
        1.0
        """
        state = _state(source)
        found = self.own.estimate(lambda light: self.matrices(light) @ state)
        what = "Stokes vector of the light that goes into the pixel"
        return self._array("stokes", found, what, "1", ("out",), source=state)

    def dop(self, source: npt.ArrayLike = UNPOLARISED) -> xr.DataArray:
        """Return the degree of polarisation of each pixel; NaN where no light falls.

        Noise makes it larger: where it is no larger than a few of its errors, it may be 0.

        Parameters
        ----------
        source : array_like, shape (4,), optional
            As `stokes` takes it.

        Returns
        -------
        xarray.DataArray

        Raises
        ------
        SurfaceError
            As `stokes` does.
        """
        return self._quantity("DoP", source)

    def dolp(self, source: npt.ArrayLike = UNPOLARISED) -> xr.DataArray:
        """Return the degree of linear polarisation of each pixel; NaN where no light falls.

        Parameters
        ----------
        source : array_like, shape (4,), optional
            As `stokes` takes it.

        Returns
        -------
        xarray.DataArray

        Raises
        ------
        SurfaceError
            As `stokes` does.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1.5, 0.0)]), 0.98279, photons=16_384, sensor=16)
        >>> at = found.sensor.place([0.83205, 0.0, 0.5547])  # Brewster's angle
        >>> print(found.dolp().sel(side="reflected").values.ravel()[at].round(6))
        1.0
        """
        return self._quantity("DoLP", source)

    def aop(self, source: npt.ArrayLike = UNPOLARISED) -> xr.DataArray:
        """Return the angle of polarisation of each pixel; NaN where there is none.

        In full, in (-pi/2, pi/2], from x of the pixel's frame towards y; M. Wang et al., Optics
        Express 25(19), 2017, fold it into 0 .. 45 deg. Its error knows that an angle a little
        below pi/2 is near one a little above -pi/2; from 0.9 rad (52 deg) on, that of angles
        anywhere, nothing is known of it.

        Parameters
        ----------
        source : array_like, shape (4,), optional
            As `stokes` takes it.

        Returns
        -------
        xarray.DataArray
            In radians.

        Raises
        ------
        SurfaceError
            As `stokes` does.
        """
        return self._quantity("AoP", source, period=np.pi)

    def _quantity(
        self, variable: str, source: npt.ArrayLike, period: float | None = None
    ) -> xr.DataArray:
        """Return a quantity of `Light`, the same in any frame or an angle of some period."""
        state, quantity = _state(source), _QUANTITIES[variable]

        def value(light: Numbers) -> Numbers:
            matrices = self.matrices(light)
            noise = _ROUNDED * state[0] * matrices[..., 0, 0]
            return quantity.of(Light.of(matrices @ state, Frame(), noise=noise, measured=True))

        whole, error = self.own.estimate(value)
        if period is not None:
            _, error = self.own.estimate(
                lambda light: np.remainder(value(light) - whole + period / 2.0, period)
            )
        name = quantity.variable.lower()
        return self._array(name, (whole, error), quantity.name, quantity.unit, source=state)

    def _array(
        self,
        name: str,
        found: tuple[Numbers, Numbers],
        what: str,
        units: str,
        more: tuple[str, ...] = (),
        **told: Any,
    ) -> xr.DataArray:
        """Return numbers with their names, units and errors."""
        from optipath.surfaces.hemispheres.pixel_array import pixel_array  # noqa: PLC0415 - an extra

        value, error = found
        return pixel_array(self, name, value, what, units, more, error=error, **told)


def _state(source: npt.ArrayLike) -> Numbers:
    return np.array(given_state("source", source))
