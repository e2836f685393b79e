"""The experiment that the text of a file describes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, SurfaceError, did_you_mean, shown
from optipath.lab.published.experiment import Experiment, Measurement, Walks
from optipath.lab.published.measured_quantities import MEASURES
from optipath.paths.format.faults import Faults
from optipath.paths.format.schema import FORMAT, as_meant, type_faults
from optipath.paths.presets.toml_text import parsed
from optipath.surfaces.samples.sample_files import load_sample
from optipath.surfaces.walk.given_beam import UNPOLARISED, given_beam
from optipath.values.affine import real_number
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from optipath.surfaces.samples.sample import Sample

TOP: dict[str, Any] = {"format": int, "description": str, "source": str, "sample": str}
TOP |= {"wavelengths": list, "photons": int, "sensor": int, "measurements": list}
MEASUREMENT: dict[str, Any] = {"measure": str, "text": str, "incidence": list, "published": list}
MEASUREMENT |= {"within": object, "cells": int, "stokes": list}
MEASUREMENT |= {"brighter_than": object, "noise": object, "azimuth": object}

_NEEDED = ("format", "description", "source", "sample", "measurements")
_LIMITS = ("within", "brighter_than", "noise", "azimuth")


def experiment_of_text(text: str, path: Path, name: str) -> Experiment:
    """Return the experiment that a text describes.

    Parameters
    ----------
    text : str
        TOML of format 1.
    path : Path
        Its file, beside which that of its sample may be.
    name : str
        What it is called.

    Returns
    -------
    Experiment

    Raises
    ------
    SurfaceError
        With every fault of what it says.
    """
    try:
        return _experiment(parsed(text, str(path)), path.parent, name)
    except OptipathError as error:
        about = "" if str(path) in error.faults[0] else path.name
        raise SurfaceError(*error.faults, about=about) from None


def _experiment(document: dict[str, Any], folder: Path, name: str) -> Experiment:
    faults = Faults(type_faults("the experiment", document, TOP))
    given = _readable(document, TOP)
    faults += [f"the experiment: '{key}' is missing" for key in _NEEDED if key not in given]
    if given.get("format", FORMAT) != FORMAT:
        faults.append(f"format is {given['format']}, but this version reads format {FORMAT}")
    for key in ("photons", "sensor"):
        faults += whole_number(key, given[key]) if key in given else []
    sample = faults.attempt("sample", _sample, given.get("sample", "glass-rough"), folder)
    wavelengths = tuple(map(str, given.get("wavelengths", ())))
    found: list[Measurement] = []
    for at, table in enumerate(given.get("measurements", ())):
        made = faults.attempt(f"measurements[{at}]", _measured, table, sample, wavelengths)
        found += made or []
    if faults or sample is None:
        raise SurfaceError(*dict.fromkeys(faults))
    more = {key: given[key] for key in ("photons", "sensor") if key in given}
    about = given["description"], given["source"], sample
    return Experiment(name, *about, tuple(found), **more)


def _sample(given: str, folder: Path) -> Sample:
    """Return a sample by its name, or out of a file beside that of the experiment or below it."""
    if not given.endswith(".toml"):
        return load_sample(given)
    try:
        there = (folder / given).resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError, ValueError) as error:  # Of links that go round, and of NUL.
        raise SurfaceError(f"{shown(given)} cannot be read: {error}") from None
    if not there:
        raise SurfaceError(f"'{given}' leads out of the folder of the experiment; put it there")
    return load_sample(folder / given)


def _measured(table: Any, sample: Sample | None, wavelengths: tuple[str, ...]) -> list[Measurement]:
    """Return a measurement for each angle of incidence."""
    if not isinstance(table, dict):
        raise SurfaceError(f"it must be a table headed [[measurements]], not {shown(table)}")
    faults = Faults(fault.removeprefix("it: ") for fault in type_faults("it", table, MEASUREMENT))
    given = _readable(table, MEASUREMENT)
    needed = ("measure", "text", "incidence")
    faults += [f"'{key}' is missing" for key in needed if key not in given]
    faults += _faults_of_measure(given.get("measure", "R"), wavelengths)
    faults += _faults_of_limits(given)
    angles = given.get("incidence", [])
    stokes = tuple(given.get("stokes", UNPOLARISED))
    published = faults.attempt("published", _published, given.get("published"), len(angles))
    cells = given.get("cells")
    if cells is not None:
        faults += whole_number("cells", cells, 2)
    if sample is not None:
        check = partial(given_beam, sample, wavelength=[*wavelengths] or None, stokes=stokes)
        for angle in angles:
            faults.attempt("", check, angle)
    if faults or published is None:
        raise SurfaceError(*dict.fromkeys(faults))
    about = given["measure"], given["text"]
    limits: dict[str, Any] = {name: float(given[name]) for name in _LIMITS if name in given}
    return [
        Measurement(*about, Walks(str(angle), wavelengths, cells), number, stokes=stokes, **limits)
        for angle, number in zip(angles, published, strict=True)
    ]


def _faults_of_measure(measure: str, wavelengths: tuple[str, ...]) -> Iterator[str]:
    if measure not in MEASURES:
        yield f"measure '{measure}' is unknown{did_you_mean(measure, MEASURES)}"
    elif len(wavelengths) > 1 and not MEASURES[measure].several:
        yield f"measure '{measure}' is of one wavelength, but there are {len(wavelengths)}"


def _faults_of_limits(given: dict[str, Any]) -> list[str]:
    limits = {name: real_number(given[name]) for name in _LIMITS if name in given}
    return [
        f"'{name}' is {shown(given[name])}; write a number from 0"
        for name, number in limits.items()
        if number is None or number < 0.0
    ]


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


def _range(given: Any) -> tuple[float, float]:
    several = given if isinstance(given, list) and len(given) == 2 else [given, given]
    least, largest = (real_number(one) for one in several)
    if least is None or largest is None or least > largest:
        raise SurfaceError(f"{shown(given)} is neither a number nor [LEAST, LARGEST]")
    return least, largest


def _readable(table: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """Return what a table has by keys that are known or meant, where it is of the right type."""
    meant = as_meant(table, schema)
    return {key: value for key, value in meant.items() if schema[key] in (object, type(value))}
