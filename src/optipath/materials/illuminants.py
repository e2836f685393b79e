"""The CIE's illuminants A, D65 and E, and its standard observer; bins of wavelengths."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.faults import unknown
from optipath.materials.tables import Tabulated
from optipath.values.jax_values import is_traced, namespace

if TYPE_CHECKING:
    from optipath.values.precision import Array


ILLUMINANTS = ("A", "D65", "E")
KNOWN_SPAN = (300e-9, 830e-9)
_NORMAL = 560e-9
_OF_A = 1.435e7 / 2848.0 * 1e-9
"""In metres: c2 and the temperature as of 1931, by which the CIE defines it for good."""

_D65 = np.array(
    [
        *(0.0341, 1.6643, 3.2945, 11.7652, 20.236, 28.6447, 37.0535, 38.5011, 39.9488, 42.4302),
        *(44.9117, 45.775, 46.6383, 49.3637, 52.0891, 51.0323, 49.9755, 52.3118, 54.6482, 68.7015),
        *(82.7549, 87.1204, 91.486, 92.4589, 93.4318, 90.057, 86.6823, 95.7736, 104.865, 110.936),
        *(117.008, 117.41, 117.812, 116.336, 114.861, 115.392, 115.923, 112.367, 108.811, 109.082),
        *(109.354, 108.578, 107.802, 106.296, 104.79, 106.239, 107.689, 106.047, 104.405, 104.225),
        *(104.046, 102.023, 100.0, 98.1671, 96.3342, 96.0611, 95.788, 92.2368, 88.6856, 89.3459),
        *(90.0062, 89.8026, 89.5991, 88.6489, 87.6987, 85.4936, 83.2886, 83.4939, 83.6992, 81.863),
        *(80.0268, 80.1207, 80.2146, 81.2462, 82.2778, 80.281, 78.2842, 74.0027, 69.7213, 70.6652),
        *(71.6091, 72.979, 74.349, 67.9765, 61.604, 65.7448, 69.8856, 72.4863, 75.087, 69.3398),
        *(63.5927, 55.0054, 46.4182, 56.6118, 66.8054, 65.0941, 63.3828, 63.8434, 64.304, 61.8779),
        *(59.4519, 55.7054, 51.959, 54.6998, 57.4406, 58.8765, 60.3125),
    ]
)
"""From 300 to 830 nm in steps of 5 nm (ISO 11664-2:2007, CIE S 014-2)."""

DAYLIGHT = Tabulated("D65", ("value",), np.arange(300, 831, 5) / 1e9, [_D65])


def illuminant_density(name: str, xp: Any, wavelength: Any) -> Any:
    """Return relative powers, 100 at 560 nm, at wavelengths in metres within 300 to 830 nm.

    A is 100 (560 / L)^5 (exp(1.435e7 / (2848 560)) - 1) / (exp(1.435e7 / (2848 L)) - 1) for L in
    nanometres, D65 a table, linear between its samples, and E the same everywhere (CIE 15:2018).
    """
    if name == "E":
        return xp.full_like(wavelength, 100.0)
    if name == "D65":
        return DAYLIGHT.numbers(xp, xp.clip(wavelength, *KNOWN_SPAN))[0]
    at, normal = _OF_A / wavelength, _OF_A / _NORMAL
    hotter = np.expm1(normal) * xp.exp(-at) / -xp.expm1(-at)
    return 100.0 * (_NORMAL / wavelength) ** 5 * hotter


NANOMETRES = 1e9
"""In a metre."""


def grid_fault(wavelengths: Any) -> str:
    """Say why wavelengths are no grid; nothing if they are one.

    >>> grid_fault([500e-9, 600e-9]), grid_fault(500e-9)
    ('', 'are no row of two or more, but of shape ()')
    """
    if is_traced(wavelengths):
        return "are traced by JAX, so that their order is not known"
    grid = np.asarray(wavelengths, np.float64)
    if grid.ndim != 1 or grid.size < 2:
        return f"are no row of two or more, but of shape {grid.shape}"
    steps = np.diff(grid)
    rises_or_falls = np.all(steps > 0.0) or np.all(steps < 0.0)
    return "" if rises_or_falls else "neither rise nor fall throughout"


def grid_edges(wavelengths: Any) -> Any:
    """Return the edges (n + 1,), in nm, of the bins of a grid (n,) in metres.

    Halfway between neighbors, so that density times width sums to the trapezoidal integral.

    >>> grid_edges([400e-9, 500e-9, 700e-9]).round(9)
    array([400., 450., 600., 700.])
    """
    xp = namespace(wavelengths)
    grid = wavelengths if is_traced(wavelengths) else np.asarray(wavelengths, np.float64)
    grid = grid * NANOMETRES
    halfway = 0.5 * (grid[:-1] + grid[1:])
    return xp.concatenate([grid[:1], halfway, grid[-1:]])


def grid_widths(wavelengths: Any) -> Any:
    """Return the bin widths (n,) of a grid, in nm: weights of the trapezoidal rule.

    >>> grid_widths([400e-9, 500e-9, 700e-9]).round(9)
    array([ 50., 150., 100.])
    """
    xp = namespace(wavelengths)
    return xp.abs(xp.diff(grid_edges(wavelengths)))


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
    ValueFault.raise_for(unknown("observer", name, tuple(_TABLES)))
    return _observer(name)


@cache
def _observer(name: str) -> Observer:
    text = files(__package__).joinpath(_TABLES[name]).read_text("utf-8")
    table = np.loadtxt(text.splitlines()[2:], delimiter=",")
    table.setflags(write=False)
    return Observer(name, table[:, 0], table[:, 1:])
