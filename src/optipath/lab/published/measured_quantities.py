"""What can be measured again: by name, as files of experiments have it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.lab.published.facet_comparison import FARTHEST, FacetComparison

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr

    from optipath.lab.published.experiment import Measurement
    from optipath.lab.published.walked import Walked


class Found(NamedTuple):
    """A number that has been measured.

    Attributes
    ----------
    value, error : float
        It, and its standard error.
    mask : str
        Which pixels it is of; nothing where it is not of pixels.
    pixel : str
        Where it is found, as the angle to the normal and the azimuth.
    """

    value: float
    error: float
    mask: str = ""
    pixel: str = ""


class Measure(NamedTuple):
    """What is measured, and how.

    Attributes
    ----------
    told : str
        What it is.
    of : callable
        Returns it of photons, and of what is asked.
    several : bool
        Whether light may have several wavelengths.
    """

    told: str
    of: Callable[[Walked, Measurement], Found]
    several: bool = False


def _share(name: str) -> Callable[[Walked, Measurement], Found]:
    def of(walked: Walked, _: Measurement) -> Found:
        energy = walked.energy
        return Found(float(getattr(energy, name)), float(getattr(energy, f"{name}_se")))

    return of


def _whole(walked: Walked, _: Measurement) -> Found:
    energy = walked.energy
    error = np.hypot(energy.absorbed_se, energy.lost_se)
    return Found(float(energy.R + energy.T), float(error))


def _largest(name: str) -> Callable[[Walked, Measurement], Found]:
    def of(walked: Walked, measurement: Measurement) -> Found:
        made, sensor = getattr(walked.hemisphere, name), walked.hemisphere.sensor
        found: xr.DataArray = made(brighter_than=measurement.brighter_than, noise=measurement.noise)
        value, error = found.values, found["se"].values
        mask = f"{sensor.pixels} x {sensor.pixels} pixels: {found.attrs['mask']}"
        if np.isnan(value).all():
            return Found(np.nan, np.nan, mask)
        at = np.unravel_index(np.nanargmax(value), value.shape)
        theta, phi = (np.degrees(angle[at]) for angle in (sensor.theta, sensor.phi))
        # The other side of the plane of incidence is its image.
        return Found(
            float(value[at]), float(error[at]), mask, f"{theta:.0f} deg, {abs(phi):.0f} deg"
        )

    return of


def _mirrored(name: str) -> Callable[[Walked, Measurement], Found]:
    """Return what is measured in the pixel towards which a mirror would send the light."""

    def of(walked: Walked, measurement: Measurement) -> Found:
        hemisphere = walked.hemisphere
        beam, sensor = hemisphere.seen.beam, hemisphere.sensor
        at = np.unravel_index(sensor.place((beam.sin, 0.0, beam.cos)), sensor.theta.shape)
        found: xr.DataArray = getattr(hemisphere, name)(measurement.stokes)
        value, error = (float(each[0, *at, 0]) for each in (found.values, found["se"].values))
        mask = f"the pixel of {sensor.pixels} x {sensor.pixels} where a mirror would send the light"
        if name == "aop":
            # The paper folds it: half the arc tangent of |S2 / S1|.
            value = abs(value) if abs(value) <= np.pi / 4.0 else np.pi / 2.0 - abs(value)
            return Found(float(np.degrees(value)), float(np.degrees(error)), mask)
        return Found(value, error, mask)

    return of


def _excess(component: int) -> Callable[[Walked, Measurement], Found]:
    def of(walked: Walked, _: Measurement) -> Found:
        return Found(*FacetComparison(walked.hemisphere).excess(component), "all pixels")

    return of


def _model_s3(walked: Walked, _: Measurement) -> Found:
    model = FacetComparison(walked.hemisphere).model
    return Found(float(np.nanmax(np.abs(model[..., 3]))), 0.0, "all pixels")


def _off(walked: Walked, _: Measurement) -> Found:
    compared = FacetComparison(walked.once).largest_off()
    return Found(*compared, f"directions within {np.degrees(FARTHEST):.0f} deg of the normal")


MEASURES = {
    "R_s": Measure("share reflected after one event", _share("R_s")),
    "R_m": Measure("share reflected after several events", _share("R_m")),
    "R": Measure("share reflected", _share("R")),
    "T_s": Measure("share let through after one event", _share("T_s")),
    "T_m": Measure("share let through after several events", _share("T_m")),
    "T": Measure("share let through", _share("T")),
    "R+T": Measure("share reflected or let through", _whole),
    "adm": Measure("largest ADM of a pixel", _largest("adm"), several=True),
    "mdm": Measure("largest MDM of a pixel", _largest("mdm"), several=True),
    "dolp": Measure("DoLP of mirrored light", _mirrored("dolp")),
    "aop": Measure("AoP of mirrored light, 0 .. 45 deg", _mirrored("aop")),
    "model-S0": Measure("S0 of the facet model, over that of photons, less 1", _excess(0)),
    "model-S1": Measure("S1 of the facet model, over that of photons, less 1", _excess(1)),
    "model-S2": Measure("S2 of the facet model, over that of photons, less 1", _excess(2)),
    "model-S3": Measure("largest S3 of the facet model", _model_s3),
    "model-off": Measure("facet model off photons after one event, over the largest S0", _off),
}
"""By the names that files of experiments have."""
