"""A polarised BRDF that is given as a function of directions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown
from optipath.light.mueller.matrix import Mueller
from optipath.surfaces.files.level_pixels import in_frames

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.light.frames import Frame

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True)
class GivenBrdf:
    """A function of the directions in which light comes and goes.

    Units: wavelengths in metres.
    """

    function: Callable[..., Any]
    wavelengths: Numbers

    def at(self, before: Frame, behind: Frame) -> tuple[Numbers, None]:
        """Return the BRDF for light that comes and goes in frames.

        Shapes: before, behind (n,); returns matrices (n, wavelengths, 4, 4).
        """
        found = []
        for wavelength in self.wavelengths:
            at = {} if np.isnan(wavelength) else {"wavelength": float(wavelength)}
            brdf = self.function(before.z, behind.z, **at)
            if not isinstance(brdf, Mueller) or brdf.shape != before.x.shape[:-1]:
                what = f"of shape {brdf.shape}" if isinstance(brdf, Mueller) else shown(brdf)
                raise SurfaceError(
                    f"brdf returns {what}; for {len(before.x)} directions it must return an "
                    f"op.Mueller of shape {before.x.shape[:-1]}"
                )
            found.append(in_frames(brdf, before, behind))
        return np.stack(found, axis=1), None
