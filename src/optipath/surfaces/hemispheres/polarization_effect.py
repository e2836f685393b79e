"""What polarisation makes of the light of each pixel: beside what there is without it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.surfaces.hemispheres.measured_pixels import MeasuredPixels

if TYPE_CHECKING:
    import xarray as xr


class PolarizationEffect(MeasuredPixels):
    """A hemisphere measured with polarisation and without, on the same photons.

    All that it tells is of unpolarised light on the sample, whose light in a pixel is S0, and U
    where each reflection and refraction is taken by its mean over both polarisations.
    """

    def relative_difference(
        self, side: str = "reflected", *, brighter_than: float = 0.2
    ) -> xr.DataArray:
        """Return (S0 - U) / U of each pixel and wavelength, with its sign.

        Parameters
        ----------
        side : {"reflected", "transmitted"}, optional
            Above the sample, or below.
        brighter_than : float, optional
            NaN where U is less than so many times its mean; see `adm`. Noise masks none.

        Returns
        -------
        xarray.DataArray
            (y, x, wavelength); its standard error is its coordinate ``se``.

        Raises
        ------
        SurfaceError
            If one of the two was not measured, or what is given is none of the above.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.load_sample("glass-on-glass"), "60 deg", 100_000, sensor=16)
        >>> found.relative_difference().dims
        ('y', 'x', 'wavelength')
        """
        return self._difference("signed", side, brighter_than, None)

    def adm(
        self,
        side: str = "reflected",
        *,
        brighter_than: float = 0.2,
        noise: float | None = 0.2,
        known_to: float = 0.001,
    ) -> xr.DataArray:
        """Return the mean of abs(S0 - U) / U over wavelengths, pixel by pixel.

        The largest over pixels is what is published; it depends on how dim a pixel may be, on how
        large the pixels are, and on their noise, all of which stand in ``attrs``. It is somewhat
        too large, as the largest of noisy numbers is: by one or two of their standard errors.

        Parameters
        ----------
        side : {"reflected", "transmitted"}, optional
            Above the sample, or below.
        brighter_than : float, optional
            NaN where U is less than so many times its mean over the pixels of the hemisphere, both
            averaged over the wavelengths.
        noise : float or None, optional
            NaN where the standard error is more than this share of the difference; None is any.
        known_to : float, optional
            A pixel whose standard error is no more than this is not left out as noisy.

        Returns
        -------
        xarray.DataArray
            (y, x); its standard error is its coordinate ``se``.

        Raises
        ------
        SurfaceError
            If one of the two was not measured, what is given is none of the above, or there are
            too few photons to know the noise.

        Notes
        -----
        M. Wang et al., Virtual ellipsometry on layered micro-facet surfaces, Optics Express 25,
        22971 (2017), who name them ADM and MDM.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.load_sample("glass-on-glass"), "60 deg", 200_000, sensor=16)
        >>> adm = found.adm()
        >>> print(0.05 < float(adm.max()) < 0.3, adm.attrs["pixels"])
        True 16 x 16, equidistant
        >>> print(adm.attrs["mask"])
        light without polarisation above 0.2 of the mean over the hemisphere's pixels, standard \
error at most 0.2 of the difference, or at most 0.001
        """
        return self._difference("adm", side, brighter_than, noise, known_to)

    def mdm(
        self,
        side: str = "reflected",
        *,
        brighter_than: float = 0.2,
        noise: float | None = 0.2,
        known_to: float = 0.001,
    ) -> xr.DataArray:
        """Return the largest abs(S0 - U) / U over wavelengths, pixel by pixel.

        Parameters
        ----------
        side, brighter_than, noise, known_to : optional
            As `adm` takes them.

        Returns
        -------
        xarray.DataArray
            (y, x); its standard error is its coordinate ``se``.

        Raises
        ------
        SurfaceError
            As `adm` raises it.
        """
        return self._difference("mdm", side, brighter_than, noise, known_to)

    def _difference(self, measure: str, *given: Any) -> xr.DataArray:
        from optipath.surfaces.hemispheres.difference_map import (  # noqa: PLC0415 - an extra
            difference_map,
        )

        return difference_map(self, measure, *given)
