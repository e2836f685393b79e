"""Options of ``optipath surface``, and the photons they ask for."""

from __future__ import annotations

import dataclasses
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from optipath.cli.arguments import axis_argument
from optipath.errors import SurfaceError, listed, shown
from optipath.materials.named_materials import WAVELENGTH
from optipath.paths.files.schema import Faults
from optipath.surfaces.energy_shares import run_arguments
from optipath.surfaces.sample_files import sample_names
from optipath.values.parameters import Parameter
from optipath.values.text import AxisValues, read_entries

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.surfaces.energy_shares import EnergyRun
    from optipath.surfaces.sample import Sample


def whole(text: str) -> int:
    """Return a whole number, which may be written as 1e6."""
    with suppress(ValueError):
        return int(text)
    with suppress(ValueError):
        if (number := float(text)).is_integer():
            return int(number)
    raise click.BadParameter(f"{shown(text)} is no whole number; write one such as 1000, or 1e6")


def _names(_ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[str]:
    """Return the samples whose names begin so, and the command in their place, for shells."""
    return [name for name in (*sample_names(), "reproduce") if name.startswith(incomplete)]


SAMPLE = click.Argument(["sample"], required=False, metavar="[SAMPLE]", shell_complete=_names)
INCIDENCE = click.Option(
    ["--incidence", "incidences"],
    metavar="DEG",
    multiple=True,
    help="The angle of incidence; several by '10, 20', by 0:80:9 (start:stop:count), or repeated.",
)
PHOTONS = click.Option(
    ["--photons"],
    type=whole,
    metavar="NUMBER",
    help="How many photons are walked, such as 1e7; 1e6 by default. With --tolerance, at most.",
)
TOLERANCE = click.Option(
    ["--tolerance"],
    type=float,
    help="Walk until the standard error of what is reflected is no larger, such as 0.002.",
)
DECIDE = click.Option(
    ["--decide"],
    is_flag=True,
    help="Tell which model suffices, polarised or not or single scattering, and why. --tolerance "
    "is then the relative error of a pixel's light that will do, 0.02 by default.",
)
WAVELENGTHS = click.Option(
    ["--wavelength"],
    metavar="'516 nm'",
    help="Where an index depends on it; several by '400 nm:700 nm:4' on an opaque base.",
)
AZIMUTH = click.Option(
    ["--azimuth"],
    default="0",
    metavar="DEG",
    help="Towards which side the light goes, from x towards y; of anisotropic samples.",
)
STOKES = click.Option(
    ["--stokes"],
    default="1,0,0,0",
    metavar="S0,S1,S2,S3",
    help="The light; the x of its frame is horizontal.",
)
SEED = click.Option(["--seed"], type=whole, metavar="NUMBER", default=0, help="Of the photons.")
EVENTS = click.Option(
    ["--most-events"],
    type=whole,
    metavar="NUMBER",
    default=1000,
    help="After how many events a photon is given up.",
)
THREADS = click.Option(
    ["--threads"],
    type=whole,
    metavar="NUMBER",
    help="How many walk at a time; by default one a processor.",
)
SURFACES = click.Option(
    ["--surfaces"],
    type=whole,
    metavar="NUMBER",
    help="How many surfaces take turns, in place of the sample's.",
)
CELLS = click.Option(
    ["--cells"], metavar="N|N,N", help="Cells of random surfaces along x and y, ditto."
)
SAMPLE_SEED = click.Option(
    ["--sample-seed"], type=whole, metavar="NUMBER", help="Of random surfaces, ditto."
)

WALKING = (INCIDENCE, PHOTONS, TOLERANCE, WAVELENGTHS, AZIMUTH, STOKES, SEED, EVENTS, THREADS)
REDRAWING = (SURFACES, CELLS, SAMPLE_SEED)


_MOST = 1000
"""How many values there may be of which each has tables."""

_INCIDENCE, _AZIMUTH = (Parameter(name, unit="deg") for name in ("incidence", "azimuth"))


def incidences_of(texts: Sequence[str]) -> list[AxisValues]:
    """Return the angles of incidence that options give, each alone.

    >>> [one.shown.item() for one in incidences_of(["0:60:3", "1 rad"])]
    [0.0, 30.0, 60.0, 1.0]
    """
    if not texts:
        raise SurfaceError("--incidence is missing; give the angle of incidence: --incidence 60")
    several = [_values(text, _INCIDENCE, "deg") for text in texts]
    _refuse_many("--incidence", sum([len(one.given) for one in several]))
    return [
        AxisValues(one.shown[at], one.unit, one.given[at])
        for one in several
        for at in range(len(one.given))
    ]


def wavelengths_of(text: str | None) -> AxisValues | None:
    """Return the wavelengths that an option gives, without an axis where it is one."""
    if text is None:
        return None
    result = _values(text, WAVELENGTH, "")
    _refuse_many("--wavelength", len(result.given))
    return result if axis_argument(WAVELENGTH, text, ()) else result.reshaped(())


def azimuth_of(text: str) -> float:
    """Return an azimuth in radians."""
    if axis_argument(_AZIMUTH, text, ()) is not None:
        raise SurfaceError(f"--azimuth takes one angle, and {shown(text)} is several; give one")
    return float(_values(text, _AZIMUTH, "deg").given[0])


def numbers_of(option: str, text: str, kind: Any, counts: tuple[int, ...]) -> tuple[Any, ...]:
    """Return numbers with commas between them.

    >>> numbers_of("--cells", "640, 320", int, (1, 2))
    (640, 320)
    """
    try:
        results = tuple([kind(part) for part in text.split(",")])
    except ValueError:
        results = ()
    if len(results) not in counts:
        several = listed([str(count) for count in counts]).replace(" and ", " or ")
        usual = {int: "640", float: "1,0,0,0"}[kind]
        raise SurfaceError(
            f"{option} takes {several} numbers with commas between, such as {usual}, and not "
            f"{shown(text)}"
        )
    return results


def _refuse_many(option: str, count: int) -> None:
    if count > _MOST:
        raise SurfaceError(
            f"{option} gives {count:,} values, of which each has tables of its own; give "
            f"{_MOST:,} at most"
        )


def _values(text: str, parameter: Parameter, unit: str) -> AxisValues:
    return axis_argument(parameter, text, ()) or read_entries([text], parameter, unit)


@dataclass(frozen=True)
class WalkArguments:
    """Photons that fall on a sample from one direction, to be walked."""

    incidence: AxisValues
    wavelengths: AxisValues | None
    run: EnergyRun
    wanted: int
    tolerance: float | None

    @property
    def direction(self) -> str:
        """The angle of incidence, as it was given, with its unit."""
        return f"incidence {self.incidence.shown.item():g} {self.incidence.unit}"


def walk_arguments(
    sample: Sample,
    *,
    incidences: Sequence[str],
    wavelength: str | None,
    azimuth: str,
    stokes: str,
    surfaces: int | None,
    cells: str | None,
    sample_seed: int | None,
    **options: Any,
) -> list[WalkArguments]:
    """Return the walks that options ask for, one for each angle of incidence."""
    faults = Faults()
    angles = faults.attempt("", incidences_of, incidences) or incidences_of(["0"])
    lights = faults.attempt("", wavelengths_of, wavelength)
    light: dict[str, Any] = {
        "azimuth": faults.attempt("", azimuth_of, azimuth) or 0.0,
        "stokes": faults.attempt("", numbers_of, "--stokes", stokes, float, (4,)) or (1, 0, 0, 0),
        "wavelength": None if lights is None else lights.given,
    }
    mesh = faults.attempt("", numbers_of, "--cells", cells, int, (1, 2)) if cells else None
    drawn = {"surfaces": surfaces, "cells": mesh and (*mesh, mesh[0])[:2], "seed": sample_seed}
    changes = {name: value for name, value in drawn.items() if value is not None}
    sample = faults.attempt("the sample", dataclasses.replace, sample, **changes) or sample
    runs = [
        faults.attempt("", partial(run_arguments, sample, angle.given, **light, **options))
        for angle in angles
    ]
    if faults:
        raise SurfaceError(*dict.fromkeys(faults))
    return [
        WalkArguments(angle, lights, *run, options["tolerance"])
        for angle, run in zip(angles, filter(None, runs), strict=True)
    ]
