"""What becomes of light on a sample, as it is printed: tables by events, and sums."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed
from optipath.cli.printed_grid import value_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.table import Table

    from optipath.cli.energy_outcome import EnergyOutcome
    from optipath.surfaces.energies.energy_shares import EnergyShares
    from optipath.values.axis_texts import AxisValues

_DIGITS = 6
_MODELS = "with polarisation", "without", "difference"
_SUMS = "R_s", "R_m", "R", "T_s", "T_m", "T", "lost", "absorbed"
_KNOWN = 12
"""How many decimals are more than rounding."""


def measured(mean: float, error: float) -> str:
    """Return a number with the standard error of its last two digits.

    Examples
    --------
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
    lost = {
        "beside the field": energy.sideways,
        f"after {_counted(beam.most_events)}": energy.stuck,
    }
    return said + "".join([f"; {count:,} lost {how}" for how, count in lost.items() if count])


def _text(values: AxisValues) -> str:
    return f"{value_text(values.shown.item(), _DIGITS)} {values.unit}".rstrip()


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
