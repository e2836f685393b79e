"""What polarisation makes of light on a sample whose interfaces are flat: exact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.paths.polarization_matters import polarization
from optipath.surfaces.samples.smooth_path import smooth_path

if TYPE_CHECKING:
    from optipath.surfaces.samples.sample_indices import SampleIndices


def smooth_difference(indices: SampleIndices, incidence: Any, side: str) -> float:
    """Return (S0 - U) / U of all unpolarised light that a smooth sample sends to one side.

    Units: incidence in radians.

    Examples
    --------
    >>> from optipath.surfaces.samples.sample import Sample
    >>> indices = Sample([(1.5, 0.1), (2.4, 0.1)]).indices()
    >>> print(round(100.0 * smooth_difference(indices, "60 deg", "reflected"), 3))
    -2.9
    """
    found = np.ravel(polarization(smooth_path(indices, side), incidence=incidence).difference)
    return float(found[np.argmax(np.abs(found))])
