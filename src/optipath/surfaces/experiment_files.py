"""Files of published experiments: the sample and its measurements."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, PresetError, SurfaceError, did_you_mean, listed, shown
from optipath.paths.files.schema import FORMAT, Faults, as_meant, readable, type_faults
from optipath.paths.files.toml import file_of, names_in, parsed, presets_folder, text_of
from optipath.surfaces.reproduction import ANY_AZIMUTH, MEASURES, Experiment, Measurement, Walks
from optipath.surfaces.sample import Sample
from optipath.surfaces.sample_files import load_sample
from optipath.surfaces.sample_layers import depends_on_wavelength
from optipath.surfaces.walk.beam import UNPOLARISED, beam_of
from optipath.values.affine import real_number
from optipath.values.precision import whole_number

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from os import PathLike
    from pathlib import Path


_WHAT = "experiment"


def experiment_names() -> list[str]:
    """Return the names of the experiments that come with the library, sorted.

    >>> experiment_names()[0]
    'wang-2017-figure-4'
    """
    return names_in(_folder())


def load_experiment(experiment: str | PathLike[str]) -> Experiment:
    """Return an experiment out of its file.

    >>> print(load_experiment("wang-2017-table-1").source)
    M. Wang et al., Optics Express 25(19), 2017, table 1
    """
    try:
        path = file_of(experiment, _WHAT, _folder(), "`optipath surface reproduce --list`")
        text = text_of(path, _WHAT)
    except PresetError as error:
        raise SurfaceError(*error.faults) from None
    # A wrong name is told at once.

    return experiment_of_text(text, path, str(experiment))


def _folder() -> Path:
    return presets_folder() / "experiments"


TOP: dict[str, Any] = {"format": int, "description": str, "source": str, "sample": str}
TOP |= {"wavelengths": list, "photons": int, "sensor": int, "measurements": list}

_NEEDED = ("format", "description", "source", "sample", "measurements")
_WITHOUT_PIXELS = [name for name, each in MEASURES.items() if "sensor" not in each.takes]


def experiment_of_text(text: str, path: Path, name: str) -> Experiment:
    """Return the experiment that a text describes."""
    try:
        document = parsed(text, str(path))
    except PresetError as error:
        raise SurfaceError(*error.faults) from None
    try:
        return _experiment(document, path.parent, name)
    except OptipathError as error:
        raise SurfaceError(*error.within("file"), about=path.name) from None


def _experiment(document: dict[str, Any], folder: Path, name: str) -> Experiment:
    faults = Faults(type_faults("the experiment", document, TOP))
    meant, argument = as_meant(document, TOP), readable(document, TOP)
    faults += [f"the experiment: '{key}' is missing" for key in _NEEDED if key not in meant]
    if argument.get("format", FORMAT) != FORMAT:
        faults.append(f"format is {argument['format']}, but this version reads format {FORMAT}")
    for key in ("photons", "sensor"):
        faults += whole_number(key, argument[key]) if key in argument else []
    sample = (
        faults.attempt("sample", _sample, argument["sample"], folder)
        if "sample" in argument
        else None
    )
    wavelengths = tuple(map(str, argument.get("wavelengths", ())))
    if sample is not None and ("wavelengths" in argument or "wavelengths" not in meant):
        faults.attempt("", _check_wavelengths, sample, wavelengths)
    tables = argument.get("measurements", [])
    if "measurements" in argument and not tables:
        faults.append("the experiment measures nothing; add a table [[measurements]]")
    faults += _faults_of_sensor(tables) if "sensor" in argument else []
    results: list[Measurement] = []
    for at, table in enumerate(tables):
        made = faults.attempt(f"measurements[{at}]", measurements_of, table, sample, wavelengths)
        results += made or []
    if faults or sample is None:
        raise SurfaceError(*dict.fromkeys(faults))
    more = {key: argument[key] for key in ("photons", "sensor") if key in argument}
    about = argument["description"], argument["source"], sample
    return Experiment(name, *about, tuple(results), **more)


def _sample(argument: str, folder: Path) -> Sample:
    """Return a sample by its name, or out of a file beside that of the experiment or below it."""
    if not argument.endswith(".toml"):
        return load_sample(argument)
    try:
        there = (folder / argument).resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError, ValueError) as error:  # Of links that go round, and of NUL.
        raise SurfaceError(f"{shown(argument)} cannot be read: {error}") from None
    if not there:
        raise SurfaceError(f"'{argument}' leads out of the folder of the experiment; put it there")
    return load_sample(folder / argument)


def _check_wavelengths(sample: Sample, wavelengths: tuple[str, ...]) -> None:
    """Refuse wavelengths at which the sample has no indices, or that none are given."""
    media = sample.outside, *(layer.index for layer in sample.layers)
    dependent = next(filter(depends_on_wavelength, media), None)
    if dependent is not None and not wavelengths:
        raise SurfaceError(
            f"sample: {dependent} depends on the wavelength; give one above [[measurements]], "
            f'wavelengths = ["550 nm"]'
        )
    faults = Faults()
    faults.attempt("wavelengths", sample.indices, [*wavelengths] or None)
    if faults:
        raise SurfaceError(*faults)


def _faults_of_sensor(tables: list[Any]) -> Iterator[str]:
    measures = [table.get("measure") for table in tables if isinstance(table, dict)]
    if measures and all(measure in _WITHOUT_PIXELS for measure in measures):
        named = listed([*dict.fromkeys(f"'{measure}'" for measure in measures)])
        yield f"'sensor' is given, but not for {named}, which no pixels see; leave it out"


MEASUREMENT: dict[str, Any] = {"measure": str, "text": str, "incidence": list, "published": list}
MEASUREMENT |= {"within": object, "cells": int, "stokes": list}
MEASUREMENT |= {"brighter_than": object, "noise": object, "azimuth": object}

_NEEDED_BY_MEASUREMENT = ("measure", "text", "incidence")
_LIMITS = ("within", "brighter_than", "noise", "azimuth")
_LARGEST = {"azimuth": ANY_AZIMUTH}
_BY_MEASURE = ("cells", "stokes", "brighter_than", "noise", "azimuth")
_PLAIN = Sample([(1.5, 0.0)])
"""On which directions and light are checked, whatever the sample of the experiment is."""


def measurements_of(
    table: Any, sample: Sample | None, wavelengths: tuple[str, ...]
) -> list[Measurement]:
    """Return a measurement for each angle of incidence."""
    if not isinstance(table, dict):
        raise SurfaceError(f"it must be a table headed [[measurements]], not {shown(table)}")
    faults = Faults(type_faults("", table, MEASUREMENT))
    meant, argument = as_meant(table, MEASUREMENT), readable(table, MEASUREMENT)
    faults += [f"'{key}' is missing" for key in _NEEDED_BY_MEASUREMENT if key not in meant]
    if "measure" in argument:
        faults += _faults_of_measure(argument["measure"], meant, wavelengths)
    faults += _faults_of_limits(argument)
    if "within" in meant and "published" not in meant:
        faults.append("'within' is given, but nothing is 'published'; give both, or leave it out")
    stokes = tuple(argument.get("stokes", UNPOLARISED))
    faults.attempt("", beam_of, _PLAIN, 0.0, stokes=stokes)
    cells = argument.get("cells")
    faults += _faults_of_cells(cells, sample)
    angles = argument.get("incidence", [])
    published = None
    if "incidence" in argument:
        faults += _faults_of_incidence(angles)
        published = faults.attempt("published", _published, argument.get("published"), len(angles))
    if faults or published is None:
        raise SurfaceError(*dict.fromkeys(faults))
    about = argument["measure"], argument["text"]
    limits: dict[str, Any] = {name: float(argument[name]) for name in _LIMITS if name in argument}
    return [
        Measurement(*about, Walks(angle, wavelengths, cells), number, stokes=stokes, **limits)
        for angle, number in zip(angles, published, strict=True)
    ]


def _faults_of_measure(
    measure: str, arguments: Mapping[str, Any], wavelengths: tuple[str, ...]
) -> Iterator[str]:
    if measure not in MEASURES:
        yield f"measure '{measure}' is unknown{did_you_mean(measure, MEASURES)}"
        return
    if len(wavelengths) > 1 and not MEASURES[measure].several:
        yield f"measure '{measure}' is of one wavelength, but there are {len(wavelengths)}"
    for key in _BY_MEASURE:
        if key in arguments and key not in MEASURES[measure].takes:
            yield f"'{key}' is given, but measure '{measure}' does not depend on it; leave it out"


def _faults_of_limits(arguments: Mapping[str, Any]) -> Iterator[str]:
    for name in _LIMITS:
        number, largest = real_number(arguments.get(name, 0.0)), _LARGEST.get(name)
        if number is None or number < 0.0 or (largest is not None and number > largest):
            upto = "" if largest is None else f" to {largest:g}, in degrees"
            yield f"'{name}' is {shown(arguments[name])}; write a number from 0{upto}"


def _faults_of_cells(cells: int | None, sample: Sample | None) -> list[str]:
    if cells is None:
        return []
    faults = Faults(whole_number("cells", cells, 2))
    if not faults and sample is not None:
        faults.attempt("", replace, sample, cells=(cells, cells))
    return faults


def _faults_of_incidence(angles: list[Any]) -> list[str]:
    if not angles:
        return ['incidence is empty; give one angle or more, such as incidence = ["60 deg"]']
    faults = Faults()
    for angle in angles:
        if isinstance(angle, str):
            faults.attempt("", beam_of, _PLAIN, angle)
        else:
            faults.append(f'incidence: {shown(angle)} is no text; write one such as "60 deg"')
    return faults


def _published(numbers: Any, angles: int) -> list[tuple[float, float] | None]:
    """Return the ranges that are published, one for each angle of incidence."""
    if numbers is None:
        return [None] * angles
    if len(numbers) != angles:
        raise SurfaceError(
            f"there are {len(numbers)} numbers, but {angles} angles of incidence; write a number, "
            f"or [LEAST, LARGEST], for each"
        )
    return [_range(number) for number in numbers]


def _range(argument: Any) -> tuple[float, float]:
    several = (
        argument if isinstance(argument, list) and len(argument) == 2 else [argument, argument]
    )
    least, largest = (real_number(one) for one in several)
    if least is None or largest is None or least > largest:
        raise SurfaceError(f"{shown(argument)} is neither a number nor [LEAST, LARGEST]")
    return least, largest
