"""Integrals of spectra over wavelength, between the edges of bins."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.spectra.grid_bins import NANOMETRES

if TYPE_CHECKING:
    from optipath.values.spectra.spectrum_kind import SpectrumKind

    Array = np.ndarray[Any, Any]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_ROUNDS = 40
_AGREES = 4e-15


def powers_between(kind: SpectrumKind, edges: Array) -> Array:
    """Return the power of a spectrum in bins, its lines included.

    By Gauss and Legendre with 16 nodes on pieces that are halved until halves come to what the
    whole did; exact, but for rounding, where densities are straight lines.

    Shapes: edges (n + 1,); returns (n,). Units: edges in metres.
    """
    found = smooth_powers(kind, edges)
    for line in kind.lines:
        if edges[0] <= line.wavelength <= edges[-1]:
            place = int(np.searchsorted(edges, line.wavelength, side="right")) - 1
            found[min(place, found.size - 1)] += line.power
    return found


def smooth_powers(kind: SpectrumKind, edges: Array) -> Array:
    """Return what `powers_between` does, lines aside.

    Shape: returns (n,).
    """
    breaks = kind.breaks
    inner = breaks[(breaks > edges[0]) & (breaks < edges[-1])]
    ends = np.union1d(edges, inner)
    low, high = ends[:-1], ends[1:]
    whole = _by_gauss(kind, low, high)
    found, least = np.zeros(edges.size - 1), 1e-17 * float(whole.sum())
    for _ in range(_ROUNDS):
        middle = 0.5 * (low + high)
        halves = _by_gauss(kind, low, middle), _by_gauss(kind, middle, high)
        finer = halves[0] + halves[1]
        good = np.abs(finer - whole) <= np.maximum(_AGREES * finer, least)
        np.add.at(found, np.searchsorted(edges, low[good], side="right") - 1, finer[good])
        if good.all():
            return found
        rough = ~good
        whole = np.concatenate([half[rough] for half in halves])
        low = np.concatenate([low[rough], middle[rough]])
        high = np.concatenate([middle[rough], high[rough]])
    np.add.at(found, np.searchsorted(edges, low, side="right") - 1, whole)
    return found


def _by_gauss(kind: SpectrumKind, low: Array, high: Array) -> Array:
    half = 0.5 * (high - low)
    places = 0.5 * (low + high)[:, None] + half[:, None] * _NODES
    density = kind.density(np, places.ravel()).reshape(places.shape)
    return np.asarray(half * NANOMETRES * (density @ _WEIGHTS))
