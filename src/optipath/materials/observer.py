"""The standard observer: how much light of each wavelength adds to X, Y and Z."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import ValueFault, unknown

if TYPE_CHECKING:
    from optipath.values.precision import Array


_TABLES = {"CIE 1931 2 deg": "cie_1931_2_deg.csv"}

LUMENS_PER_WATT = 683.0
"""Of light of 540 THz, by the definition of the candela."""

_HALF_BIN = 0.5
_ROUNDING = 1e-6
"""How many nanometres wavelengths may be off by the rounding of metres."""


@dataclass(frozen=True, eq=False)
class Observer:
    """Color-matching functions (m, 3) at whole nanometres (m,), cubic between them."""

    name: str
    wavelengths: Array
    functions: Array

    def at(self, wavelengths: Array) -> Array:
        """Return the functions (n, 3) at wavelengths in nm, by the cubic through four values."""
        place = wavelengths - self.wavelengths[0]
        first = np.clip(np.floor(place).astype(int) - 1, 0, len(self.wavelengths) - 4)
        t = (place - first)[:, np.newaxis]
        a, b, c, d = [self.functions[first + i] for i in range(4)]
        outer = a * (1.0 - t) * (2.0 - t) * (3.0 - t) + d * t * (t - 1.0) * (t - 2.0)
        inner = b * t * (2.0 - t) * (3.0 - t) + c * t * (t - 1.0) * (3.0 - t)
        results: Array = np.maximum(outer / 6.0 + 0.5 * inner, 0.0)
        return results

    def weights(self, grid: Array, *, nearest: bool = False) -> Array:
        """Return the weights (n, 3), per nm, of wavelengths in nm for X, Y and Z.

        Light, linear between its wavelengths, is summed at its own and the observer's, each with
        the bin that reaches halfway to its neighbors; the ends of the observer have a whole
        nanometre, as in the sums of CIE 15:2018, which light at whole nanometres comes to.
        """
        low, high = self.wavelengths[[0, -1]]
        nodes = np.union1d(self.wavelengths, grid[(grid > low) & (grid < high)])
        if not nearest:
            nodes = nodes[(nodes >= grid[0] - _ROUNDING) & (nodes <= grid[-1] + _ROUNDING)]
        result = np.zeros((len(grid), 3))
        if len(nodes) == 0:
            return result
        ends = [nodes[0], nodes[-1]]
        ends[0] -= _HALF_BIN * (nodes[0] == low)
        ends[1] += _HALF_BIN * (nodes[-1] == high)
        widths = np.diff(np.concatenate([ends[:1], 0.5 * (nodes[:-1] + nodes[1:]), ends[1:]]))
        share = self.at(nodes) * widths[:, np.newaxis]
        before = np.clip(np.searchsorted(grid, nodes, side="right") - 1, 0, len(grid) - 2)
        way = (nodes - grid[before]) / (grid[before + 1] - grid[before])
        way = np.clip(way, 0.0, 1.0)[:, np.newaxis]
        np.add.at(result, before, (1.0 - way) * share)
        np.add.at(result, before + 1, way * share)
        return result

    def left_out(self, grid: Array) -> float:
        """Return the largest share of X, Y or Z, of equal energy, beyond a grid in nm."""
        outside = (self.wavelengths < grid[0]) | (self.wavelengths > grid[-1])
        shares = self.functions[outside].sum(axis=0) / self.functions.sum(axis=0)
        return float(np.max(shares))


def observer_called(name: str) -> Observer:
    """Return a standard observer.

    >>> observer = observer_called("CIE 1931 2 deg")
    >>> observer.functions.sum(axis=0).round(3)
    array([106.865, 106.857, 106.892])
    """
    if faults := unknown("observer", name, tuple(_TABLES)):
        raise ValueFault(*faults)
    return _read(name)


@cache
def _read(name: str) -> Observer:
    text = files(__package__).joinpath(_TABLES[name]).read_text("utf-8")
    table = np.loadtxt(text.splitlines()[2:], delimiter=",")
    table.setflags(write=False)
    return Observer(name, table[:, 0], table[:, 1:])
