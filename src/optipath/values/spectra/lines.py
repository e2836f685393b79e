"""Lines: all of a power at one wavelength, as of a laser, in whichever bin holds it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from optipath.errors import ParameterError
from optipath.values.displayed import displayed
from optipath.values.spectra.grid_bins import NANOMETRES, grid_edges, grid_fault
from optipath.values.spectra.spectrum_kind import EmissionLine, SpectrumKind

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

_ROUNDING = 1e-12
"""How far, as a share of it, a line may be beyond the end of a grid that was meant to be there."""


class Lines(SpectrumKind):
    """Power at single wavelengths, and nothing between them."""

    is_pointwise: ClassVar[bool] = False

    def __init__(self, lines: Sequence[EmissionLine]) -> None:
        vars(self).update(lines=tuple(lines), label=called(lines))

    @property
    def extent(self) -> tuple[float, float]:
        places = [line.wavelength for line in self.lines]
        return min(places), max(places)

    @property
    def content(self) -> tuple[Hashable, ...]:
        return "lines", self.lines

    def density(self, xp: Any, wavelength: Any) -> Any:
        return xp.zeros_like(wavelength)

    def times(self, factor: float) -> Lines:
        return Lines([line._replace(power=factor * line.power) for line in self.lines])


def called(lines: Sequence[EmissionLine]) -> str:
    """Return what sentences call some lines.

    Examples
    --------
    >>> called([EmissionLine(633e-9, 1.0)])
    'the line at 633 nm'
    """
    places = [displayed(line.wavelength, "nm") for line in lines]
    if len(places) == 1:
        return f"the line at {places[0]}"
    return f"the {len(places)} lines from {places[0]} on"


def density_of_lines(lines: Sequence[EmissionLine], wavelengths: Any) -> np.ndarray[Any, Any]:
    """Return the power per nanometre of lines, on the grid of wavelengths of a run.

    All power of a line stands in the bin that holds it, and bins are those of `grid_edges`; so
    the integral by the trapezoidal rule is that power on any grid.

    Shapes: wavelengths (n,); returns (n,). Units: wavelengths in metres.

    Examples
    --------
    >>> density_of_lines([EmissionLine(500e-9, 2.0)], [400e-9, 490e-9, 600e-9]).round(9)
    array([0.  , 0.02, 0.  ])
    """
    if fault := grid_fault(wavelengths):
        raise ParameterError(
            f"{called(lines)} has its power in one bin of a grid, and the wavelengths of this run "
            f"{fault}; give two or more that rise or fall along one axis, with which all else "
            f"broadcasts, as numbers and not traced: in Python, "
            f"path.trace(wavelength=op.wavelengths('380 nm', '700 nm', '40 nm'))"
        )
    edges = grid_edges(wavelengths)
    found = np.zeros(edges.size - 1)
    widths, falling = np.abs(np.diff(edges)), edges[0] > edges[-1]
    rising = edges[::-1] if falling else edges
    low, high = rising[0] * (1.0 - _ROUNDING), rising[-1] * (1.0 + _ROUNDING)
    for line in lines:
        place = line.wavelength * NANOMETRES
        if low <= place <= high:
            bin_ = int(np.searchsorted(rising, place, side="right")) - 1
            bin_ = min(max(bin_, 0), found.size - 1)
            bin_ = found.size - 1 - bin_ if falling else bin_
            found[bin_] += line.power / widths[bin_]
        elif line.outside is None and line.power:
            raise ParameterError(
                f"{called([line])} is outside of the wavelengths of this run, {rising[0]:.10g} nm "
                f".. {rising[-1]:.10g} nm, so that none of its power is there; run it at "
                f"wavelengths around it, or give outside=0.0 to the line"
            )
    return found
