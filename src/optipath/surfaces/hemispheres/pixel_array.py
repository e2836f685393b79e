"""Arrays over the pixels of a hemisphere, with names, units and standard errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import xarray as xr

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

Numbers = npt.NDArray[np.float64]

PIXELS = ("side", "y", "x", "wavelength")
"""The dimensions of what is known of each pixel."""

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
    value: Numbers,
    what: str,
    units: str,
    more: tuple[str, ...] = (),
    *,
    error: Numbers | None = None,
    **told: Any,
) -> xr.DataArray:
    """Return what is known of each pixel as an array with names."""
    dims = (*PIXELS, *more)
    known = coordinates(hemisphere, dims)
    known["side"] = "side", known["side"][1][: len(value)]
    if error is not None:
        known["se"] = dims, error, {"long_name": f"standard error of '{name}'", "units": units}
    about = {"long_name": what, "units": units, "frame": FRAME, **told}
    return xr.DataArray(value, known, dims, name, about)


def coordinates(hemisphere: Hemisphere, dims: tuple[str, ...]) -> dict[str, Any]:
    """Return the coordinates of what is known of each pixel."""
    sensor, place = hemisphere.sensor, {"units": "1"}
    towards = {"long_name": "place on the sensor, towards where light goes that is mirrored"}
    across = {"long_name": "place on the sensor, across the plane of incidence"}
    angle = {"units": "rad"}
    found = {
        "side": ("side", np.array(hemisphere.seen.sides, object)),
        "y": ("y", sensor.coordinates, across | place),
        "x": ("x", sensor.coordinates, towards | place),
        "wavelength": (
            "wavelength",
            hemisphere.wavelengths,
            {"long_name": "wavelength in vacuum", "units": "m"},
        ),
        "out": ("out", np.array(COMPONENTS, object)),
        "in": ("in", np.array(COMPONENTS, object)),
        "theta": (("y", "x"), sensor.theta, {"long_name": "angle to the normal"} | angle),
        "phi": (("y", "x"), sensor.phi, {"long_name": "azimuth from x to y"} | angle),
    }
    return {name: each for name, each in found.items() if {each[0]} <= {*dims, ("y", "x")}}
