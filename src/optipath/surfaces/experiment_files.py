"""Files of published experiments: the sample and its measurements."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError, shown, unknown
from optipath.paths.files.schema import Faults, checked_table, names_in, presets_folder
from optipath.surfaces.reproduction import ANY_AZIMUTH, MEASURES, Experiment, Measurement, Walks
from optipath.surfaces.sample import Sample
from optipath.surfaces.sample_files import described, load_sample, text_and_file
from optipath.surfaces.walk.beam import UNPOLARISED, beam_of
from optipath.values.precision import real_number, whole_number

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path


_FOLDER = presets_folder() / "experiments"


def experiment_names() -> list[str]:
    """Return the names of the experiments that come with the library, sorted.

    >>> experiment_names()[0]
    'wang-2017-figure-4'
    """
    return names_in(_FOLDER)


def load_experiment(experiment: str | PathLike[str]) -> Experiment:
    """Return an experiment out of its file.

    >>> print(load_experiment("wang-2017-table-1").source)
    M. Wang et al., Optics Express 25(19), 2017, table 1
    """
    see = "`optipath surface reproduce --list`"
    text, path = text_and_file(experiment, "experiment", _FOLDER, see)
    made = partial(_experiment, str(experiment))
    return described(text, path, _TOP, _NEEDED, made)


_TOP: dict[str, Any] = {"format": int, "description": str, "source": str, "sample": str}
_TOP |= {"measurements": list, "wavelengths": list, "photons": int, "sensor": int}
_NEEDED = ("description", "source", "sample", "measurements")

_MEASUREMENT: dict[str, Any] = {"measure": str, "text": str, "incidence": list, "published": list}
_MEASUREMENT |= {"within": object, "cells": int, "stokes": list}
_MEASUREMENT |= {"brighter_than": object, "noise": object, "azimuth": object}
_BY_MEASURE = ("cells", "stokes", "brighter_than", "noise", "azimuth")
_LIMITS = ("within", "brighter_than", "noise", "azimuth")

_PLAIN = Sample([(1.5, 0.0)])
"""On which directions and light are checked, whatever the sample of the experiment is."""


def _experiment(name: str, document: dict[str, Any], folder: Path) -> Experiment:
    more = {key: document[key] for key in ("photons", "sensor") if key in document}
    faults = Faults(fault for key, value in more.items() for fault in whole_number(key, value))
    named = document["sample"]  # By its name, or in a file beside that of the experiment.
    where = folder / named if named.endswith(".toml") else named
    sample = faults.attempt("sample", load_sample, where)
    wavelengths = tuple(map(str, document.get("wavelengths", ())))
    if sample is not None:
        faults.attempt("wavelengths", sample.indices, [*wavelengths] or None)
    results: list[Measurement] = []
    for at, table in enumerate(document["measurements"]):
        where = f"measurements[{at}]"
        results += faults.attempt(where, _measurements, table, sample, wavelengths) or []
    if faults or sample is None:
        raise SurfaceError(*dict.fromkeys(faults))
    about = document["description"], document["source"], sample
    return Experiment(name, *about, tuple(results), **more)


def _measurements(
    table: Any, sample: Sample | None, wavelengths: tuple[str, ...]
) -> list[Measurement]:
    """Return a measurement for each angle of incidence."""
    checked_table(table, _MEASUREMENT, ("measure", "text", "incidence"))
    measure, angles, cells = table["measure"], table["incidence"], table.get("cells")
    stokes = tuple(table.get("stokes", UNPOLARISED))
    faults = Faults(unknown("measure", measure, MEASURES))
    if not faults:
        if len(wavelengths) > 1 and not MEASURES[measure].several:
            faults.append(f"measure '{measure}' is of one wavelength, not of {len(wavelengths)}")
        faults += [
            f"'{key}' is given, but measure '{measure}' does not depend on it; leave it out"
            for key in _BY_MEASURE
            if key in table and key not in MEASURES[measure].takes
        ]
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
    published: list[Any] = [_range(one) for one in numbers] if numbers else [None] * len(angles)
    if len(published) != len(angles):
        faults.append(
            f"there are {len(published)} numbers, but {len(angles)} angles of incidence; write a "
            f"number, or [LEAST, LARGEST], for each"
        )
    elif any(each is not None and not each[0] <= each[1] for each in published):
        faults.append(
            f"published: {shown(table['published'])} has what is neither a number nor "
            f"[LEAST, LARGEST]"
        )
    if faults:
        raise SurfaceError(*dict.fromkeys(faults))
    limits: dict[str, Any] = {name: float(table[name]) for name in _LIMITS if name in table}
    return [
        Measurement(
            measure,
            table["text"],
            Walks(angle, wavelengths, cells),
            number,
            stokes=stokes,
            **limits,
        )
        for angle, number in zip(angles, published, strict=True)
    ]


def _number(value: Any) -> float:
    """Return a real number; NaN, which is within no limits, for what is none."""
    result = real_number(value)
    return float("nan") if result is None else result


def _range(published: Any) -> tuple[float, float]:
    is_pair = isinstance(published, list) and len(published) == 2
    least, largest = published if is_pair else (published, published)
    return _number(least), _number(largest)
