"""A measured sample as an element: what of the light on it goes toward a direction."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.elements.mueller_element import MuellerElement
from optipath.errors import PhotonWarning, SurfaceError, ValueFault, shown
from optipath.light.frames import Frame
from optipath.surfaces.hemispheres.given_estimate import following
from optipath.surfaces.hemispheres.given_toward import direction_of, wavelength_place
from optipath.surfaces.hemispheres.measured_pixels import MeasuredPixels
from optipath.surfaces.samples.sample import Sample
from optipath.values.arrays.shapes import first_place
from optipath.values.calls_up import calls_up

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.surfaces.hemispheres.part_sums import PartSums

Numbers = npt.NDArray[np.float64]

_FEW_PIXELS = 4.0
"""So near the normal frames turn so much within a pixel that a hundredth of S1, S2 is lost."""


class Toward(MeasuredPixels):
    """A hemisphere that stands in paths: its light toward one direction, or several.

    A direction is an angle in the plane of incidence, from the normal on the side of the sample
    where light goes, a text or a number in radians: ``"60 deg"`` is where light of this incidence
    is mirrored to, ``"-60 deg"`` where it came from. Or it is the unit vector in which light
    travels. Several are a list of texts, or vectors of shape (..., 3).

    What goes toward a direction is what falls on its pixel; on the border of pixels, on all of
    them together (`Sensor.around`).
    """

    def toward(
        self,
        direction: Any,
        side: str = "reflected",
        wavelength: Any = None,
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
        self._warn_next_to_normal(direction, side)
        matrices, _ = pixels.estimate(self.matrices)
        if np.any(dark := matrices[..., 0, 0] == 0.0):
            raise SurfaceError(self._nothing_falls(direction, dark, side))
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
        side: str = "reflected",
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

        Raises
        ------
        SurfaceError
            As `toward` does; if ``found`` is no function, or does not return real numbers.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1.5, 0.1)]), "56 deg", photons=16_384, sensor=15)
        >>> share, error = found.estimate_toward(lambda matrix: matrix[0, 0], "56 deg")
        >>> print(0.0 < error < 0.1 * share)
        True
        """
        follows, pixels = following(found), self._toward(direction, side, wavelength)
        return pixels.estimate(lambda light: follows(self.matrices(light)))

    def frames_toward(self, direction: Any, side: str = "reflected") -> dict[str, Frame]:
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

        Raises
        ------
        SurfaceError
            As `toward` does, of the direction.

        Examples
        --------
        >>> import optipath as op
        >>> found = op.measure(op.Sample([(1j, 0.0)]), "45 deg", sensor=31)
        >>> frames = found.frames_toward("45 deg")
        >>> print(frames["in"].x, frames["in"].z.round(3), frames["out"].z.round(3))
        [0. 1. 0.] [ 0.707  0.    -0.707] [0.707 0.    0.707]
        """
        self.side(side)
        beam, azimuth = self.seen.beam, self.seen.beam.plane_azimuth
        c, s = np.cos(azimuth), np.sin(azimuth)
        z, x = np.array([beam.sin * c, beam.sin * s, -beam.cos]), np.array([-s, c, 0.0]) + 0.0
        return {
            "in": Frame(x, np.cross(z, x), z),
            "out": direction_of(direction, azimuth, up=side == "reflected"),
        }

    def _warn_next_to_normal(self, direction: Any, side: str) -> None:
        z = direction_of(direction, self.seen.beam.plane_azimuth, up=side == "reflected").z
        radius = 0.5 * self.sensor.pixels * self.sensor.radius(z)
        sample = self.seen.beam.sample
        is_flat = isinstance(sample, Sample) and sample.is_flat
        if not is_flat and np.any(near := radius < _FEW_PIXELS):
            warnings.warn(
                f"direction{first_place(near)} ({shown(direction)}) is within {_FEW_PIXELS:.0f} "
                f"pixels of the normal, where frames turn within a pixel and linear polarisation "
                f"is lost; measure with more and smaller pixels",
                PhotonWarning,
                calls_up(),
            )

    def _nothing_falls(self, direction: Any, dark: npt.NDArray[np.bool_], side: str) -> str:
        where = f"direction{first_place(dark)} ({shown(direction)})"
        if self.photons:
            return (
                f"no photon has fallen on the pixel of {where}; measure with more photons, or with "
                f"fewer and larger pixels"
            )
        return (
            f"no light goes toward {where}: a flat sample has all of it {side} into one direction, "
            f"in the plane of incidence"
        )

    def _toward(self, direction: Any, side: str, wavelength: Any) -> PartSums:
        """Return the sums over the pixels of each direction."""
        place = self.side(side)
        frame = direction_of(direction, self.seen.beam.plane_azimuth, up=side == "reflected")
        light = wavelength_place(self.wavelengths, wavelength)
        sums = self.own.sums[:, place, :, :, light]
        pixels = [self.sensor.around(z) for z in frame.z.reshape(-1, 3)]
        found = [sums[:, rows, columns].sum(axis=1) for rows, columns in pixels]
        shape = (len(sums), *frame.z.shape[:-1], sums.shape[-1])
        seen: PartSums = self.own._replace(sums=np.stack(found, axis=1).reshape(shape))
        return seen
