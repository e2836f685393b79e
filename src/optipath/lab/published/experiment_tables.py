"""The experiment that the text of a file describes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, SurfaceError, listed, shown
from optipath.lab.published.experiment import Experiment, Measurement
from optipath.lab.published.measured_quantities import MEASURES
from optipath.lab.published.measurement_tables import measurements_of, readable
from optipath.paths.format.faults import Faults
from optipath.paths.format.schema import FORMAT, as_meant, type_faults
from optipath.paths.presets.toml_text import parsed
from optipath.surfaces.samples.sample_files import load_sample
from optipath.surfaces.samples.sample_media import depends_on_wavelength
from optipath.values.cures import of_files
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from optipath.surfaces.samples.sample import Sample

TOP: dict[str, Any] = {"format": int, "description": str, "source": str, "sample": str}
TOP |= {"wavelengths": list, "photons": int, "sensor": int, "measurements": list}

_NEEDED = ("format", "description", "source", "sample", "measurements")
_WITHOUT_PIXELS = [name for name, each in MEASURES.items() if "sensor" not in each.takes]


def experiment_of_text(text: str, path: Path, name: str) -> Experiment:
    """Return the experiment that a text describes."""
    try:
        document = parsed(text, str(path))
        with of_files():
            return _experiment(document, path.parent, name)
    except OptipathError as error:
        about = "" if str(path) in error.faults[0] else path.name
        raise SurfaceError(*error.faults, about=about) from None


def _experiment(document: dict[str, Any], folder: Path, name: str) -> Experiment:
    faults = Faults(type_faults("the experiment", document, TOP))
    meant, given = as_meant(document, TOP), readable(document, TOP)
    faults += [f"the experiment: '{key}' is missing" for key in _NEEDED if key not in meant]
    if given.get("format", FORMAT) != FORMAT:
        faults.append(f"format is {given['format']}, but this version reads format {FORMAT}")
    for key in ("photons", "sensor"):
        faults += whole_number(key, given[key]) if key in given else []
    sample = (
        faults.attempt("sample", _sample, given["sample"], folder) if "sample" in given else None
    )
    wavelengths = tuple(map(str, given.get("wavelengths", ())))
    if sample is not None and ("wavelengths" in given or "wavelengths" not in meant):
        faults.attempt("", _check_wavelengths, sample, wavelengths)
    tables = given.get("measurements", [])
    if "measurements" in given and not tables:
        faults.append("the experiment measures nothing; add a table [[measurements]]")
    faults += _faults_of_sensor(tables) if "sensor" in given else []
    found: list[Measurement] = []
    for at, table in enumerate(tables):
        made = faults.attempt(f"measurements[{at}]", measurements_of, table, sample, wavelengths)
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
