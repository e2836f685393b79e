"""Hemispheres as xarray Datasets and DataArrays."""

from __future__ import annotations

from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from optipath.errors import SurfaceError
from optipath.surfaces.hemisphere.beam import PIXELS

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.surfaces.hemisphere.beam import PixelMask
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.values.precision import Numbers


def hemisphere_dataset(hemisphere: Hemisphere) -> xr.Dataset:
    """Return the Dataset of a hemisphere. Units: the result in radians."""
    sensor, polarized = hemisphere.sensor, hemisphere.seen.polarized
    results: dict[str, Any] = {}
    for name, (kind, what) in _NUMBERS.items():
        if polarized in ("both", kind):
            value, error = getattr(hemisphere, name)
            dims = (*PIXELS, "out", "in") if name == "mueller" else PIXELS
            results[name] = dims, value, {"long_name": what, "units": "1"}
            results[f"{name}_se"] = dims, error, _of_error(name)
    results["count"] = PIXELS[:3], hemisphere.parts.counts, {"long_name": "photons", "units": "1"}
    area = {"long_name": "solid angle of the pixel above the horizon", "units": "sr"}
    results["solid_angle"] = PIXELS[1:3], sensor.solid_angle, area
    known = coordinates(hemisphere, (*PIXELS, "out", "in"))
    return xr.Dataset(results, known, _attributes(hemisphere))


_NUMBERS = {
    "mueller": (
        "polarized",
        "Mueller matrix: share of the light on the sample that goes into the pixel",
    ),
    "scalar": ("scalar", "share of the light that goes into the pixel, without polarisation"),
    "difference": (
        "both",
        "share of unpolarised light that goes into the pixel, less that without polarisation",
    ),
}
"""What is known of pixels where it is measured, or both are."""


def _of_error(name: str, units: str = "1") -> dict[str, str]:
    return {"long_name": f"standard error of '{name}'", "units": units}


def _attributes(hemisphere: Hemisphere) -> dict[str, Any]:
    seen, beam = hemisphere.seen, hemisphere.seen.beam
    try:
        sample = beam.sample.to_toml()
    except SurfaceError as fault:
        sample = f"the sample cannot be written here, since it has no form in TOML: {fault}"
    return {
        "sample": sample,
        "incidence": beam.incidence,
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


def difference_map(
    hemisphere: Hemisphere,
    name: str,
    told: str,
    made: Callable[[Numbers], Numbers],
    side: str,
    mask: PixelMask,
) -> xr.DataArray:
    """Return what is made of the relative differences of each pixel, wavelengths last."""
    at = hemisphere.side(side)

    def relative(light: Numbers) -> Numbers:
        scalar = hemisphere.intensities(light)
        return made((hemisphere.matrices(light)[..., 0, 0] - scalar) / scalar)

    value, error = (each[at] for each in hemisphere.own.estimate(relative))
    if mask.noise is not None and np.isnan(error).all():
        raise SurfaceError(
            f"the noise of {hemisphere.photons:,} photons is not known, and pixels are left out by "
            f"it; measure with more photons"
        )
    counts = mask.bright(hemisphere.scalar_light(at))
    counts = counts.reshape(counts.shape + (1,) * (value.ndim - 2)) & mask.known(value, error)
    value, error = (np.where(counts, each, np.nan) for each in (value, error))
    dims = ("y", "x", "wavelength")[: value.ndim]
    se = xr.Variable(dims, error, _of_error(name))
    known, sensor = error[counts & ~np.isnan(error)], hemisphere.sensor
    about = {
        "long_name": told,
        "units": "1",
        "side": side,
        "mask": str(mask),
        "brighter_than": mask.brighter_than,
        "noise": "any" if mask.noise is None else mask.noise,
        "known_to": mask.known_to,
        "pixels_left": int(counts.sum()),
        "median_se": float(np.median(known)) if known.size else np.nan,
        "largest_se": float(known.max()) if known.size else np.nan,
        "pixels": f"{sensor.pixels} x {sensor.pixels}, {sensor.projection}",
        "pixel_degrees_at_normal": float(np.degrees(sensor.width_at_normal)),
        "largest_pixel_solid_angle": float(sensor.solid_angle.max()),
        "photons": hemisphere.photons,
        "symmetric": int(hemisphere.symmetric),
    }
    return xr.DataArray(value, coordinates(hemisphere, dims) | {"se": se}, dims, name, about)


COMPONENTS = ("S0", "S1", "S2", "S3")

FRAME = (
    "x of the light that comes in is horizontal, perpendicular to the plane of incidence; that of "
    "the light of a pixel is (0, 0, 1) x direction, perpendicular to its meridional plane, and "
    "(0, 1, 0) along the normal; y = direction x x"
)
"""What the numbers of Mueller matrices and Stokes vectors refer to."""


def pixel_array(
    hemisphere: Hemisphere,
    name: str,
    result: tuple[Numbers, Numbers | None],
    what: str,
    units: str,
    more: tuple[str, ...] = (),
    **attributes: Any,
) -> xr.DataArray:
    """Return a value of each pixel and its error as an array with names."""
    value, error = result
    dims = (*PIXELS, *more)
    known = coordinates(hemisphere, dims)
    known["side"] = "side", known["side"][1][: len(value)]
    if error is not None:
        known["se"] = dims, error, _of_error(name, units)
    about = {"long_name": what, "units": units, "frame": FRAME, **attributes}
    return xr.DataArray(value, known, dims, name, about)


def coordinates(hemisphere: Hemisphere, dims: tuple[str, ...]) -> dict[str, Any]:
    """Return the coordinates of what is known of each pixel."""
    sensor, place = hemisphere.sensor, {"units": "1"}
    towards = {"long_name": "place on the sensor, towards where light goes that is mirrored"}
    across = {"long_name": "place on the sensor, across the plane of incidence"}
    angle, when = {"units": "rad"}, {"long_name": "wavelength in vacuum", "units": "m"}
    results = {
        "side": ("side", np.array(hemisphere.seen.sides, object)),
        "y": ("y", sensor.coordinates, across | place),
        "x": ("x", sensor.coordinates, towards | place),
        "wavelength": ("wavelength", hemisphere.wavelengths, when),
        "out": ("out", np.array(COMPONENTS, object)),
        "in": ("in", np.array(COMPONENTS, object)),
        "theta": (("y", "x"), sensor.theta, {"long_name": "angle to the normal"} | angle),
        "phi": (("y", "x"), sensor.phi, {"long_name": "azimuth from x to y"} | angle),
    }
    return {name: each for name, each in results.items() if {each[0]} <= {*dims, ("y", "x")}}
