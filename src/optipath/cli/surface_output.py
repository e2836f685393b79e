"""Output of ``optipath surface``: tables of energies, models, JSON."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed, say
from optipath.materials.quantities import plain
from optipath.surfaces.energy_shares import walk_wanted
from optipath.surfaces.model_choice import decide

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from rich.table import Table

    from optipath.surfaces.energy_shares import Energy, EnergyRun, EnergyShares
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


@dataclass(frozen=True)
class Walk:
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

    @property
    def keywords(self) -> dict[str, Any]:
        """What functions of `optipath.surfaces` take by name."""
        beam = self.run.beam
        return {
            "photons": self.wanted,
            "wavelengths": None if self.wavelengths is None else self.wavelengths.given,
            "azimuth": beam.azimuth,
            "seed": beam.seed,
            "most_events": beam.most_events,
            "threads": self.run.threads,
        }


@dataclass(frozen=True)
class EnergyOutcome:
    """What has become of the light of photons that fell on a sample from one direction."""

    walk: Walk
    energy: Energy
    seconds: float
    interrupted: bool

    def print(self) -> None:
        """Print a few tables for each wavelength."""
        console, energy, wavelengths = PlainConsole(), self.energy, self.walk.wavelengths
        parts: list[Any] = []
        for place in np.ndindex(() if wavelengths is None else wavelengths.given.shape):
            if wavelengths is not None:
                number = f"{wavelengths.shown[place]:.{_DIGITS}g}"
                parts.append(cell(f"wavelength {number} {wavelengths.unit}", "bold"))
            parts += _tables((energy, energy.scalar, energy.difference), place)
        console.print(cell(self.walk.direction, "bold"))
        console.print(cell(self._walked()))
        for part in (*parts, cell("in brackets: the standard error of the last two digits")):
            console.print()
            console.print(part)

    def _walked(self) -> str:
        """Say how many photons there were, and what has become of those that are lost."""
        energy, beam = self.energy, self.walk.run.beam
        surfaces = "one surface" if energy.surfaces == 1 else f"{energy.surfaces:,} surfaces"
        said = f"{energy.photons:,} photons on {surfaces}, seed {beam.seed}, {self.seconds:.1f} s"
        if self.interrupted:
            said += f"; interrupted, {self.walk.wanted:,} were wanted"
        if energy.sideways:
            said += f"; {energy.sideways:,} lost beside the field"
        if energy.stuck:
            said += f"; {energy.stuck:,} lost after {_counted(beam.most_events)}"
        return said

    def as_json(self) -> dict[str, Any]:
        """Return it as JSON can hold it, with all digits."""
        walk, beam = self.walk, self.walk.run.beam
        units = {"incidence": walk.incidence.unit, "azimuth": "deg"}
        results: dict[str, Any] = {
            "incidence": plain(walk.incidence.shown),
            "azimuth": plain(beam.azimuth, "deg"),
            "stokes": [*beam.states[0]],
        }
        if walk.wavelengths is not None:
            results["wavelength"] = plain(walk.wavelengths.shown)
            units["wavelength"] = walk.wavelengths.unit
        results |= {"units": units, "seed": beam.seed}
        if walk.tolerance is not None:
            results["tolerance"] = walk.tolerance
        results |= {"interrupted": self.interrupted, "seconds": self.seconds}
        return results | _json_numbers(asdict(self.energy))


def walked(walk: Walk, progress: Callable[[int, int], None]) -> EnergyOutcome:
    """Return what photons tell; where Ctrl-C comes, what those tell that have been walked."""
    begin, interrupted = perf_counter(), False
    try:
        walk_wanted(walk.run, walk.wanted, walk.tolerance, progress)
    except KeyboardInterrupt:
        if not walk.run.photons:
            raise
        interrupted = True
    return EnergyOutcome(walk, walk.run.energy, perf_counter() - begin, interrupted)


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


def _tables(models: Sequence[EnergyShares], place: tuple[int, ...]) -> Iterator[Table]:
    """Yield the tables of one wavelength."""
    for name in ("reflected", "transmitted"):
        # Events stand before wavelengths.
        each = [getattr(model, name)[:, *place] for model in models]
        lit, most = np.flatnonzero(np.any(each, axis=0)), len(each[0])
        labels = [_counted(count) for count in range(1, most)] + [f"{most} or more events"]
        rows = [[labels[n], *_row(models, name, (n, *place))] for n in range(max([*lit, -1]) + 1)]
        if rows:
            yield headed(f"{name} after", *_MODELS, rows=rows, right=1, box=None)
    rows = [[name, *_row(models, name, place)] for name in _SUMS]
    yield headed("in all", *_MODELS, rows=rows, right=1, box=None)


def _row(models: Sequence[EnergyShares], name: str, place: tuple[int, ...]) -> list[str]:
    pairs = [(getattr(model, name), getattr(model, f"{name}_se")) for model in models]
    return [measured(*(float(np.asarray(part)[place]) for part in pair)) for pair in pairs]


def _counted(events: int) -> str:
    return f"{events:,} event{'s' * (events > 1)}"


@dataclass(frozen=True)
class ChoiceOutcome:
    """Which model suffices for light from one direction."""

    walk: Walk
    choice: ModelChoice
    interrupted: bool = False

    def print(self) -> None:
        """Print it with its evidence."""
        say(f"{self.walk.direction}: {self.choice.explain()}")

    def as_json(self) -> dict[str, Any]:
        """Return it as JSON can hold it; a number and its error that are not known are null."""
        pairs = {
            name: getattr(self.choice, name) for name in ("difference", "multiple", "beside_model")
        }
        return {
            "incidence": plain(self.walk.incidence.shown),
            "units": {"incidence": self.walk.incidence.unit},
            **asdict(self.choice),
            **{name: pair and plain(np.asarray(pair)) for name, pair in pairs.items()},
        }


def decided(
    tolerance: float, side: Any, walk: Walk, progress: Callable[[int, int], None]
) -> ChoiceOutcome:
    """Return which model suffices."""
    beam, angle = walk.run.beam, walk.incidence.given
    choice = decide(beam.sample, angle, tolerance, side=side, progress=progress, **walk.keywords)
    return ChoiceOutcome(walk, choice)
