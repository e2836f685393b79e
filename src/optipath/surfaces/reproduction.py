"""Published experiments on rough surfaces, and their numbers compared with measured ones."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import MeshWarning
from optipath.surfaces.energy_shares import energy
from optipath.surfaces.hemisphere.measure import measure

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import xarray as xr

    from optipath.surfaces.energy_shares import Energy
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.surfaces.sample import Sample
    from optipath.values.precision import Numbers


class Walks(NamedTuple):
    """The photons that measurements have in common."""

    incidence: str
    wavelengths: tuple[str, ...]
    cells: int | None


@dataclass(frozen=True)
class Measurement:
    """A number that is published, and how it is measured."""

    measure: str
    text: str
    walks: Walks
    published: tuple[float, float] | None = None
    within: float = 0.0
    brighter_than: float = 0.2
    noise: float = 0.2
    azimuth: float = 180.0
    stokes: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)

    def agrees(self, value: float, error: float) -> bool | None:
        """Tell whether a value is the published one, as far as it is known.

        >>> one = Measurement("adm", "7 to 8 %", Walks("60 deg", (), None), (0.07, 0.08))
        >>> one.agrees(0.083, 0.002), one.agrees(0.09, 0.002)
        (True, False)
        """
        if self.published is None:
            return None
        least, largest = self.published
        off = self.within + 2.0 * error
        return bool(least - off <= value <= largest + off)


@dataclass(frozen=True)
class Experiment:
    """What was published of a sample."""

    name: str
    description: str
    source: str
    sample: Sample
    measurements: tuple[Measurement, ...]
    sensor: int = 128
    photons: int = 1_000_000

    def by_walks(self) -> Iterator[tuple[Walks, list[Measurement]]]:
        """Yield photons, and all that is measured with them, in the order of the file."""
        for walks in dict.fromkeys(one.walks for one in self.measurements):
            yield walks, [one for one in self.measurements if one.walks == walks]


class Reproduced(NamedTuple):
    """A published number, and the one that has been measured."""

    measurement: Measurement
    found: Measured
    photons: int

    @property
    def agrees(self) -> bool | None:
        """Whether it is the published one; None where no number is published."""
        return self.measurement.agrees(self.found.value, self.found.error)


def reproduce(
    experiment: Experiment,
    photons: int | None = None,
    *,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Iterator[Reproduced]:
    """Do an experiment again, and yield what is found, one after the other.

    >>> from optipath.surfaces.experiment_files import load_experiment
    >>> mirror = load_experiment("wang-2017-table-2-alpha-0-4")
    >>> for one in reproduce(mirror, photons=10_000):
    ...     print(one.measurement.walks.incidence, round(one.found.value, 12), one.agrees)
    10 deg 1.0 True
    45 deg 1.0 True
    80 deg 1.0 True
    """
    count = experiment.photons if photons is None else photons
    for walks, measurements in experiment.by_walks():
        options = {"seed": seed, "threads": threads, "progress": progress}
        walked = Walked(experiment, walks, count, options)
        for measurement in measurements:
            with warnings.catch_warnings():
                if walks.cells is not None:  # A coarse mesh is what is looked at.
                    warnings.simplefilter("ignore", MeshWarning)
                result = MEASURES[measurement.measure].of(walked, measurement)
            yield Reproduced(measurement, result, count)


ANY_AZIMUTH = 180.0
"""Within how many degrees of the plane of incidence all pixels are, on either side."""


class Measured(NamedTuple):
    """A number that has been measured."""

    value: float
    error: float
    mask: str = ""
    pixel: str = ""


class Measure(NamedTuple):
    """What is measured, and how."""

    told: str
    of: Callable[[Walked, Measurement], Measured]
    takes: tuple[str, ...]
    several: bool = False


def _share(
    name: str, walked: Walked, measurement: Measurement, *, scalar: bool = False
) -> Measured:
    whole = walked.energy(measurement.stokes)
    energy = whole.scalar if scalar else whole
    if name == "R+T":
        error = np.hypot(energy.absorbed_se, energy.lost_se)
        return Measured(float(energy.R + energy.T), float(error))
    return Measured(float(getattr(energy, name)), float(getattr(energy, f"{name}_se")))


def _largest(name: str, walked: Walked, measurement: Measurement) -> Measured:
    made, sensor = getattr(walked.hemisphere, name), walked.hemisphere.sensor
    result: xr.DataArray = made(brighter_than=measurement.brighter_than, noise=measurement.noise)
    # The other side of the plane of incidence is its image.
    theta, azimuth = np.degrees(sensor.theta), np.abs(np.degrees(sensor.phi))
    value = np.where(azimuth <= measurement.azimuth, result.values, np.nan)
    mask = f"{sensor.pixels} x {sensor.pixels} pixels: {result.attrs['mask']}"
    if measurement.azimuth < ANY_AZIMUTH:
        mask += f", azimuth within {measurement.azimuth:g} deg of the plane of incidence"
    if np.isnan(value).all():
        return Measured(np.nan, np.nan, mask)
    at = np.unravel_index(np.nanargmax(value), value.shape)
    pixel = f"{theta[at]:.0f} deg, {azimuth[at]:.0f} deg"
    return Measured(float(value[at]), float(result["se"].values[at]), mask, pixel)


def _mirrored(name: str, walked: Walked, measurement: Measurement) -> Measured:
    """Return what is measured in the pixel towards which a mirror would send the light."""
    hemisphere = walked.hemisphere
    beam, sensor = hemisphere.seen.beam, hemisphere.sensor
    at = np.unravel_index(sensor.place((beam.sin, 0.0, beam.cos)), sensor.theta.shape)
    result: xr.DataArray = getattr(hemisphere, name)(measurement.stokes)
    value, error = (float(each[0, *at, 0]) for each in (result.values, result["se"].values))
    mask = f"the one of {sensor.pixels} x {sensor.pixels} pixels where a mirror sends the light"
    if name == "aop":
        # The paper folds it: half the arc tangent of |S2 / S1|.
        value = abs(value) if abs(value) <= np.pi / 4.0 else np.pi / 2.0 - abs(value)
        return Measured(float(np.degrees(value)), float(np.degrees(error)), mask)
    return Measured(value, error, mask)


FARTHEST = 60.0
"""Up to how many degrees from the normal the two are compared: 30 deg from grazing."""

BLOCKS = 16
"""How many blocks of pixels there are along a side, whose light is compared."""

_NEAR = f"{BLOCKS} x {BLOCKS} blocks of pixels within {FARTHEST:.0f} deg of the normal"


def _excess(component: int, walked: Walked, _: Measurement) -> Measured:
    return Measured(*model_excess(walked.hemisphere, component))


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

MEASURES = {
    **{name: Measure(told, partial(_share, name), _LIGHT) for name, told in _SHARES.items()},
    **{
        f"scalar-{name}": Measure(
            f"{told}, without polarisation", partial(_share, name, scalar=True), ("cells",)
        )
        for name, told in _SHARES.items()
    },
    **{
        name.lower(): Measure(
            f"largest {name} of a pixel",
            partial(_largest, name.lower()),
            (*_PIXELS, "brighter_than", "noise", "azimuth"),
            several=True,
        )
        for name in ("ADM", "MDM")
    },
    "dolp": Measure("DoLP of mirrored light", partial(_mirrored, "dolp"), (*_PIXELS, "stokes")),
    "aop": Measure(
        "AoP of mirrored light, 0 .. 45 deg", partial(_mirrored, "aop"), (*_PIXELS, "stokes")
    ),
    **{
        f"model-S{each}": Measure(
            f"S{each} of the facet model, over that of photons, less 1",
            partial(_excess, each),
            _PIXELS,
        )
        for each in range(3)
    },
    "model-S3": Measure(
        "largest S3 of the facet model",
        lambda walked, _: Measured(np.abs(model_of(walked.hemisphere)[..., 3]).max().item(), 0.0),
        ("sensor",),
    ),
    "model-off": Measure(
        "facet model off photons after one event, over the largest S0",
        lambda walked, _: Measured(*model_off(walked.once), _NEAR),
        _PIXELS,
    ),
}
"""By the names that files of experiments have."""


@dataclass(frozen=True)
class Walked:
    """Photons of an experiment; each kind of them is walked once, when it is asked for."""

    experiment: Experiment
    walks: Walks
    photons: int
    options: dict[str, Any]

    def energy(self, stokes: tuple[float, ...]) -> Energy:
        """Return what share of light of a Stokes vector comes back and goes through."""
        known: dict[tuple[float, ...], Energy] = vars(self).setdefault("_energies", {})
        if stokes not in known:
            known[stokes] = energy(
                self.sample,
                self.walks.incidence,
                self.photons,
                wavelength=next(iter(self.walks.wavelengths), None),
                stokes=stokes,
                **self.options,
            )
        return known[stokes]

    @cached_property
    def hemisphere(self) -> Hemisphere:
        """What goes into each pixel."""
        return self._hemisphere(None)

    @cached_property
    def once(self) -> Hemisphere:
        """What goes into each pixel after one event."""
        return self._hemisphere(1)

    @cached_property
    def sample(self) -> Sample:
        """What light falls on, with the mesh that is asked for."""
        cells, sample = self.walks.cells, self.experiment.sample
        return sample if cells is None else replace(sample, cells=(cells, cells))

    def _hemisphere(self, events: int | None) -> Hemisphere:
        return measure(
            self.sample,
            self.walks.incidence,
            self.photons,
            [*self.walks.wavelengths] or None,
            self.experiment.sensor,
            events=events,
            **self.options,
        )


def model_of(hemisphere: Hemisphere) -> Numbers:
    """Return the model's Stokes vectors of unpolarised light, of shape (rows, columns, 4)."""
    results: Numbers = hemisphere.single_scattering().values[0, :, :, 0, :, 0]
    return results


def model_excess(hemisphere: Hemisphere, component: int) -> tuple[float, float]:
    """Return by how much the model is above photons, in all: its sum over theirs, less 1."""
    model = model_of(hemisphere)[..., component]
    sign, whole = np.sign(model), np.sum(np.abs(model))

    def above(light: Numbers) -> Numbers:
        return np.asarray(whole / np.sum(_stokes(hemisphere, light)[..., component] * sign) - 1.0)

    value, error = hemisphere.own.estimate(above)
    return float(value), float(error)


def model_off(hemisphere: Hemisphere) -> tuple[float, float]:
    """Return how far the model is off at most, of all components, over the largest S0."""
    model = _blocks(model_of(hemisphere))
    place = (2.0 * np.arange(len(model)) + 1.0) / len(model) - 1.0
    near = 90.0 * np.hypot(place, place[:, np.newaxis]) < FARTHEST
    value, error = hemisphere.own.estimate(
        lambda light: (_blocks(_stokes(hemisphere, light)) - model)[near] / model[..., 0].max()
    )
    at = np.unravel_index(np.argmax(np.abs(value)), value.shape)
    return float(np.abs(value[at])), float(error[at])


def _stokes(hemisphere: Hemisphere, light: Numbers) -> Numbers:
    return hemisphere.matrices(light)[0, :, :, 0, :, 0]


def _blocks(pixels: Numbers) -> Numbers:
    """Return the sums over square blocks."""
    size = max(len(pixels) // BLOCKS, 1)
    side = len(pixels) // size
    whole = pixels[: side * size, : side * size]
    return np.asarray(whole.reshape(side, size, side, size, -1).sum(axis=(1, 3)))
