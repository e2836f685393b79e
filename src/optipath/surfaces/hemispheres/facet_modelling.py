"""What the analytic facet model puts into the pixels of a hemisphere."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, unknown
from optipath.kernels.facets.smith_masking import MASKINGS
from optipath.light.frames import Frame
from optipath.light.mueller.matrix import Mueller
from optipath.surfaces.facets.facet_model import single_scattering
from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.hemispheres.measured_pixels import MeasuredPixels
from optipath.surfaces.hemispheres.pixel_points import pixel_points
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    import xarray as xr

    from optipath.surfaces.hemispheres.sensed_beam import SensedBeam
    from optipath.surfaces.walk.photon_beam import PhotonBeam

Numbers = npt.NDArray[np.float64]


class FacetModelling(MeasuredPixels):
    """A hemisphere whose pixels are known without photons, as far as light is reflected once."""

    def single_scattering(self, masking: str = "smith", points: int = 6) -> xr.DataArray:
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
        from optipath.surfaces.hemispheres.pixel_array import pixel_array  # noqa: PLC0415 - an extra

        faults = unknown("masking", masking, MASKINGS) + whole_number("points", points)
        alpha = _alpha(self.seen.beam)
        if alpha is None:
            faults.append(
                "the topmost surface has no alpha above 0, and the model takes a density of "
                "slopes; measure with events=1"
            )
        if faults or alpha is None:
            raise SurfaceError(*faults)
        found = _summed(self.seen, alpha, masking, int(points))[np.newaxis]
        return pixel_array(
            self,
            "single_scattering",
            found,
            "Mueller matrix of light that is reflected once, by the analytic model",
            "1",
            ("out", "in"),
        )


def _alpha(beam: PhotonBeam) -> tuple[float, float] | None:
    rough = beam.sample.layers[0].roughness
    alpha = rough.alpha if isinstance(rough, HeightField) else rough
    return alpha if alpha and alpha != (0.0, 0.0) else None


def _summed(seen: SensedBeam, alpha: tuple[float, float], masking: str, points: int) -> Numbers:
    """Return Mueller matrices, (rows, columns, wavelengths, 4, 4)."""
    beam, indices = seen.beam, seen.beam.indices
    below: Any = np.array(indices.inner[:1]) if indices.inner else np.ravel(indices.base)
    azimuth = beam.plane_azimuth
    across = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    along = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    down = beam.sin * along - [0.0, 0.0, beam.cos]
    own = Frame(across, np.cross(down, across), down)
    comes = Mueller(np.eye(4), own, own)
    lights = indices.n.size
    total = np.zeros((*(2 * [seen.sensor.pixels]), lights, 4, 4))
    for directions, areas in pixel_points(seen.sensor, points):
        found = single_scattering(
            below,
            alpha[0],
            down,
            directions[:, :, np.newaxis],
            outside=indices.outside,
            alpha_y=alpha[1],
            masking=masking,
        )
        weight = (areas * directions[..., 2])[..., np.newaxis, np.newaxis, np.newaxis]
        total += (found @ comes).matrix * weight
    return total
