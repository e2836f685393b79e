"""What the analytic facet model puts into the pixels of a hemisphere."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.light.frame import Frame
from optipath.light.mueller import Mueller
from optipath.surfaces.facet_model import single_scattering
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.hemisphere.sensor import pixel_points

if TYPE_CHECKING:
    from optipath.surfaces.hemisphere.beam import SensedBeam
    from optipath.surfaces.walk.beam import PhotonBeam
    from optipath.values.precision import Numbers


def alpha_of(beam: PhotonBeam) -> tuple[float, float] | None:
    """Return alpha of the topmost surface along x and y; None where it has none above 0."""
    rough = beam.sample.layers[0].roughness
    alpha = rough.alpha if isinstance(rough, HeightField) else rough
    return alpha if alpha and alpha != (0.0, 0.0) else None


def reflected_once(
    seen: SensedBeam, alpha: tuple[float, float], masking: str, points: int
) -> Numbers:
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
        result = single_scattering(
            below,
            alpha[0],
            down,
            directions[:, :, np.newaxis],
            outside=indices.outside,
            alpha_y=alpha[1],
            masking=masking,
        )
        weight = (areas * directions[..., 2])[..., np.newaxis, np.newaxis, np.newaxis]
        total += (result @ comes).matrix * weight
    return total
