"""Light by wavelength: what it comes to over all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from optipath.light.wavelength_on_demand import WavelengthOnDemand, wavelengths_for

if TYPE_CHECKING:
    from optipath.light.colour.srgb import Srgb
    from optipath.values.roundings import Array


class SpectralLight(WavelengthOnDemand):
    """What can be done with light whose intensity is per nanometre of wavelength."""

    def at_wavelengths(self, wavelengths: Any) -> Self:
        """Return the same light, known to be of some wavelengths.

        Parameters
        ----------
        wavelengths : array_like
            In metres, or texts with units; they broadcast to the shape of the light.

        Returns
        -------
        Light

        Raises
        ------
        ParameterError
            If they are no wavelengths.
        ShapeError
            If they do not broadcast to the shape of the light.

        Examples
        --------
        >>> from optipath import Light
        >>> light = Light([[1.0, 0.2, 0.0, 0.0], [3.0, 0.0, 0.0, 0.0]])
        >>> light.at_wavelengths(["500 nm", "600 nm"]).integrate().stokes.round(9)
        array([200.,  10.,   0.,   0.])
        """
        light = object.__new__(type(self))
        vars(light).update(vars(self), _wavelength=wavelengths_for(self.shape, wavelengths))
        return light

    def integrate(self, response: Any = None, edges: Any = None) -> Self:
        """Return the light of all wavelengths together, without their axis.

        The light is per nanometre of wavelength, and linear between its wavelengths: the
        trapezoidal rule, of which each wavelength has the bin that reaches halfway to its
        neighbours. The result is the same alone and in batches, to the last bit.

        Parameters
        ----------
        response : float, array_like of shape (n,), Spectrum or Curve, optional
            What the light of each wavelength is multiplied by, as a `Detector` takes it: numbers
            that are not negative, or what gives them by ``response.at(wavelengths)``, and no
            power in bins or lines.
        edges : array_like, shape (n + 1,), optional
            The edges of the bins, in metres or as texts with units: what comes in each is
            the density there times the width. Light of one wavelength has one bin, two edges.

        Returns
        -------
        Light
            In the same frame, in the unit of the power.

        Raises
        ------
        LightError
            If the wavelengths are not known or no grid along one axis, or frames differ.
        ShapeError, ValueFault, ParameterError
            If the response or the edges do not fit.

        Examples
        --------
        >>> from optipath import Light
        >>> light = Light([[1.0, 0.2, 0.0, 0.0]] * 3, wavelength=["500 nm", "550 nm", "600 nm"])
        >>> light.integrate().stokes.round(9)
        array([100.,  20.,   0.,   0.])
        >>> print(light.integrate(response=[0.0, 1.0, 0.0]).intensity.round(9))
        50.0
        """
        from optipath.light.integration import integrated  # noqa: PLC0415 - hardly ever

        summed = integrated(self, response, edges)
        return self.of(*summed, measured=self.is_measured)  # type: ignore[attr-defined, no-any-return]

    def to_xyz(
        self,
        white: Any = None,
        observer: str = "CIE 1931 2 deg",
        *,
        outside: str = "dark",
    ) -> Array:
        """Return the tristimulus values X, Y and Z of spectral light, of shape (..., 3).

        The light is linear between its wavelengths, and summed up with the colour-matching
        functions of CIE 018:2019 at every whole nanometre and at its own wavelengths.

        Parameters
        ----------
        white : Light or Spectrum, optional
            What has Y = 1, such as the light of the same path without the sample. Without it,
            the values are 683 lm/W times the integral: of a power in watts, Y is in lumens.
        observer : {"CIE 1931 2 deg"}, optional
            The standard observer.
        outside : {"dark", "nearest"}, optional
            What the light is beyond its wavelengths: there is none, or, as CIE 15:2018 allows
            for smooth spectra, as much as at the last one.

        Returns
        -------
        ndarray, shape (..., 3)
            Without the axis of the wavelengths.

        Raises
        ------
        LightError
            If the wavelengths are not known or no grid along one axis.
        ValueFault
            If the observer is unknown, or white is dark.

        Warns
        -----
        ColourWarning
            If the wavelengths leave out some of 380 .. 780 nm, or are more than 20 nm apart.

        Examples
        --------
        >>> import numpy as np
        >>> from optipath import Light
        >>> grid = np.arange(360, 831) * 1e-9
        >>> X, Y, Z = Light([[1.0, 0.0, 0.0, 0.0]] * 471, wavelength=grid).to_xyz()
        >>> print(round(X / (X + Y + Z), 5), round(Y / (X + Y + Z), 5))
        0.33331 0.33329
        """
        from optipath.light.colour.tristimulus import tristimulus  # noqa: PLC0415 - hardly ever

        return tristimulus(self, white, observer, outside)

    def to_srgb(
        self,
        white: Any = None,
        observer: str = "CIE 1931 2 deg",
        *,
        outside: str = "dark",
        adapt: bool = False,
        out_of_gamut: str = "refuse",
    ) -> Srgb:
        """Return the colour of spectral light for a display, by IEC 61966-2-1.

        Parameters
        ----------
        white : Light or Spectrum
            What has Y = 1; see `to_xyz`.
        observer, outside
            As `to_xyz` takes them.
        adapt : bool, optional
            Whether white becomes the white of the display, D65, by the linear Bradford
            transform (ICC.1:2022, annex E); otherwise paper in candlelight is orange.
        out_of_gamut : {"refuse", "clip", "scale", "keep"}, optional
            What becomes of colours that no display of sRGB shows: an error that says how many
            and how far, each component cut to 0 .. 1, mixed with grey of the same Y until none
            is negative and dimmed until none is above 1, or values beyond 0 .. 1.

        Returns
        -------
        Srgb
            Its ``values``, of shape (..., 3), and where the light was ``outside`` of the gamut.

        Raises
        ------
        ValueFault
            If white is not given, or colours are out of gamut and nothing is said of them.
        LightError
            As `to_xyz`, which also warns.

        Examples
        --------
        >>> import numpy as np
        >>> from optipath import Light
        >>> grid = np.arange(360, 831) * 1e-9
        >>> white = Light([[1.0, 0.0, 0.0, 0.0]] * 471, wavelength=grid)
        >>> (0.2 * white).to_srgb(white, adapt=True).hex
        '#7c7c7c'
        """
        from optipath.light.colour.srgb import srgb_of  # noqa: PLC0415 - hardly ever

        return srgb_of(self, white, (observer, outside), adapt=adapt, out_of_gamut=out_of_gamut)
