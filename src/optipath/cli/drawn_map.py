"""The map that ``optipath surface --map`` draws."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from optipath.cli.console import say
from optipath.cli.photon_bar import photon_bar
from optipath.cli.text_files import NewFile, check_place
from optipath.errors import SurfaceError
from optipath.surfaces.samples.sample_files import load_sample
from optipath.values.picture_files import check_form

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.cli.given_walk import GivenWalk
    from optipath.plots.hemispheres.pixel_quantity import PixelQuantity

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
    ["--out"], type=NewFile(), help="Of --map: the file; its ending is .png, .svg or .pdf."
)

DRAWING = (MAP, SIDE, OUT)


def draw_map(
    sample: str, quantity: str, side: str, out: Path | None, *, as_json: bool, **options: Any
) -> None:
    """Walk photons from one direction, and draw what goes into each direction."""
    if out is None:
        raise click.UsageError("--map draws into a file; name it, --out map.png")
    for name, given in (("--json", as_json), ("--tolerance", options["tolerance"])):
        if given:
            raise click.UsageError(f"{name} is of tables, and --map draws; leave one of them out")
    check_form(out)
    check_place(out)
    # Before photons are walked: these tell whether what draws is there.
    from optipath.cli.given_walk import given_walks  # noqa: PLC0415 - needs numbers
    from optipath.plots import hemisphere, save  # noqa: PLC0415 - an extra
    from optipath.plots.hemispheres.pixel_quantity import QUANTITIES  # noqa: PLC0415 - ditto
    from optipath.plots.named_quantity import named_quantity  # noqa: PLC0415 - ditto
    from optipath.surfaces.hemispheres.measure import measure  # noqa: PLC0415 - needs numbers

    walk = _only(
        given_walks(load_sample(sample), **options), named_quantity(quantity, QUANTITIES), side
    )
    beam, source = walk.run.beam, walk.run.beam.states[0]
    with photon_bar(walk.direction) as progress:
        measured = measure(
            beam.sample,
            walk.incidence.given.item(),
            walk.wanted,
            None if walk.wavelengths is None else walk.wavelengths.given,
            seed=beam.seed,
            azimuth=beam.azimuth,
            most_events=beam.most_events,
            threads=walk.run.threads,
            progress=progress,
        )
    drawn = hemisphere(measured, quantity, source=source, side=side)
    save(drawn, out)
    say(f"wrote {out}")


def _only(walks: list[GivenWalk], drawn: PixelQuantity, side: str) -> GivenWalk:
    """Return the walk of which a map can be drawn."""
    if len(walks) > 1:
        raise SurfaceError("--map is of one angle of incidence; give --incidence once")
    walk, faults = walks[0], []
    beam = walk.run.beam
    if side == "transmitted" and beam.indices.opaque:
        faults.append("nothing goes through an opaque sample; leave --side out")
    if not drawn.over_wavelengths and beam.indices.n.size > 1:
        faults.append(f"a map of {drawn.variable} is of one wavelength; give --wavelength one")
    if drawn.masked and any(beam.states[0][1:]):
        faults.append(f"{drawn.variable} is of unpolarised light; leave --stokes out")
    if faults:
        raise SurfaceError(*faults)
    return walk
