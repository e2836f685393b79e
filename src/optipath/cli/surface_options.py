"""Options of ``optipath surface``."""

from __future__ import annotations

from contextlib import suppress

import click

from optipath.errors import shown
from optipath.surfaces.samples.sample_files import sample_names


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
