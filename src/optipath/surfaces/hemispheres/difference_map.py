"""A DataArray of what polarisation makes of each pixel, with its mask, pixels and noise."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import xarray as xr

from optipath.errors import SurfaceError
from optipath.surfaces.hemispheres.pixel_array import coordinates
from optipath.surfaces.hemispheres.pixel_mask import Numbers, PixelMask
from optipath.values.cures import cure

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.surfaces.hemispheres.hemisphere import Hemisphere


_Told = dict[str, str | float]


class _Measure(NamedTuple):
    """What is made of the relative differences at all wavelengths, the last axis."""

    called: str
    told: str
    made: Callable[[Numbers], Numbers]


_MEASURES = {
    "signed": _Measure("relative_difference", "(S0 - U) / U", np.asarray),
    "adm": _Measure(
        "adm", "mean of |S0 - U| / U over wavelengths", lambda found: np.abs(found).mean(axis=-1)
    ),
    "mdm": _Measure(
        "mdm", "largest |S0 - U| / U over wavelengths", lambda found: np.abs(found).max(axis=-1)
    ),
}


def difference_map(
    hemisphere: Hemisphere,
    measure: str,
    side: str,
    brighter_than: float,
    noise: float | None,
    known_to: float = 0.001,
) -> xr.DataArray:
    """Return what polarisation makes of each pixel."""
    mask = PixelMask(brighter_than, noise, known_to)
    at, what = hemisphere.side(side), _MEASURES[measure]
    found = hemisphere.own.estimate(lambda light: what.made(_relative(hemisphere, light)))
    value, error = (each[at] for each in found)
    if noise is not None and np.isnan(error).all():
        raise SurfaceError(
            f"the noise of {hemisphere.photons:,} photons is not known, and pixels are left out by "
            f"it; measure with more photons{cure(', or give noise=None', '')}"
        )
    counts = mask.bright(hemisphere.scalar_light(at))
    counts = counts.reshape(counts.shape + (1,) * (value.ndim - 2)) & mask.known(value, error)
    value, error = (np.where(counts, each, np.nan) for each in (value, error))
    dims = ("y", "x", "wavelength")[: value.ndim]
    se = xr.Variable(dims, error, {"long_name": f"standard error of '{what.called}'", "units": "1"})
    told: _Told = {"long_name": what.told, "units": "1", "side": side}
    told |= _mask_attributes(mask, counts, error)
    told |= _pixel_attributes(hemisphere)
    return xr.DataArray(value, coordinates(hemisphere, dims) | {"se": se}, dims, what.called, told)


def _relative(hemisphere: Hemisphere, light: Numbers) -> Numbers:
    scalar = hemisphere.intensities(light)
    return (hemisphere.matrices(light)[..., 0, 0] - scalar) / scalar


def _mask_attributes(mask: PixelMask, counts: npt.NDArray[np.bool_], error: Numbers) -> _Told:
    known = error[counts & ~np.isnan(error)]
    return {
        "mask": str(mask),
        "brighter_than": mask.brighter_than,
        "noise": "any" if mask.noise is None else mask.noise,
        "known_to": mask.known_to,
        "pixels_left": int(counts.sum()),
        "median_se": float(np.median(known)) if known.size else np.nan,
        "largest_se": float(known.max()) if known.size else np.nan,
    }


def _pixel_attributes(hemisphere: Hemisphere) -> _Told:
    sensor = hemisphere.sensor
    return {
        "pixels": f"{sensor.pixels} x {sensor.pixels}, {sensor.projection}",
        "pixel_degrees_at_normal": float(np.degrees(sensor.width_at_normal)),
        "largest_pixel_solid_angle": float(sensor.solid_angle.max()),
        "photons": hemisphere.photons,
        "symmetric": int(hemisphere.symmetric),
    }
