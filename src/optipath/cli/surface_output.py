"""Output of ``optipath surface``: tables of energies, model choice, JSON."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed, photon_bar, say, say_json, title
from optipath.cli.outcome import printed_value
from optipath.cli.surface_options import walk_arguments
from optipath.errors import SurfaceError
from optipath.materials.quantities import plain
from optipath.surfaces.energy_shares import walk_wanted
from optipath.surfaces.model_choice import decide
from optipath.surfaces.sample_files import load_sample
from optipath.surfaces.walk.beam import UNPOLARISED

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from rich.table import Table

    from optipath.cli.surface_options import WalkArguments
    from optipath.surfaces.energy_shares import Energy, EnergyShares
    from optipath.surfaces.model_choice import ModelChoice
    from optipath.values.text import AxisValues


_DIGITS = 6
_MODELS = "with polarisation", "without", "difference"
_SUMS = "R_s", "R_m", "R", "T_s", "T_m", "T", "lost", "absorbed"
_KNOWN = 12
"""How many decimals are more than rounding."""


def measured(mean: float, error: float) -> str:
    """Return a number with the standard error of its last two digits.

    >>> measured(0.1602437, 0.000123), measured(0.5, 0.00996), measured(1.0, 0.0)
    ('0.16024(12)', '0.500(10)', '1')
    """
    if not error > 10.0**-_KNOWN:
        return f"{round(mean, _KNOWN) + 0.0:.{_DIGITS}g}"
    # Rounded to two digits, before it is told where they stand.
    digits = max(0, 1 - int(f"{error:.1e}".partition("e")[2]))
    return f"{mean:z.{digits}f}({error * 10**digits:.0f})"


def print_energy(outcome: EnergyOutcome) -> None:
    """Print what has become of the light, a few tables for each wavelength."""
    console = PlainConsole()
    energy, wavelengths = outcome.energy, outcome.given.wavelengths
    models = energy, energy.scalar, energy.difference
    console.print(cell(outcome.given.direction, "bold"))
    console.print(cell(_walked(outcome)))
    several = [()] if wavelengths is None else [*np.ndindex(wavelengths.given.shape)]
    for place in several:
        if wavelengths is not None:
            at = type(wavelengths)(wavelengths.shown[place], wavelengths.unit, wavelengths.given)
            console.print()
            console.print(cell(f"wavelength {_text(at)}", "bold"))
        for table in _tables(models, place):
            console.print()
            console.print(table)
    console.print()
    console.print(cell("in brackets: the standard error of the last two digits"))


def _walked(outcome: EnergyOutcome) -> str:
    """Say how many photons there were, and what has become of those that are lost."""
    energy, beam = outcome.energy, outcome.given.run.beam
    surfaces = "one surface" if energy.surfaces == 1 else f"{energy.surfaces:,} surfaces"
    said = f"{energy.photons:,} photons on {surfaces}, seed {beam.seed}, {outcome.seconds:.1f} s"
    if outcome.interrupted:
        said += f"; interrupted, {outcome.given.wanted:,} were wanted"
    missing = {
        "beside the field": energy.sideways,
        f"after {_counted(beam.most_events)}": energy.stuck,
    }
    return said + "".join([f"; {count:,} lost {how}" for how, count in missing.items() if count])


def _text(values: AxisValues) -> str:
    return f"{printed_value(values.shown.item(), _DIGITS)} {values.unit}".rstrip()


def _tables(models: Sequence[EnergyShares], place: tuple[int, ...]) -> Iterator[Table]:
    """Yield the tables of one wavelength."""
    for name in ("reflected", "transmitted"):
        # Events stand before wavelengths.
        each = [getattr(model, name)[:, *place] for model in models]
        lit = np.flatnonzero(np.any(each, axis=0))
        if lit.size:
            table = _table(f"{name} after")
            for count in range(1, int(lit[-1]) + 2):
                row = _row(models, name, (count - 1, *place))
                table.add_row(*map(cell, (_events(count, len(each[0])), *row)))
            yield table
    table = _table("in all")
    for name in _SUMS:
        table.add_row(*map(cell, (name, *_row(models, name, place))))
    yield table


def _table(corner: str) -> Table:
    table = headed(corner, *_MODELS, box=None)
    for column in table.columns[1:]:
        column.justify = "right"
    return table


def _row(models: Sequence[EnergyShares], name: str, place: tuple[int, ...]) -> Iterator[str]:
    for model in models:
        mean, error = (np.asarray(getattr(model, part))[place] for part in (name, f"{name}_se"))
        yield measured(float(mean), float(error))


def _events(count: int, most: int) -> str:
    """Say how many events there were; the last row is of as many or more."""
    return f"{count} or more events" if count == most else _counted(count)


def _counted(events: int) -> str:
    return f"{events:,} event{'s' * (events > 1)}"


@dataclass(frozen=True)
class EnergyOutcome:
    """What photons have told that fell on a sample from one direction."""

    given: WalkArguments
    energy: Energy
    seconds: float
    interrupted: bool


def walked(argument: WalkArguments, progress: Callable[[int, int], None]) -> EnergyOutcome:
    """Return what photons tell; where Ctrl-C comes, what those tell that have been walked."""
    begin, interrupted = perf_counter(), False
    try:
        walk_wanted(argument.run, argument.wanted, argument.tolerance, progress)
    except KeyboardInterrupt:
        if not argument.run.photons:
            raise
        interrupted = True
    return EnergyOutcome(argument, argument.run.energy, perf_counter() - begin, interrupted)


def energy_as_json(outcome: EnergyOutcome) -> dict[str, Any]:
    """Return an outcome as JSON can hold it, with all digits."""
    argument, beam = outcome.given, outcome.given.run.beam
    units = {"incidence": argument.incidence.unit, "azimuth": "deg"}
    results: dict[str, Any] = {
        "incidence": plain(argument.incidence.shown),
        "azimuth": plain(beam.azimuth, "deg"),
        "stokes": [*beam.states[0]],
    }
    if argument.wavelengths is not None:
        results["wavelength"] = plain(argument.wavelengths.shown)
        units["wavelength"] = argument.wavelengths.unit
    results |= {"units": units, "seed": beam.seed}
    if argument.tolerance is not None:
        results["tolerance"] = argument.tolerance
    results |= {"interrupted": outcome.interrupted, "seconds": outcome.seconds}
    return {**results, **_json_numbers(asdict(outcome.energy))}


def _json_numbers(results: dict[str, Any]) -> dict[str, Any]:
    """Return numbers and arrays as JSON can hold them; counts stay whole."""
    return {
        name: _json_numbers(value)
        if isinstance(value, dict)
        else value
        if isinstance(value, int)
        else plain(np.asarray(value))
        for name, value in results.items()
    }


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
    walks = walk_arguments(loaded, **options, tolerance=None, threads=threads)
    if walks[0].run.beam.states[0] != UNPOLARISED:
        raise SurfaceError("--decide is of unpolarised light; leave --stokes out")
    wanted = 0.02 if tolerance is None else tolerance
    results = []
    for walk in walks:
        with photon_bar(walk.direction) as progress:
            results.append(_decided(walk, wanted, side=side, threads=threads, progress=progress))
        if not as_json:
            if len(results) == 1:
                PlainConsole().print(title(sample, loaded.description))
            say("")
            say(f"{walk.direction}: {results[-1].explain()}")
    if as_json:
        several = [
            {
                "incidence": plain(walk.incidence.shown),
                "units": {"incidence": walk.incidence.unit},
                **asdict(each),
                "difference": _plain_pair(each.difference),
                "multiple": _plain_pair(each.multiple),
                "beside_model": _plain_pair(each.beside_model),
            }
            for walk, each in zip(walks, results, strict=True)
        ]
        one = several[0] if len(several) == 1 else {"directions": several}
        say_json({"sample": sample, **one})


def _plain_pair(pair: tuple[float, float] | None) -> Any:
    """Return a number and its error as JSON has them; one that is not known is null."""
    return None if pair is None else plain(np.asarray(pair))


def _decided(walk: WalkArguments, tolerance: float, **options: Any) -> ModelChoice:
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
