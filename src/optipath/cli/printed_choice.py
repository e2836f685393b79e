"""Which model of light a sample needs, as ``optipath surface --decide`` prints it."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, say, say_json, title
from optipath.cli.given_walk import given_walks
from optipath.cli.photon_bar import photon_bar
from optipath.errors import SurfaceError
from optipath.surfaces.decisions.decide import decide
from optipath.surfaces.samples.sample_files import load_sample
from optipath.surfaces.walk.given_beam import UNPOLARISED
from optipath.values.plain_json import plain

if TYPE_CHECKING:
    from optipath.cli.given_walk import GivenWalk
    from optipath.surfaces.decisions.model_choice import ModelChoice


def print_choices(
    sample: str,
    side: str,
    *,
    as_json: bool,
    tolerance: float | None,
    threads: int | None,
    **options: Any,
) -> None:
    """Decide for each angle of incidence, and print the decisions with their evidence."""
    loaded = load_sample(sample)
    walks = given_walks(loaded, **options, tolerance=None, threads=threads)
    if walks[0].run.beam.states[0] != UNPOLARISED:
        raise SurfaceError("--decide is of unpolarised light; leave --stokes out")
    wanted = 0.02 if tolerance is None else tolerance
    found = []
    for walk in walks:
        with photon_bar(walk.direction) as progress:
            found.append(_decided(walk, wanted, side=side, threads=threads, progress=progress))
        if not as_json:
            if len(found) == 1:
                PlainConsole().print(title(sample, loaded.description))
            say("")
            say(f"{walk.direction}: {found[-1].explain()}")
    if as_json:
        several = [
            {
                "incidence": plain(walk.incidence.shown),
                "units": {"incidence": walk.incidence.unit},
                **asdict(each),
                "difference": _plain(each.difference),
                "multiple": _plain(each.multiple),
                "beside_model": _plain(each.beside_model),
            }
            for walk, each in zip(walks, found, strict=True)
        ]
        one = several[0] if len(several) == 1 else {"directions": several}
        say_json({"sample": sample, **one})


def _plain(pair: tuple[float, float] | None) -> Any:
    """Return a number and its error as JSON has them; one that is not known is null."""
    return None if pair is None else plain(np.asarray(pair))


def _decided(walk: GivenWalk, tolerance: float, **options: Any) -> ModelChoice:
    beam = walk.run.beam
    return decide(
        beam.sample,
        walk.incidence.given,
        tolerance,
        photons=walk.wanted,
        wavelengths=None if walk.wavelengths is None else walk.wavelengths.given,
        azimuth=beam.azimuth,
        seed=beam.seed,
        most_events=beam.most_events,
        **options,
    )
