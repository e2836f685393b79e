"""The Dataset of a hemisphere: what is known of each pixel, with names and units."""

from __future__ import annotations

from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from optipath.errors import SurfaceError
from optipath.surfaces.hemispheres.pixel_array import FRAME, PIXELS, coordinates

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere


def hemisphere_dataset(hemisphere: Hemisphere) -> xr.Dataset:
    """Return the Dataset of a hemisphere.

    Units: the result in radians.
    """
    sensor, polarized = hemisphere.sensor, hemisphere.seen.polarized
    found: dict[str, Any] = {}
    if polarized != "scalar":
        found |= _with_error("mueller", (*PIXELS, "out", "in"), hemisphere.mueller, _MUELLER)
    if polarized != "polarized":
        found |= _with_error("scalar", PIXELS, hemisphere.scalar, _SCALAR)
    if polarized == "both":
        found |= _with_error("difference", PIXELS, hemisphere.difference, _DIFFERENCE)
    found["count"] = PIXELS[:3], hemisphere.parts.counts, {"long_name": "photons", "units": "1"}
    area = {"long_name": "solid angle of the pixel above the horizon", "units": "sr"}
    found["solid_angle"] = PIXELS[1:3], sensor.solid_angle, area
    return xr.Dataset(
        found, coordinates(hemisphere, (*PIXELS, "out", "in")), _attributes(hemisphere)
    )


_MUELLER = "Mueller matrix: share of the light on the sample that goes into the pixel"
_SCALAR = "share of the light that goes into the pixel, without polarisation"
_DIFFERENCE = "share of unpolarised light that goes into the pixel, less that without polarisation"


def _with_error(name: str, dims: tuple[str, ...], found: Any, what: str) -> dict[str, Any]:
    value, error = found
    told = {"units": "1"}
    return {
        name: (dims, value, {"long_name": what, **told}),
        f"{name}_se": (dims, error, {"long_name": f"standard error of '{name}'", **told}),
    }


def _attributes(hemisphere: Hemisphere) -> dict[str, Any]:
    seen = hemisphere.seen
    beam = seen.beam
    return {
        "sample": _toml(hemisphere),
        "incidence": float(np.arctan2(beam.sin, beam.cos)),
        "azimuth": "each photon its own" if beam.sample.isotropic else beam.azimuth,
        "photons": hemisphere.photons,
        "seed": beam.seed,
        "events": "any number" if seen.events is None else seen.events,
        "most_events": beam.most_events,
        "polarized": seen.polarized,
        "projection": hemisphere.sensor.projection,
        "symmetric": int(hemisphere.symmetric),
        "frame": FRAME,
        "optipath_version": version("optipath"),
    }


def _toml(hemisphere: Hemisphere) -> str:
    try:
        return hemisphere.seen.beam.sample.to_toml()
    except SurfaceError as fault:
        return f"the sample cannot be written here, since it has no form in TOML: {fault}"
