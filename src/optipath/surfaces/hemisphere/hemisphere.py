"""Hemisphere: what a sample makes of light, seen from all directions at once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.elements.mueller_element import MuellerElement
from optipath.errors import PhotonWarning, SurfaceError, ValueFault
from optipath.faults import shown, unknown
from optipath.kernels.facets import MASKINGS
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.light.quantities import DERIVED
from optipath.materials.quantities import ANGLE
from optipath.surfaces.facet_model import alpha_of, frame_along, reflected_once
from optipath.surfaces.hemisphere.beam import PixelMask
from optipath.surfaces.walk.beam import UNPOLARISED, state_argument
from optipath.values.angles import warn
from optipath.values.arrays import first_place, same
from optipath.values.precision import Numbers, whole_number
from optipath.values.units import format_quantity
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike

    import xarray as xr

    from optipath.kernels.facets import Masking
    from optipath.surfaces.hemisphere.beam import PartSums, SensedBeam, Side
    from optipath.surfaces.hemisphere.sensor import Sensor


ROUNDED = 64.0 * np.finfo(float).eps
"""By how much of a pixel's light sums over photons are rounded, with room."""

_FEW_PIXELS = 4.0
"""So near the normal frames turn so much within a pixel that a hundredth of S1, S2 is lost."""

_SAME = 1e-9
"""By how much of itself a wavelength may differ from the one that is meant."""

_QUANTITIES = {each.variable: each for each in DERIVED}


@dataclass(frozen=True, eq=False, repr=False)
class Hemisphere:
    """The Mueller matrix of each pixel of a hemisphere, and what it is without polarisation.

    `measure` makes them. The light of a pixel is the share of the light on the sample that goes
    into it. Light comes in a frame with x horizontal, perpendicular to the plane of incidence; it
    leaves with x perpendicular to the meridional plane of its direction, (0, 0, 1) cross
    direction, and (0, 1, 0) along the normal. Wavelengths are in metres, of shape (wavelengths,).

    Each method of its light gives an `xarray.DataArray` over (side, y, x, wavelength), and what it
    is of, with units. Its coordinate ``se`` is the standard error of each of its numbers: by the
    jackknife, so that ratios and angles have theirs; NaN where all photons of a pixel are of one
    part.

    What `relative_difference`, `adm` and `mdm` tell is of unpolarised light on the sample, whose
    light in a pixel is S0, and U where each reflection and refraction is taken by its mean over
    both polarisations: measured with polarisation and without, on the same photons.

    It stands in paths by its light toward one direction, or several. A direction is an angle in
    the plane of incidence, from the normal on the side of the sample where light goes, a text or a
    number in radians: ``"60 deg"`` is where light of this incidence is mirrored to, ``"-60 deg"``
    where it came from. Or it is the unit vector in which light travels. Several are a list of
    texts, or vectors of shape (..., 3). What goes toward a direction is what falls on its pixel;
    on the border of pixels, on all of them together (`Sensor.around`).

    Attributes
    ----------
    seen : SensedBeam
        What was walked, and how it was seen.
    parts : PartSums
        Of the photons, as they were counted.
    wavelengths : ndarray, shape (wavelengths,)
        In metres; NaN where the media do not depend on it.
    symmetric : bool
        Whether the pixels are means with their mirror images.

    Examples
    --------
    >>> from optipath.surfaces.hemisphere.measure import measure
    >>> from optipath.surfaces.sample import Sample
    >>> measure(Sample([(0.5 + 2.1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
    Hemisphere of Sample([((0.5+2.1j), 0.3)]) at 40 deg, 16 x 16 pixels, 16384 photons
    """

    seen: SensedBeam
    parts: PartSums
    wavelengths: Numbers
    symmetric: bool

    @cached_property
    def dataset(self) -> xr.Dataset:
        """All of it with names, units and standard errors: see `hemisphere_dataset`."""
        return _arrays().hemisphere_dataset(self)  # type: ignore[no-any-return]

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

    def brdf(self, *, polarized: bool = True) -> xr.DataArray:
        """Return the light of each pixel per steradian, over the cosine of its centre.

        The Mueller matrix, (side, y, x, wavelength, out, in), or what there is without
        polarisation; NaN where the centre of a pixel is beyond the horizon. Of the lower
        hemisphere it is the BTDF.

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
        """Return the Stokes vector of the light that goes into each pixel, in its frame.

        The source is the Stokes vector of the light that comes in, in the frame whose x is
        horizontal; where its S0 is 1, it is the share of its light that goes into each pixel,
        (side, y, x, wavelength, out).

        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
        >>> light = found.stokes([1.0, 1.0, 0.0, 0.0]).sel(out="S0", side="reflected")
        >>> print(light.sum().round(6).item())
        1.0
        """
        state = np.array(state_argument("source", source))
        result = self.own.estimate(lambda light: self.matrices(light) @ state)
        what = "Stokes vector of the light that goes into the pixel"
        return self._array("stokes", result, what, "1", ("out",), source=state)

    def dop(self, source: npt.ArrayLike = UNPOLARISED) -> xr.DataArray:
        """Return the degree of polarisation of each pixel; NaN where no light falls.

        The source is as `stokes` takes it. Noise makes it larger: where it is no larger than a few
        of its errors, it may be 0.
        """
        return self._quantity("DoP", source)

    def dolp(self, source: npt.ArrayLike = UNPOLARISED) -> xr.DataArray:
        """Return the degree of linear polarisation of each pixel; NaN where no light falls.

        The source is as `stokes` takes it.

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
        """Return the angle of polarisation of each pixel in radians; NaN where there is none.

        The source is as `stokes` takes it. In full, in (-pi/2, pi/2], from x of the pixel's frame
        towards y; M. Wang et al., Optics Express 25(19), 2017, fold it into 0 .. 45 deg. Its
        error knows that an angle a little below pi/2 is near one a little above -pi/2; from 0.9
        rad (52 deg) on, that of angles anywhere, nothing is known of it.
        """
        return self._quantity("AoP", source, period=np.pi)

    def single_scattering(self, masking: Masking = "smith", points: int = 6) -> xr.DataArray:
        """Return the Mueller matrices of light that the topmost facets reflect once, by the model.

        `optipath.surfaces.single_scattering`, times the cosine, over the solid angle of each
        pixel: what ``measure(..., events=1)`` finds by photons, where the surface is one of
        heights in which it is by chance alone what hides what.

        Parameters
        ----------
        masking : {"smith", "separate", "none"}, optional
            As the model takes it.
        points : int, optional
            How many points there are along each side of a pixel; more for few pixels, or a lobe
            that is narrower than they are.

        Returns
        -------
        xarray.DataArray
            (side, y, x, wavelength, out, in), of the reflected side: shares of the light on the
            sample, as ``dataset.mueller`` has them, in the same frames.

        Raises
        ------
        SurfaceError
            If the topmost surface has no alpha above 0, and so no density of slopes.

        Examples
        --------
        >>> import optipath as op
        >>> sample = op.Sample([(0.5 + 2.1j, 0.3)])
        >>> found = op.measure(sample, "40 deg", photons=16_384, sensor=16, events=1)
        >>> model, measured = found.single_scattering(), found.dataset.mueller
        >>> model.dims == measured.dims
        True
        """
        faults = unknown("masking", masking, MASKINGS) + whole_number("points", points)
        alpha = alpha_of(self.seen.beam.sample)
        if alpha is None:
            faults.append(
                "the topmost surface has no alpha above 0, and the model takes a density of "
                "slopes; measure with events=1"
            )
        if faults or alpha is None:
            raise SurfaceError(*faults)
        result = reflected_once(self.seen, alpha, masking, int(points))[np.newaxis]
        what = "Mueller matrix of light that is reflected once, by the analytic model"
        return self._array("single_scattering", (result, None), what, "1", ("out", "in"))

    def relative_difference(
        self, side: Side = "reflected", *, brighter_than: float = 0.2
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

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.load_sample("glass-on-glass"), "60 deg", 100_000, sensor=16)
        >>> found.relative_difference().dims
        ('y', 'x', 'wavelength')
        """
        mask, told = PixelMask(brighter_than, None), "(S0 - U) / U"
        return self._difference("relative_difference", told, np.asarray, side, mask)

    def adm(
        self,
        side: Side = "reflected",
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
        told = "mean of |S0 - U| / U over wavelengths"
        mask = PixelMask(brighter_than, noise, known_to)
        return self._difference("adm", told, lambda each: np.abs(each).mean(axis=-1), side, mask)

    def mdm(
        self,
        side: Side = "reflected",
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
        """
        told = "largest |S0 - U| / U over wavelengths"
        mask = PixelMask(brighter_than, noise, known_to)
        return self._difference("mdm", told, lambda each: np.abs(each).max(axis=-1), side, mask)

    def toward(
        self, direction: Any, side: Side = "reflected", wavelength: Any = None
    ) -> MuellerElement:
        """Return the sample as an element, by whose matrix light goes toward a direction.

        The matrix is the share of the light on the sample that goes into the pixel: S0 behind it
        is a power for a power, not per solid angle. The frame of ``in`` has its x perpendicular to
        the plane of incidence, as that of an `Interface`; that of ``out`` perpendicular to the
        meridional plane of the direction, along (0, 0, 1) cross direction. In the plane of
        incidence both are s. `frames_toward` has them in space.

        Parameters
        ----------
        direction : float, str or array_like
            An angle in the plane of incidence, or a unit vector; or several.
        side : {"reflected", "transmitted"}, optional
            Above the sample, or below.
        wavelength : float or str, optional
            In metres, or a text such as ``"550 nm"``, where several have been measured.

        Returns
        -------
        MuellerElement
            With a matrix for each direction.

        Raises
        ------
        SurfaceError
            If light of the direction is not above the sample, or below where it is transmitted; if
            none falls on the pixel, by chance more than comes in, or no Mueller matrix has been
            measured; if it is not said which of several wavelengths is meant.

        Warns
        -----
        PhotonWarning
            If a direction is within four pixels of the normal, about which the frames of the
            photons of one pixel turn: their sum has lost linear polarisation, by the share
            1 / (6 r^2) at r pixels.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.1)]), "45 deg", photons=16_384, sensor=31)
        >>> path = op.Source() >> op.Polarizer("30 deg") >> found.toward("45 deg") >> op.Detector()
        >>> print(0.9 < path.trace().dop < 1.0)
        True
        """
        pixels = self._toward(direction, side, wavelength)
        z = self.frames_toward(direction, side)["out"].z
        near = 0.5 * self.sensor.pixels * self.sensor.radius(z) < _FEW_PIXELS
        if not self.seen.beam.sample.is_flat and np.any(near):
            warn(
                f"direction{first_place(near)} ({shown(direction)}) is within {_FEW_PIXELS:.0f} "
                f"pixels of the normal, where frames turn within a pixel and linear polarisation "
                f"is lost; measure with more and smaller pixels",
                PhotonWarning,
            )
        matrices, _ = pixels.estimate(self.matrices)
        if np.any(dark := matrices[..., 0, 0] == 0.0):
            raise SurfaceError(
                f"no light has fallen on the pixel of direction{first_place(dark)} "
                f"({shown(direction)}); measure with more photons or larger pixels, and of a flat "
                f"sample give the direction into which all light goes"
            )
        try:
            return MuellerElement(matrices, straight=False)
        except ValueFault:
            raise SurfaceError(
                f"by chance, {self.photons} photons bring more light of some polarisation to the "
                f"pixel than falls on the sample; measure with more photons"
            ) from None

    def estimate_toward(
        self,
        found: Callable[[Numbers], Any],
        direction: Any,
        side: Side = "reflected",
        wavelength: Any = None,
    ) -> tuple[Numbers, Numbers]:
        """Return what follows from the matrix toward a direction, and its standard error.

        Parameters
        ----------
        found : callable
            Takes Mueller matrices, of shape (4, 4) or (..., 4, 4) for several directions, and
            returns what follows from them.
        direction, side, wavelength
            As `toward` takes them.

        Returns
        -------
        value, error : ndarray
            The error is that of the jackknife, as all of a hemisphere's.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1.5, 0.1)]), "56 deg", photons=16_384, sensor=15)
        >>> share, error = found.estimate_toward(lambda matrix: matrix[0, 0], "56 deg")
        >>> print(0.0 < error < 0.1 * share)
        True
        """
        pixels = self._toward(direction, side, wavelength)
        return pixels.estimate(lambda light: found(self.matrices(light)))

    def frames_toward(self, direction: Any, side: Side = "reflected") -> dict[str, Frame]:
        """Return the frames in space of what `toward` returns, as `PathGraph.add` takes them.

        Parameters
        ----------
        direction : float, str or array_like
            As `toward` takes it.
        side : {"reflected", "transmitted"}, optional
            Above the sample, or below.

        Returns
        -------
        dict of str to Frame
            ``in`` and ``out``; z is up from the sample.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.0)]), "45 deg", sensor=31)
        >>> frames = found.frames_toward("45 deg")
        >>> print(frames["in"].x, frames["in"].z.round(3), frames["out"].z.round(3))
        [0. 1. 0.] [ 0.707  0.    -0.707] [0.707 0.    0.707]
        """
        self.side(side)
        beam, up = self.seen.beam, side == "reflected"
        return {"in": beam.frame, "out": direction_of(direction, beam.plane_azimuth, up=up)}

    def save(
        self,
        path: str | PathLike[str],
        *,
        source: npt.ArrayLike | None = None,
        side: Side | None = None,
    ) -> None:
        """Write the hemisphere into a file, whose ending says the form.

        ``.zarr`` and ``.nc`` (NetCDF) hold the `dataset`, which xarray opens, and the sums over
        photons, so that `load_hemisphere` gives back all that was measured, bit for bit. ``.exr``
        is a picture of the light of one source in single precision: radiances in W / (m^2 sr) for
        an irradiance of the sample of 1 W / m^2, in channels ``S0.550,000000nm`` by wavelength (A.
        Fichet, R. Pacanowski and A. Wilkie, An OpenEXR Layout for Spectral Images, JCGT 10(3),
        2021) or ``S0.Y`` where there is none, and ``Y``, the mean of S0.

        Parameters
        ----------
        path : str or PathLike
            A name that ends in .zarr, .nc or .exr. It is there whole or not at all: what was there
            stays until then. A folder that is no hemisphere is not replaced.
        source : array_like, shape (4,), optional
            For a picture, the Stokes vector of the light that comes in, as `stokes` takes it, whose
            S0 counts as 1; unpolarised by default.
        side : {"reflected", "transmitted"}, optional
            For a picture, of which hemisphere; needed where there are two.

        Raises
        ------
        SurfaceError
            If the name has another ending, or it cannot be written there; with all faults of what
            is asked for.
        MissingExtraError
            If Zarr, h5netcdf or OpenEXR is not installed.

        Examples
        --------
        >>> from pathlib import Path
        >>> from tempfile import TemporaryDirectory
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
        >>> with TemporaryDirectory() as folder:
        ...     found.save(Path(folder, "mirror.nc"))
        ...     again = op.load_hemisphere(Path(folder, "mirror.nc"))
        >>> bool((again.mueller[1] == found.mueller[1]).all()), again.seen.beam.sample
        (True, Sample([(1j, 0.3)]))
        """
        from optipath.surfaces.formats.hemisphere_files import (  # noqa: PLC0415 - knows hemispheres
            save_hemisphere,
        )

        save_hemisphere(self, path, source, side)

    def matrices(self, light: Numbers) -> Numbers:
        """Return the Mueller matrices (..., 4, 4) among the numbers of `PartSums.estimate`."""
        if self.seen.polarized == "scalar":
            raise SurfaceError(_missing("Mueller matrix", "polarized"))
        return light[..., :16].reshape(*light.shape[:-1], 4, 4)

    def intensities(self, light: Numbers) -> Numbers:
        """Return the light without polarisation among the numbers of `PartSums.estimate`."""
        if self.seen.polarized == "polarized":
            raise SurfaceError(_missing("light without polarisation", "scalar"))
        return light[..., -1]

    def scalar_light(self, side: int) -> Numbers:
        """Return the light without polarisation by which pixels (rows, columns) of a side count.

        The sum over photons, the mean over wavelengths; NaN beyond the horizon.
        """
        light = self.intensities(self.own.sums.sum(axis=0))[side].mean(axis=-1)
        return np.where(np.isnan(self.sensor.theta), np.nan, light)

    def side(self, name: Any) -> int:
        """Return the place of a hemisphere: that of "reflected" light, or "transmitted"."""
        sides = self.seen.sides
        if name not in sides:
            why = ": nothing goes through an opaque sample" if name == "transmitted" else ""
            raise SurfaceError(f"no side is called {shown(name)}{why}; give {' or '.join(sides)}")
        return sides.index(name)

    def _quantity(
        self, variable: str, source: npt.ArrayLike, period: float | None = None
    ) -> xr.DataArray:
        """Return a quantity of `Light`, the same in any frame or an angle of some period."""
        state, quantity = np.array(state_argument("source", source)), _QUANTITIES[variable]

        def value(light: Numbers) -> Numbers:
            matrices = self.matrices(light)
            noise = ROUNDED * state[0] * matrices[..., 0, 0]
            return quantity.of(Light.of(matrices @ state, Frame(), noise=noise, measured=True))

        whole, error = self.own.estimate(value)
        if period is not None:
            _, error = self.own.estimate(
                lambda light: np.remainder(value(light) - whole + period / 2.0, period)
            )
        name = quantity.variable.lower()
        return self._array(name, (whole, error), quantity.name, quantity.unit, source=state)

    def _array(self, *arguments: Any, **attributes: Any) -> xr.DataArray:
        return _arrays().pixel_array(self, *arguments, **attributes)  # type: ignore[no-any-return]

    def _difference(self, *arguments: Any) -> xr.DataArray:
        return _arrays().difference_map(self, *arguments)  # type: ignore[no-any-return]

    def _toward(self, direction: Any, side: Side, wavelength: Any) -> PartSums:
        """Return the sums over the pixels of each direction."""
        place, z = self.side(side), self.frames_toward(direction, side)["out"].z
        light = wavelength_place(self.wavelengths, wavelength)
        sums = self.own.sums[:, place, :, :, light]
        pixels = [self.sensor.around(each) for each in z.reshape(-1, 3)]
        results = [sums[:, rows, columns].sum(axis=1) for rows, columns in pixels]
        shape = (len(sums), *z.shape[:-1], sums.shape[-1])
        seen: PartSums = self.own._replace(sums=np.stack(results, axis=1).reshape(shape))
        return seen

    def __eq__(self, other: object) -> Any:
        if not isinstance(other, Hemisphere):
            return NotImplemented
        mine, its = ((each.seen, each.parts, each.symmetric) for each in (self, other))
        # No wavelength is NaN, which is here the same as itself.
        alike = np.array_equal(self.wavelengths, other.wavelengths, equal_nan=True)
        return alike and same(mine, its)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        pixels, beam = self.sensor.pixels, self.seen.beam
        of = f"{beam.sample!r} at {np.degrees(beam.incidence):.4g} deg"
        known = f"{self.photons} photons" if self.photons else "known without photons"
        return f"Hemisphere of {of}, {pixels} x {pixels} pixels, {known}"


def _arrays() -> Any:
    from optipath.surfaces.hemisphere import arrays  # noqa: PLC0415 - an extra

    return arrays


def _missing(what: str, kind: str) -> str:
    return f"the {what} has not been measured; measure with polarized='both' or '{kind}'"


def direction_of(argument: Any, azimuth: float, *, up: bool) -> Frame:
    """Return the frame of light toward a direction, or several (..., 3)."""
    with SurfaceError.wrapping():
        entries = np.asarray(argument, dtype=object)
        # An angle, or several as texts; numbers in a row are a vector.
        if entries.ndim == 0 or isinstance(next(entries.flat, None), str):
            angle = np.asarray(ANGLE.check("direction", argument))
            # From 3 quarter turns on, a vector would point to the right side again.
            if np.any(beyond := np.abs(angle) >= np.pi / 2.0):
                worst = float(angle[beyond].flat[0])
                raise SurfaceError(
                    f"direction is {worst:.6g} rad ({np.degrees(worst):.6g} deg) from the normal; "
                    f"give an angle in the plane of incidence below 90 deg, such as '45 deg'"
                )
            sin, height = np.sin(angle), np.cos(angle) if up else -np.cos(angle)
            # Adding 0 turns -0 into 0.
            parts = [sin * np.cos(azimuth), sin * np.sin(azimuth), height]
            argument = np.stack(parts, axis=-1) + 0.0
        return frame_along("direction", argument, up=up)


def wavelength_place(known: Numbers, argument: Any) -> int:
    """Return the place of a wavelength among measured ones, in metres."""
    if argument is None and len(known) == 1:
        return 0
    with SurfaceError.wrapping():
        wanted = np.ravel(np.nan if argument is None else Wavelength().resolve(argument).value)
    nearest = int(np.argmin(np.abs(known - wanted[0]))) if wanted.size == 1 else 0
    if wanted.size != 1 or not abs(known[nearest] - wanted[0]) <= _SAME * wanted[0]:
        several = " or ".join(format_quantity(float(each), "nm") for each in known)
        which = "none, since nothing of the sample depends on it" if np.isnan(known[0]) else several
        raise SurfaceError(f"wavelength is {shown(argument)}, and measured is {which}; give that")
    return nearest
