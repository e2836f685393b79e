"""The measurements that a table of an experiment's file describes."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from optipath.errors import SurfaceError, did_you_mean, shown
from optipath.lab.published.experiment import Measurement, Walks
from optipath.lab.published.measured_quantities import ANY_AZIMUTH, MEASURES
from optipath.paths.format.faults import Faults
from optipath.paths.format.schema import as_meant, type_faults
from optipath.surfaces.samples.sample import Sample
from optipath.surfaces.walk.given_beam import UNPOLARISED, given_beam
from optipath.values.affine import real_number
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

MEASUREMENT: dict[str, Any] = {"measure": str, "text": str, "incidence": list, "published": list}
MEASUREMENT |= {"within": object, "cells": int, "stokes": list}
MEASUREMENT |= {"brighter_than": object, "noise": object, "azimuth": object}

_NEEDED = ("measure", "text", "incidence")
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
    faults = Faults(fault.removeprefix("it: ") for fault in type_faults("it", table, MEASUREMENT))
    meant, given = as_meant(table, MEASUREMENT), readable(table, MEASUREMENT)
    faults += [f"'{key}' is missing" for key in _NEEDED if key not in meant]
    if "measure" in given:
        faults += _faults_of_measure(given["measure"], meant, wavelengths)
    faults += _faults_of_limits(given)
    if "within" in meant and "published" not in meant:
        faults.append("'within' is given, but nothing is 'published'; give both, or leave it out")
    stokes = tuple(given.get("stokes", UNPOLARISED))
    faults.attempt("", given_beam, _PLAIN, 0.0, stokes=stokes)
    cells = given.get("cells")
    faults += _faults_of_cells(cells, sample)
    angles = given.get("incidence", [])
    published = None
    if "incidence" in given:
        faults += _faults_of_incidence(angles)
        published = faults.attempt("published", _published, given.get("published"), len(angles))
    if faults or published is None:
        raise SurfaceError(*dict.fromkeys(faults))
    about = given["measure"], given["text"]
    limits: dict[str, Any] = {name: float(given[name]) for name in _LIMITS if name in given}
    return [
        Measurement(*about, Walks(angle, wavelengths, cells), number, stokes=stokes, **limits)
        for angle, number in zip(angles, published, strict=True)
    ]


def _faults_of_measure(
    measure: str, given: Mapping[str, Any], wavelengths: tuple[str, ...]
) -> Iterator[str]:
    if measure not in MEASURES:
        yield f"measure '{measure}' is unknown{did_you_mean(measure, MEASURES)}"
        return
    if len(wavelengths) > 1 and not MEASURES[measure].several:
        yield f"measure '{measure}' is of one wavelength, but there are {len(wavelengths)}"
    for key in _BY_MEASURE:
        if key in given and key not in MEASURES[measure].takes:
            yield f"'{key}' is given, but measure '{measure}' does not depend on it; leave it out"


def _faults_of_limits(given: Mapping[str, Any]) -> Iterator[str]:
    for name in _LIMITS:
        number, largest = real_number(given.get(name, 0.0)), _LARGEST.get(name)
        if number is None or number < 0.0 or (largest is not None and number > largest):
            upto = "" if largest is None else f" to {largest:g}, in degrees"
            yield f"'{name}' is {shown(given[name])}; write a number from 0{upto}"


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
            faults.attempt("", given_beam, _PLAIN, angle)
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


def _range(given: Any) -> tuple[float, float]:
    several = given if isinstance(given, list) and len(given) == 2 else [given, given]
    least, largest = (real_number(one) for one in several)
    if least is None or largest is None or least > largest:
        raise SurfaceError(f"{shown(given)} is neither a number nor [LEAST, LARGEST]")
    return least, largest


def readable(table: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """Return what a table has by keys that are known or meant, where it is of the right type."""
    meant = as_meant(table, schema)
    return {key: value for key, value in meant.items() if schema[key] in (object, type(value))}
