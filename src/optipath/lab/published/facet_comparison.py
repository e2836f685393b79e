"""FacetComparison: the single-scattering model beside what photons do, pixel by pixel."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.surfaces.facets.facet_model import single_scattering

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

Numbers = npt.NDArray[np.float64]

FARTHEST = np.radians(60.0)
"""Up to which angle to the normal pixels are compared: 30 deg from grazing."""

_SIDE = 32
"""How many blocks of pixels there are along a side, whose light is compared."""


class LargestOff(NamedTuple):
    """How far the model is off where it is farthest, and the standard error there.

    Attributes
    ----------
    off, error : float
        Over the largest S0.
    """

    off: float
    error: float


@dataclass(frozen=True, eq=False)
class FacetComparison:
    """The light of one rough surface, by photons and by the single-scattering model.

    Attributes
    ----------
    hemisphere : Hemisphere
        Photons after any number of events, or after one.
    """

    hemisphere: Hemisphere

    @cached_property
    def model(self) -> Numbers:
        """The Stokes vectors of the pixels, of unpolarised light: (rows, columns, 4)."""
        seen = self.hemisphere.seen
        beam, sensor = seen.beam, self.hemisphere.sensor
        if len(beam.sample.layers) > 1 or not beam.sample.isotropic:
            raise SurfaceError(
                "the single-scattering model is compared with one interface of one alpha; give a "
                "sample of one such layer"
            )
        alpha = beam.sample.fields()[0].alpha
        there = ~np.isnan(sensor.theta)
        up = np.where(there[..., np.newaxis], sensor.directions, (0.0, 0.0, 1.0))
        index, outside = beam.indices.base, beam.indices.outside
        brdf = single_scattering(
            np.ravel(index)[0], alpha[0] if alpha else 0.0, (beam.sin, 0.0, -beam.cos), up,
            outside=outside,
        )  # fmt: skip
        into = (sensor.solid_angle * up[..., 2])[..., np.newaxis]
        return np.where(there[..., np.newaxis], brdf.matrix[..., 0] * into, np.nan)

    def excess(self, component: int) -> tuple[float, float]:
        """Return by how much the model is above photons, in all: its sum over theirs, less 1.

        Pixels count with the sign that the component has by the model, so that noise cancels.

        Parameters
        ----------
        component : {0, 1, 2}
            That of the Stokes vector.

        Returns
        -------
        value, error : float
        """
        model = np.nan_to_num(self.model[..., component])
        sign, whole = np.sign(model), np.sum(np.abs(model))

        def above(light: Numbers) -> Numbers:
            stokes = np.nan_to_num(self._stokes(light)[..., component])
            return np.asarray(whole / np.sum(stokes * sign) - 1.0)

        value, error = self.hemisphere.own.estimate(above)
        return float(value), float(error)

    def largest_off(self) -> LargestOff:
        """Return where the model is farthest off, of all four components, over the largest S0.

        Blocks of pixels are compared, 32 along a side, whose centres are not within 30 deg of
        grazing.

        Returns
        -------
        LargestOff
        """
        model = _blocks(self.model)
        theta = np.radians(90.0) * np.hypot(*_centres(len(model)))
        near = theta < FARTHEST
        value, error = self.hemisphere.own.estimate(
            lambda light: (_blocks(self._stokes(light)) - model)[near]
        )
        value, error = value / np.max(model[..., 0]), error / np.max(model[..., 0])
        at = np.unravel_index(np.argmax(np.abs(value)), value.shape)
        return LargestOff(float(np.abs(value[at])), float(error[at]))

    def _stokes(self, light: Numbers) -> Numbers:
        found = self.hemisphere.matrices(light)[0, :, :, 0, :, 0]
        return np.where(np.isnan(self.hemisphere.sensor.theta)[..., np.newaxis], np.nan, found)


def _blocks(pixels: Numbers) -> Numbers:
    """Return the sums over square blocks."""
    size = max(len(pixels) // _SIDE, 1)
    side = len(pixels) // size
    whole = np.nan_to_num(pixels[: side * size, : side * size])
    found: Numbers = whole.reshape(side, size, side, size, -1).sum(axis=(1, 3))
    return found


def _centres(side: int) -> tuple[Numbers, Numbers]:
    place = (2.0 * np.arange(side) + 1.0) / side - 1.0
    return place[np.newaxis], place[:, np.newaxis]
