"""``optipath surface``: what share of light a rough sample sends back and lets through."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from optipath.cli import console
from optipath.cli.arguments import NEW_FILE, SEED, THREADS, axis_argument, check_place, number
from optipath.cli.console import JSON, say, say_descriptions, say_json
from optipath.cli.options import StrictCommand, completed_by, given_options
from optipath.errors import SurfaceError
from optipath.faults import listed, shown
from optipath.materials.named_materials import WAVELENGTH
from optipath.paths.files.schema import Faults
from optipath.surfaces.energy_shares import run_arguments
from optipath.surfaces.sample_files import load_sample, sample_descriptions, sample_names
from optipath.surfaces.walk.beam import UNPOLARISED
from optipath.values.files import check_form
from optipath.values.parameters import Parameter
from optipath.values.text import AxisValues, read_entries

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from optipath.cli.surface_output import ChoiceOutcome, EnergyOutcome, Walk
    from optipath.surfaces.sample import Sample


SAMPLE = click.Argument(
    ["sample"],
    required=False,
    metavar="[SAMPLE]",
    shell_complete=completed_by(lambda: [*sample_names(), "reproduce"]),
)
INCIDENCE = click.Option(
    ["--incidence", "incidences"],
    metavar="DEG",
    multiple=True,
    help="The angle of incidence; several by '10, 20', by 0:80:9 (start:stop:count), or repeated.",
)
PHOTONS = click.Option(
    ["--photons"],
    type=number,
    help="How many photons are walked, such as 1e7; 1e6 by default. With --tolerance, at most.",
)
TOLERANCE = click.Option(
    ["--tolerance"],
    type=float,
    help="The largest standard error of what is reflected, such as 0.002.",
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
    ["--azimuth"], default="0", metavar="DEG", help="Azimuth of the light, from x towards y."
)
STOKES = click.Option(
    ["--stokes"], default="1,0,0,0", metavar="S0,S1,S2,S3", help="The light; its x is horizontal."
)
EVENTS = click.Option(
    ["--most-events"], type=number, default=1000, help="After how many events a photon is given up."
)
SURFACES = click.Option(
    ["--surfaces"], type=number, help="How many surfaces take turns, in place of the sample's."
)
CELLS = click.Option(
    ["--cells"], metavar="N|N,N", help="Cells of random surfaces along x and y, ditto."
)
SAMPLE_SEED = click.Option(["--sample-seed"], type=number, help="Of random surfaces, ditto.")

MAP = click.Option(
    ["--map", "quantity"],
    metavar="QUANTITY",
    help="Draw a map of S0, S1, S2, S3, DoP, DoLP, AoP, difference, ADM or MDM; needs --out.",
)
SIDE = click.Option(
    ["--side"],
    type=click.Choice(["reflected", "transmitted"]),
    default="reflected",
    help="Of --map and --decide: above the sample, or below.",
)
OUT = click.Option(
    ["--out"], type=NEW_FILE, help="Of --map: the file; its ending is .png, .svg or .pdf."
)

WALKING = (INCIDENCE, PHOTONS, TOLERANCE, WAVELENGTHS, AZIMUTH, STOKES, SEED, EVENTS, THREADS)
REDRAWING = (SURFACES, CELLS, SAMPLE_SEED)


_MOST = 1000
"""How many values there may be of which each has tables."""

_INCIDENCE, _AZIMUTH = (Parameter(name, unit="deg") for name in ("incidence", "azimuth"))


def _values(parameter: Parameter, texts: Sequence[str], unit: str = "") -> list[AxisValues]:
    """Return the values that an option gives, without an axis where it is one."""
    results = [
        axis_argument(parameter, text, ()) or read_entries([text], parameter, unit).reshaped(())
        for text in texts
    ]
    if (count := sum(one.given.size for one in results)) > _MOST:
        raise SurfaceError(f"--{parameter.name} gives {count:,} values; give {_MOST:,} at most")
    return results


def _incidences_of(texts: Sequence[str]) -> list[AxisValues]:
    """Return the angles of incidence that options give, each alone."""
    if not texts:
        raise SurfaceError("--incidence is missing; give the angle of incidence: --incidence 60")
    return [
        AxisValues(one.shown[at], one.unit, one.given[at])
        for one in _values(_INCIDENCE, texts, "deg")
        for at in np.ndindex(one.given.shape)
    ]


def _azimuth_of(text: str) -> float:
    """Return an azimuth in radians."""
    (result,) = _values(_AZIMUTH, [text], "deg")
    if result.given.size > 1:
        raise SurfaceError(f"--azimuth takes one angle, and {shown(text)} is several; give one")
    return float(result.given.item())


def _numbers_of(option: str, text: str, usual: str, counts: tuple[int, ...]) -> tuple[Any, ...]:
    """Return numbers with commas between them, of the kind of those that are usual."""
    kind = int if usual.isdecimal() else float
    with suppress(ValueError):
        results = tuple([kind(part) for part in text.split(",")])
        if len(results) in counts:
            return results
    most = " or ".join(map(str, counts))
    raise SurfaceError(f"{option} takes {most} numbers, such as {usual}, not {shown(text)}")


def _walks(
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
) -> list[Walk]:
    """Return the walks that options ask for, one for each angle of incidence."""
    from optipath.cli.surface_output import Walk  # noqa: PLC0415 - slow to import

    faults = Faults()
    angles = faults.attempt("", _incidences_of, incidences) or _incidences_of(["0"])
    texts = [wavelength] if wavelength else []
    lights = next(iter(faults.attempt("", _values, WAVELENGTH, texts) or []), None)
    state = faults.attempt("", _numbers_of, "--stokes", stokes, "1,0,0,0", (4,))
    options |= {
        "azimuth": faults.attempt("", _azimuth_of, azimuth) or 0.0,
        "stokes": state or UNPOLARISED,
        "wavelength": lights.given if lights else None,
    }
    mesh = faults.attempt("", _numbers_of, "--cells", cells, "640", (1, 2)) if cells else None
    drawn = {"surfaces": surfaces, "cells": mesh and (*mesh, mesh[0])[:2], "seed": sample_seed}
    changes = {name: value for name, value in drawn.items() if value is not None}
    sample = faults.attempt("the sample", replace, sample, **changes) or sample
    runs = [
        faults.attempt("", partial(run_arguments, sample, angle.given, **options))
        for angle in angles
    ]
    SurfaceError.raise_for(faults)
    return [
        Walk(angle, lights, *run, options["tolerance"])
        for angle, run in zip(angles, filter(None, runs), strict=True)
    ]


def _surface(
    sample: str | None,
    *,
    decide: bool,
    quantity: str | None,
    side: str,
    out: Path | None,
    as_json: bool,
    **options: Any,
) -> None:
    """List rough samples, or tell what share of light one of them sends back and lets through.

    optipath surface reproduce [NAME]... does published experiments again, and has options of its
    own: optipath surface reproduce --help.
    """
    if sample == "reproduce":
        raise click.UsageError("options stand behind it; write optipath surface reproduce first")
    if quantity is not None and decide:
        raise click.UsageError("--decide and --map are two questions; ask one at a time")
    if sample is None:
        _list_samples(as_json=as_json)
    elif quantity is not None:
        _draw_map(sample, quantity, side, out, as_json=as_json, **options)
    elif out is not None or (side != "reflected" and not decide):
        message = "--out is" if out is not None else "--side is of --decide, and"
        raise click.UsageError(f"{message} of a map; say of what, --map S0")
    else:
        tolerance = options["tolerance"]
        walks = _walks(load_sample(sample), **options | ({"tolerance": None} if decide else {}))
        if decide and walks[0].run.beam.states[0] != UNPOLARISED:
            raise SurfaceError("--decide is of unpolarised light; leave --stokes out")
        from optipath.cli.surface_output import decided, walked  # noqa: PLC0415 - slow to import

        decision = partial(decided, 0.02 if tolerance is None else tolerance, side)
        _tell(sample, walks, decision if decide else walked, as_json=as_json)


class _SurfaceCommand(StrictCommand):
    """The command, and the one that stands behind it in place of a sample."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any
    ) -> click.Context:
        """Return the context of ``reproduce`` where that stands first, else the own one."""
        if args[:1] != ["reproduce"]:
            return super().make_context(info_name, args, parent, **extra)
        from optipath.cli.reproduce_command import reproduce  # noqa: PLC0415 - takes options of it

        return reproduce.make_context(f"{info_name} reproduce", args[1:], parent, **extra)


surface = click.command(
    "surface",
    cls=_SurfaceCommand,
    params=[SAMPLE, DECIDE, *WALKING, *REDRAWING, MAP, SIDE, OUT, JSON],
)(_surface)


def _list_samples(*, as_json: bool) -> None:
    descriptions = sample_descriptions()
    if given := [option for option in given_options() if option != "--json"]:
        names = ", ".join(descriptions)
        raise click.UsageError(
            f"SAMPLE is missing, beside {listed(given)}; give a file or one of: {names}"
        )
    say_descriptions("sample", descriptions, as_json=as_json)


def _tell(
    sample: str,
    walks: Sequence[Walk],
    find: Callable[[Walk, Callable[[int, int], None]], EnergyOutcome | ChoiceOutcome],
    *,
    as_json: bool,
) -> None:
    """Find what each direction tells, and print it at once, or all in one JSON object."""
    results: list[EnergyOutcome | ChoiceOutcome] = []
    try:
        for walk in walks:
            with console.photon_bar(walk.direction) as progress:
                results.append(find(walk, progress))
            if not as_json:
                if len(results) == 1:
                    description = walk.run.beam.sample.description
                    console.PlainConsole().print(console.title(sample, description))
                say("")
                results[-1].print()
            if results[-1].interrupted:
                raise KeyboardInterrupt
    finally:
        if as_json and results:
            several = [outcome.as_json() for outcome in results]
            one = several[0] if len(walks) == 1 else {"directions": several}
            say_json({"sample": sample, **one})


def _draw_map(
    sample: str, quantity: Any, side: Any, out: Path | None, *, as_json: bool, **options: Any
) -> None:
    """Walk photons from one direction, and draw what goes into each direction."""
    if out is None:
        raise click.UsageError("--map draws into a file; name it, --out map.png")
    for name, argument in (("--json", as_json), ("--tolerance", options["tolerance"])):
        if argument:
            raise click.UsageError(f"{name} is of tables, and --map draws; leave one of them out")
    check_form(out)
    check_place(out)
    # Before photons are walked: these tell whether what draws is there.
    from optipath.plots import hemisphere, save  # noqa: PLC0415 - an extra
    from optipath.plots.hemisphere_side import QUANTITIES, quantity_of  # noqa: PLC0415 - ditto
    from optipath.surfaces.hemisphere.measure import measure  # noqa: PLC0415 - slow to import

    drawn = quantity_of(quantity, QUANTITIES)
    walk, *others = _walks(load_sample(sample), **options)
    beam, faults = walk.run.beam, []
    if others:
        faults.append("--map is of one angle of incidence; give --incidence once")
    if side == "transmitted" and beam.indices.opaque:
        faults.append("nothing goes through an opaque sample; leave --side out")
    if not drawn.over_wavelengths and beam.indices.n.size > 1:
        faults.append(f"a map of {drawn.variable} is of one wavelength; give --wavelength one")
    if drawn.masked and any(beam.states[0][1:]):
        faults.append(f"{drawn.variable} is of unpolarised light; leave --stokes out")
    SurfaceError.raise_for(faults)
    with console.photon_bar(walk.direction) as progress:
        incidence = walk.incidence.given.item()
        measured = measure(beam.sample, incidence, **walk.keywords, progress=progress)
    save(hemisphere(measured, quantity, source=beam.states[0], side=side), out)
    say(f"wrote {out}")
