"""Published experiments on rough surfaces, and their numbers compared with measured ones."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import MeshWarning, SurfaceError
from optipath.faults import shown, unknown
from optipath.paths.files.schema import Faults, checked_table, files_in, presets_folder
from optipath.surfaces.energy_shares import Energy, energy
from optipath.surfaces.hemisphere.measure import measure
from optipath.surfaces.sample import Sample
from optipath.surfaces.sample_files import described, load_sample, text_and_file
from optipath.surfaces.walk.beam import UNPOLARISED, beam_of
from optipath.values.precision import Numbers, real_number, whole_number

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from os import PathLike
    from pathlib import Path

    from optipath.surfaces.hemisphere.hemisphere import Hemisphere


@dataclass(frozen=True)
class Measurement:
    """A number that is published, and how it is measured."""

    measure: str
    text: str
    incidence: str
    cells: int | None = None
    published: tuple[float, float] | None = None
    within: float = 0.0
    brighter_than: float = 0.2
    noise: float = 0.2
    azimuth: float = 180.0
    stokes: tuple[float, ...] = UNPOLARISED

    def agrees(self, value: float, error: float) -> bool | None:
        """Tell whether a value is the published one, as far as it is known."""
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
    wavelengths: tuple[str, ...] = ()


class Measured(NamedTuple):
    """A number that has been measured."""

    value: float
    error: float
    mask: str = ""
    pixel: str = ""


class Reproduced(NamedTuple):
    """A published number, the measured one, and whether they agree: None of none published."""

    measurement: Measurement
    found: Measured
    photons: int
    agrees: bool | None


def reproduce(
    experiment: Experiment,
    photons: int | None = None,
    *,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Iterator[Reproduced]:
    """Do an experiment again, and yield what is found, photons of one kind after the other.

    >>> mirror = load_experiment("wang-2017-table-2-alpha-0-4")
    >>> for one in reproduce(mirror, photons=10_000):
    ...     print(one.measurement.incidence, round(one.found.value, 12), one.agrees)
    10 deg 1.0 True
    45 deg 1.0 True
    80 deg 1.0 True
    """
    count = experiment.photons if photons is None else photons
    options = {"seed": seed, "threads": threads, "progress": progress}
    for light in dict.fromkeys((one.incidence, one.cells) for one in experiment.measurements):
        walked = Walked(experiment, *light, count, options)
        for one in experiment.measurements:
            if (one.incidence, one.cells) != light:
                continue
            with warnings.catch_warnings():
                if one.cells is not None:  # A coarse mesh is what is looked at.
                    warnings.simplefilter("ignore", MeshWarning)
                found = MEASURES[one.measure].of(walked, one)
            yield Reproduced(one, found, count, one.agrees(found.value, found.error))


ANY_AZIMUTH = 180.0
"""Within how many degrees of the plane of incidence all pixels are, on either side."""


class Measure(NamedTuple):
    """What is measured, and how."""

    told: str
    of: Callable[[Walked, Measurement], Measured]
    takes: tuple[str, ...]
    several: bool = False


def _share(name: str, walked: Walked, measurement: Measurement) -> Measured:
    share, whole = name.removeprefix("scalar-"), walked.energy(measurement.stokes)
    shares = whole if share == name else whole.scalar
    if share == "R+T":
        error = np.hypot(shares.absorbed_se, shares.lost_se)
        return Measured(float(shares.R + shares.T), float(error))
    return Measured(float(getattr(shares, share)), float(getattr(shares, f"{share}_se")))


def _largest(name: str, walked: Walked, measurement: Measurement) -> Measured:
    made, sensor = getattr(walked.hemisphere, name), walked.hemisphere.sensor
    result = made(brighter_than=measurement.brighter_than, noise=measurement.noise)
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
    hemisphere, sensor = walked.hemisphere, walked.hemisphere.sensor
    beam = hemisphere.seen.beam
    at = np.unravel_index(sensor.place((beam.sin, 0.0, beam.cos)), sensor.theta.shape)
    result = getattr(hemisphere, name)(measurement.stokes)
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


def _largest_s3(walked: Walked, _: Measurement) -> Measured:
    return Measured(np.abs(model_of(walked.hemisphere)[..., 3]).max().item(), 0.0)


def _off(walked: Walked, _: Measurement) -> Measured:
    return Measured(*model_off(walked.once), _NEAR)


_SHARES = {
    "R_s": "share reflected after one event",
    "R_m": "share reflected after several events",
    "R": "share reflected",
    "T_s": "share let through after one event",
    "T_m": "share let through after several events",
    "T": "share let through",
    "R+T": "share reflected or let through",
}
_SCALAR = {f"scalar-{name}": f"{told}, without polarisation" for name, told in _SHARES.items()}
_MODEL = [f"S{each} of the facet model, over that of photons, less 1" for each in range(3)]

_PIXELS = ("cells", "sensor")
_OF_LIGHT = (*_PIXELS, "stokes")
_OF_LARGEST = (*_PIXELS, "brighter_than", "noise", "azimuth")

MEASURES = {
    **{n: Measure(told, partial(_share, n), ("cells", "stokes")) for n, told in _SHARES.items()},
    **{n: Measure(told, partial(_share, n), ("cells",)) for n, told in _SCALAR.items()},
    "adm": Measure("largest ADM of a pixel", partial(_largest, "adm"), _OF_LARGEST, several=True),
    "mdm": Measure("largest MDM of a pixel", partial(_largest, "mdm"), _OF_LARGEST, several=True),
    "dolp": Measure("DoLP of mirrored light", partial(_mirrored, "dolp"), _OF_LIGHT),
    "aop": Measure("AoP of mirrored light, 0 .. 45 deg", partial(_mirrored, "aop"), _OF_LIGHT),
    **{f"model-S{n}": Measure(t, partial(_excess, n), _PIXELS) for n, t in enumerate(_MODEL)},
    "model-S3": Measure("largest S3 of the facet model", _largest_s3, ("sensor",)),
    "model-off": Measure(
        "facet model off photons after one event, over the largest S0", _off, _PIXELS
    ),
}
"""By the names that files of experiments have."""


@dataclass(frozen=True)
class Walked:
    """Photons of an experiment; each kind of them is walked once, when it is asked for."""

    experiment: Experiment
    incidence: str
    cells: int | None
    photons: int
    options: dict[str, Any]

    @cached_property
    def energy(self) -> Callable[[tuple[float, ...]], Energy]:
        """What share of light of a Stokes vector comes back and goes through."""
        wavelength = next(iter(self.experiment.wavelengths), None)
        walk = partial(energy, self.sample, self.incidence, self.photons, **self.options)
        return cache(lambda stokes: walk(wavelength=wavelength, stokes=stokes))

    @cached_property
    def hemisphere(self) -> Hemisphere:
        """What goes into each pixel."""
        return self._measure(None)

    @cached_property
    def once(self) -> Hemisphere:
        """What goes into each pixel after one event."""
        return self._measure(1)

    @cached_property
    def sample(self) -> Sample:
        """What light falls on, with the mesh that is asked for."""
        cells, sample = self.cells, self.experiment.sample
        return sample if cells is None else replace(sample, cells=(cells, cells))

    def _measure(self, events: int | None) -> Hemisphere:
        wavelengths, sensor = [*self.experiment.wavelengths] or None, self.experiment.sensor
        light = self.incidence, self.photons, wavelengths, sensor
        return measure(self.sample, *light, events=events, **self.options)


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


_FOLDER = presets_folder() / "experiments"


def experiment_names() -> list[str]:
    """Return the names of the experiments that come with the library, sorted."""
    return [*files_in(_FOLDER)]


def load_experiment(experiment: str | PathLike[str]) -> Experiment:
    """Return an experiment out of its file."""
    see = "`optipath surface reproduce --list`"
    text, path = text_and_file(experiment, "experiment", _FOLDER, see)
    return described(text, path, _TOP, [*_NEEDED], partial(_experiment, str(experiment)))


_NEEDED = {"description": str, "source": str, "sample": str, "measurements": list}
_TOP = {"format": int, **_NEEDED, "wavelengths": list, "photons": int, "sensor": int}
_LIMITS = dict.fromkeys(("within", "brighter_than", "noise", "azimuth"), object)
_OF_ALL = {"measure": str, "text": str, "incidence": list}
_MEASUREMENT = {**_OF_ALL, "published": list, "cells": int, "stokes": list, **_LIMITS}

_PLAIN = Sample([(1.5, 0.0)])
"""On which directions and light are checked, whatever the sample of the experiment is."""


def _experiment(name: str, document: dict[str, Any], folder: Path) -> Experiment:
    more = {key: document[key] for key in ("photons", "sensor") if key in document}
    faults = Faults(fault for key, value in more.items() for fault in whole_number(key, value))
    named = document["sample"]  # By its name, or in a file beside that of the experiment.
    beside = folder / named if named.endswith(".toml") else named
    sample = faults.attempt("sample", load_sample, beside)
    wavelengths = tuple(map(str, document.get("wavelengths", ())))
    if sample is not None:
        faults.attempt("wavelengths", sample.indices, [*wavelengths] or None)
    results: list[Measurement] = []
    for at, table in enumerate(document["measurements"]):
        several = faults.attempt(f"measurements[{at}]", _measurements, table, sample, wavelengths)
        results += several or []
    if faults or sample is None:
        raise SurfaceError(*dict.fromkeys(faults))
    about = document["description"], document["source"]
    return Experiment(name, *about, sample, tuple(results), wavelengths=wavelengths, **more)


def _measurements(
    table: Any, sample: Sample | None, wavelengths: tuple[str, ...]
) -> list[Measurement]:
    """Return a measurement for each angle of incidence."""
    checked_table(table, _MEASUREMENT, [*_OF_ALL])
    measure, angles, cells = table["measure"], table["incidence"], table.get("cells")
    stokes = tuple(table.get("stokes", UNPOLARISED))
    faults = Faults(unknown("measure", measure, MEASURES))
    if not faults:
        known = {*_OF_ALL, "published", "within", *MEASURES[measure].takes}
        if len(wavelengths) > 1 and not MEASURES[measure].several:
            faults.append(f"measure '{measure}' is of one wavelength, not of {len(wavelengths)}")
        why = f"is given, but measure '{measure}' does not depend on it; leave it out"
        faults += [f"'{key}' {why}" for key in table if key not in known]
    for name in _LIMITS:
        largest = ANY_AZIMUTH if name == "azimuth" else float("inf")
        if not 0.0 <= _number(table.get(name, 0.0)) <= largest:
            upto = f" to {largest:g}, in degrees" if name == "azimuth" else ""
            faults.append(f"'{name}' is {shown(table[name])}; write a number from 0{upto}")
    if cells is not None and sample is not None:
        faults.attempt("", replace, sample, cells=cells)
    for angle in angles:
        if isinstance(angle, str):
            faults.attempt("", beam_of, _PLAIN, angle, stokes=stokes)
        else:
            faults.append(f'incidence: {shown(angle)} is no text; write one such as "60 deg"')
    numbers = table.get("published")
    published: list[Any] = [*map(_range, numbers)] if numbers else [None] * len(angles)
    if len(published) != len(angles) or any(each and not each[0] <= each[1] for each in published):
        faults.append(
            f"published is {shown(numbers)}; write a number, or [LEAST, LARGEST], for each of the "
            f"{len(angles)} angles of incidence"
        )
    SurfaceError.raise_for(faults)
    limits: dict[str, Any] = {name: float(table[name]) for name in _LIMITS if name in table}
    about = {"text": table["text"], "stokes": stokes, **limits}
    return [
        Measurement(measure, incidence=angle, cells=cells, published=number, **about)
        for angle, number in zip(angles, published, strict=True)
    ]


def _number(value: Any) -> float:
    """Return a real number; NaN, which is within no limits, for what is none."""
    result = real_number(value)
    return float("nan") if result is None else result


def _range(published: Any) -> tuple[float, float]:
    is_pair = isinstance(published, list) and len(published) == 2
    least, largest = map(_number, published if is_pair else (published, published))
    return least, largest
