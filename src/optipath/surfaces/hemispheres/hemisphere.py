"""Hemisphere: what a sample makes of light, seen from all directions at once."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from optipath.surfaces.files.saved_by_name import Saving
from optipath.surfaces.hemispheres.facet_modelling import FacetModelling
from optipath.surfaces.hemispheres.pixel_light import PixelLight
from optipath.surfaces.hemispheres.polarization_effect import PolarizationEffect
from optipath.surfaces.hemispheres.toward import Toward

if TYPE_CHECKING:
    import xarray as xr


class Hemisphere(PixelLight, FacetModelling, Saving, PolarizationEffect, Toward):
    """The Mueller matrix of each pixel of a hemisphere, and what it is without polarisation.

    `measure` makes them. The light of a pixel is the share of the light on the sample that goes
    into it. Light comes in a frame with x horizontal, perpendicular to the plane of incidence; it
    leaves with x perpendicular to the meridional plane of its direction, (0, 0, 1) cross
    direction, and (0, 1, 0) along the normal. What it is made of are the attributes of
    `MeasuredPixels`.

    Examples
    --------
    >>> from optipath.surfaces.hemispheres.measure import measure
    >>> from optipath.surfaces.samples.sample import Sample
    >>> measure(Sample([(0.5 + 2.1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
    Hemisphere of Sample([((0.5+2.1j), 0.3)]) at 40 deg, 16 x 16 pixels, 16384 photons
    """

    @cached_property
    def dataset(self) -> xr.Dataset:
        """All of it with names, units and standard errors: see `hemisphere_dataset`."""
        from optipath.surfaces.hemispheres.hemisphere_dataset import (  # noqa: PLC0415 - an extra
            hemisphere_dataset,
        )

        return hemisphere_dataset(self)

    def __repr__(self) -> str:
        sensor, beam = self.sensor, self.seen.beam
        angle = np.degrees(np.arctan2(beam.sin, beam.cos))
        return (
            f"Hemisphere of {beam.sample!r} at {angle:.4g} deg, {sensor.pixels} x {sensor.pixels} "
            f"pixels, {f'{self.photons} photons' if self.photons else 'known without photons'}"
        )
