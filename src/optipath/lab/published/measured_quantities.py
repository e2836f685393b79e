"""What can be measured again: by name, as files of experiments have it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.lab.published.facet_comparison import (
    BLOCKS,
    FARTHEST,
    model_excess,
    model_of,
    model_off,
)
from optipath.values.cures import of_files

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr

    from optipath.lab.published.experiment import Measurement
    from optipath.lab.published.walked import Walked


ANY_AZIMUTH = 180.0
"""Within how many degrees of the plane of incidence all pixels are, on either side."""


class Found(NamedTuple):
    """A number that has been measured."""

    value: float
    error: float
    mask: str = ""
    pixel: str = ""


class Measure(NamedTuple):
    """What is measured, and how."""

    told: str
    of: Callable[[Walked, Measurement], Found]
    takes: tuple[str, ...]
    several: bool = False


def _share(name: str, *, scalar: bool = False) -> Callable[[Walked, Measurement], Found]:
    def of(walked: Walked, measurement: Measurement) -> Found:
        whole = walked.energy(measurement.stokes)
        energy = whole.scalar if scalar else whole
        if name == "R+T":
            error = np.hypot(energy.absorbed_se, energy.lost_se)
            return Found(float(energy.R + energy.T), float(error))
        return Found(float(getattr(energy, name)), float(getattr(energy, f"{name}_se")))

    return of


def _largest(name: str) -> Callable[[Walked, Measurement], Found]:
    def of(walked: Walked, measurement: Measurement) -> Found:
        made, sensor = getattr(walked.hemisphere, name), walked.hemisphere.sensor
        with of_files():  # Cures are what the file, or the command, can follow.
            found: xr.DataArray = made(
                brighter_than=measurement.brighter_than, noise=measurement.noise
            )
        # The other side of the plane of incidence is its image.
        theta, azimuth = np.degrees(sensor.theta), np.abs(np.degrees(sensor.phi))
        value = np.where(azimuth <= measurement.azimuth, found.values, np.nan)
        mask = f"{sensor.pixels} x {sensor.pixels} pixels: {found.attrs['mask']}"
        if measurement.azimuth < ANY_AZIMUTH:
            mask += f", azimuth within {measurement.azimuth:g} deg of the plane of incidence"
        if np.isnan(value).all():
            return Found(np.nan, np.nan, mask)
        at = np.unravel_index(np.nanargmax(value), value.shape)
        pixel = f"{theta[at]:.0f} deg, {azimuth[at]:.0f} deg"
        return Found(float(value[at]), float(found["se"].values[at]), mask, pixel)

    return of


def _mirrored(name: str) -> Callable[[Walked, Measurement], Found]:
    """Return what is measured in the pixel towards which a mirror would send the light."""

    def of(walked: Walked, measurement: Measurement) -> Found:
        hemisphere = walked.hemisphere
        beam, sensor = hemisphere.seen.beam, hemisphere.sensor
        at = np.unravel_index(sensor.place((beam.sin, 0.0, beam.cos)), sensor.theta.shape)
        found: xr.DataArray = getattr(hemisphere, name)(measurement.stokes)
        value, error = (float(each[0, *at, 0]) for each in (found.values, found["se"].values))
        mask = f"the one of {sensor.pixels} x {sensor.pixels} pixels where a mirror sends the light"
        if name == "aop":
            # The paper folds it: half the arc tangent of |S2 / S1|.
            value = abs(value) if abs(value) <= np.pi / 4.0 else np.pi / 2.0 - abs(value)
            return Found(float(np.degrees(value)), float(np.degrees(error)), mask)
        return Found(value, error, mask)

    return of


def _excess(component: int) -> Callable[[Walked, Measurement], Found]:
    def of(walked: Walked, _: Measurement) -> Found:
        return Found(*model_excess(walked.hemisphere, component))

    return of


def _model_s3(walked: Walked, _: Measurement) -> Found:
    return Found(float(np.max(np.abs(model_of(walked.hemisphere)[..., 3]))), 0.0)


def _off(walked: Walked, _: Measurement) -> Found:
    mask = f"{BLOCKS} x {BLOCKS} blocks of pixels within {FARTHEST:.0f} deg of the normal"
    return Found(*model_off(walked.once), mask)


_SHARES = {
    "R_s": "share reflected after one event",
    "R_m": "share reflected after several events",
    "R": "share reflected",
    "T_s": "share let through after one event",
    "T_m": "share let through after several events",
    "T": "share let through",
    "R+T": "share reflected or let through",
}

_LIGHT = ("cells", "stokes")
_PIXELS = ("cells", "sensor")
_SEVERAL_PIXELS = (*_PIXELS, "brighter_than", "noise", "azimuth")

MEASURES = {
    **{name: Measure(told, _share(name), _LIGHT) for name, told in _SHARES.items()},
    **{
        f"scalar-{name}": Measure(
            f"{told}, without polarisation", _share(name, scalar=True), ("cells",)
        )
        for name, told in _SHARES.items()
    },
    "adm": Measure("largest ADM of a pixel", _largest("adm"), _SEVERAL_PIXELS, several=True),
    "mdm": Measure("largest MDM of a pixel", _largest("mdm"), _SEVERAL_PIXELS, several=True),
    "dolp": Measure("DoLP of mirrored light", _mirrored("dolp"), (*_PIXELS, "stokes")),
    "aop": Measure("AoP of mirrored light, 0 .. 45 deg", _mirrored("aop"), (*_PIXELS, "stokes")),
    "model-S0": Measure("S0 of the facet model, over that of photons, less 1", _excess(0), _PIXELS),
    "model-S1": Measure("S1 of the facet model, over that of photons, less 1", _excess(1), _PIXELS),
    "model-S2": Measure("S2 of the facet model, over that of photons, less 1", _excess(2), _PIXELS),
    "model-S3": Measure("largest S3 of the facet model", _model_s3, ("sensor",)),
    "model-off": Measure(
        "facet model off photons after one event, over the largest S0", _off, _PIXELS
    ),
}
"""By the names that files of experiments have."""
