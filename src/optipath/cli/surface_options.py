"""Options of ``optipath surface``, and what their texts stand for."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

import click

from optipath.cli.given_axes import axis_given
from optipath.cli.given_light import WAVELENGTH
from optipath.errors import SurfaceError, listed, shown
from optipath.values.axis_texts import AxisValues, read_entries
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

_INCIDENCE, _AZIMUTH = (Parameter(name, unit="deg") for name in ("incidence", "azimuth"))


def _whole(text: str) -> int:
    """Return a whole number, which may be written as 1e6."""
    with suppress(ValueError):
        return int(text)
    with suppress(ValueError):
        if (number := float(text)).is_integer():
            return int(number)
    raise click.BadParameter(f"{shown(text)} is no whole number; write one such as 1000, or 1e6")


SAMPLE = click.Argument(["sample"], required=False, metavar="[SAMPLE]")
INCIDENCE = click.Option(
    ["--incidence", "incidences"],
    metavar="DEG",
    multiple=True,
    help="The angle of incidence; several by 10,20,30, by 0:80:9 (start:stop:count), or repeated.",
)
PHOTONS = click.Option(
    ["--photons"],
    type=_whole,
    help="How many photons are walked, such as 1e7; 1e6 by default. With --tolerance, at most.",
)
TOLERANCE = click.Option(
    ["--tolerance"],
    type=float,
    help="Walk until the standard error of what is reflected is no larger, such as 0.002.",
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
SEED = click.Option(["--seed"], type=_whole, default=0, help="Of the photons.")
EVENTS = click.Option(
    ["--events", "most_events"],
    type=_whole,
    default=1000,
    help="After how many events a photon is given up.",
)
THREADS = click.Option(
    ["--threads"], type=_whole, help="How many walk at a time; by default one a processor."
)
SURFACES = click.Option(
    ["--surfaces"], type=_whole, help="How many surfaces are drawn, in place of the sample's."
)
CELLS = click.Option(
    ["--cells"], metavar="N|N,N", help="Cells of random surfaces along x and y, ditto."
)
SAMPLE_SEED = click.Option(["--sample-seed"], type=_whole, help="Of random surfaces, ditto.")

WALKING = (INCIDENCE, PHOTONS, TOLERANCE, WAVELENGTHS, AZIMUTH, STOKES, SEED, EVENTS, THREADS)
REDRAWING = (SURFACES, CELLS, SAMPLE_SEED)


def incidences_of(texts: Sequence[str]) -> list[AxisValues]:
    """Return the angles of incidence that options give, each alone.

    Examples
    --------
    >>> [one.shown.item() for one in incidences_of(["0:60:3", "1 rad"])]
    [0.0, 30.0, 60.0, 1.0]
    """
    if not texts:
        raise SurfaceError("--incidence is missing; give the angle of incidence: --incidence 60")
    several = [_values(text, _INCIDENCE, "deg") for text in texts]
    return [
        AxisValues(one.shown[at], one.unit, one.given[at])
        for one in several
        for at in range(len(one.given))
    ]


def wavelengths_of(text: str | None) -> AxisValues | None:
    """Return the wavelengths that an option gives, without an axis where it is one."""
    if text is None:
        return None
    found = _values(text, WAVELENGTH, "")
    return found if axis_given(WAVELENGTH, text, ()) else found.reshaped(())


def azimuth_of(text: str) -> float:
    """Return an azimuth in radians."""
    if axis_given(_AZIMUTH, text, ()) is not None:
        raise SurfaceError(f"--azimuth takes one angle, and {shown(text)} is several; give one")
    return float(_values(text, _AZIMUTH, "deg").given[0])


def numbers_of(option: str, text: str, kind: Any, counts: tuple[int, ...]) -> tuple[Any, ...]:
    """Return numbers with commas between them.

    Parameters
    ----------
    option, text : str
        The option, and what stands behind it.
    kind : type
        Of the numbers.
    counts : tuple of int
        How many there may be.

    Returns
    -------
    tuple

    Examples
    --------
    >>> numbers_of("--cells", "640, 320", int, (1, 2))
    (640, 320)
    """
    try:
        found = tuple([kind(part) for part in text.split(",")])
    except ValueError:
        found = ()
    if len(found) not in counts:
        several = listed([str(count) for count in counts]).replace(" and ", " or ")
        usual = {int: "640", float: "1,0,0,0"}[kind]
        raise SurfaceError(
            f"{option} takes {several} numbers with commas between, such as {usual}, and not "
            f"{shown(text)}"
        )
    return found


def _values(text: str, parameter: Parameter, unit: str) -> AxisValues:
    return axis_given(parameter, text, ()) or read_entries([text], parameter, unit)
