"""``optipath surface``: what share of light a rough sample sends back and lets through."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from optipath.cli.arguments import NewFile, check_place
from optipath.cli.console import (
    JSON,
    PlainConsole,
    photon_bar,
    say,
    say_descriptions,
    say_json,
    title,
)
from optipath.cli.options import StrictCommand
from optipath.cli.surface_options import DECIDE, REDRAWING, SAMPLE, WALKING
from optipath.errors import SurfaceError, listed
from optipath.surfaces.sample_files import load_sample, sample_descriptions
from optipath.values.files import check_form

if TYPE_CHECKING:
    from pathlib import Path

    from optipath.cli.surface_options import WalkArguments
    from optipath.cli.surface_output import EnergyOutcome
    from optipath.plots.hemisphere_side import PixelQuantity


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
    for name, argument in (("--json", as_json), ("--tolerance", options["tolerance"])):
        if argument:
            raise click.UsageError(f"{name} is of tables, and --map draws; leave one of them out")
    check_form(out)
    check_place(out)
    # Before photons are walked: these tell whether what draws is there.
    from optipath.cli.surface_options import walk_arguments  # noqa: PLC0415 - needs numbers
    from optipath.plots import hemisphere, save  # noqa: PLC0415 - an extra
    from optipath.plots.hemisphere_side import QUANTITIES, quantity_of  # noqa: PLC0415 - ditto
    from optipath.surfaces.hemisphere.measure import measure  # noqa: PLC0415 - needs numbers

    walk = _only(
        walk_arguments(load_sample(sample), **options), quantity_of(quantity, QUANTITIES), side
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


def _only(walks: list[WalkArguments], drawn: PixelQuantity, side: str) -> WalkArguments:
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
    if sample is None:
        _list_samples(as_json=as_json)
    elif quantity is not None:
        if decide:
            raise click.UsageError("--decide and --map are two questions; ask one at a time")
        draw_map(sample, quantity, side, out, as_json=as_json, **options)
    elif out is not None or (side != "reflected" and not decide):
        message = "--out is" if out is not None else "--side is of --decide, and"
        raise click.UsageError(f"{message} of a map; say of what, --map S0")
    elif decide:
        # Neither a list of samples nor an energy needs it.
        from optipath.cli.surface_output import print_choices  # noqa: PLC0415

        print_choices(sample, side, as_json=as_json, **options)
    else:
        _walk(sample, as_json=as_json, **options)


class _SurfaceCommand(StrictCommand):
    """The command, and the one that stands behind it in place of a sample."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any
    ) -> click.Context:
        """Return the context of ``reproduce`` where that stands first, else the own one."""
        if args[:1] != ["reproduce"]:
            return super().make_context(info_name, args, parent, **extra)
        # Neither a list of samples nor a wrong name needs it.
        from optipath.cli.reproduce_command import reproduce  # noqa: PLC0415

        return reproduce.make_context(f"{info_name} reproduce", args[1:], parent, **extra)


surface = click.command(
    "surface", cls=_SurfaceCommand, params=[SAMPLE, DECIDE, *WALKING, *REDRAWING, *DRAWING, JSON]
)(_surface)


def _walk(sample: str, *, as_json: bool, **options: Any) -> None:
    """Walk photons from each direction, and tell of them at once, or all in one JSON object."""
    loaded = load_sample(sample)
    # Neither a list of samples nor a wrong name needs numbers.
    from optipath.cli.console import photon_bar  # noqa: PLC0415
    from optipath.cli.surface_options import walk_arguments  # noqa: PLC0415
    from optipath.cli.surface_output import (  # noqa: PLC0415
        energy_as_json,
        print_energy,
        walked,
    )

    walks = walk_arguments(loaded, **options)
    results: list[EnergyOutcome] = []
    try:
        for walk in walks:
            with photon_bar(walk.direction) as progress:
                results.append(walked(walk, progress))
            if not as_json:
                if len(results) == 1:
                    PlainConsole().print(title(sample, loaded.description))
                say("")
                print_energy(results[-1])
            if results[-1].interrupted:
                raise KeyboardInterrupt
    finally:
        if as_json and results:
            several = [energy_as_json(outcome) for outcome in results]
            one = several[0] if len(walks) == 1 else {"directions": several}
            say_json({"sample": sample, **one})


def _list_samples(*, as_json: bool) -> None:
    context = click.get_current_context()
    options = [one for one in context.command.params if one.name not in ("sample", "as_json")]
    arguments = [
        one.opts[0]
        for one in options
        if context.get_parameter_source(one.name or "") is not ParameterSource.DEFAULT
    ]
    descriptions = sample_descriptions()
    if arguments:
        names = ", ".join(descriptions)
        raise click.UsageError(
            f"SAMPLE is missing, beside {listed(arguments)}; give a file or one of: {names}"
        )
    say_descriptions("sample", descriptions, as_json=as_json)
