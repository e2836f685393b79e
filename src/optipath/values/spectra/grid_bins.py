"""The bins of a grid of wavelengths, over which power per nanometre is added up."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.values.arrays.jax_values import is_traced, namespace

NANOMETRES = 1e9
"""In a metre."""


def grid_fault(wavelengths: Any) -> str:
    """Say why wavelengths are no grid; nothing if they are one.

    Units: wavelengths in metres.

    Examples
    --------
    >>> grid_fault([500e-9, 600e-9]), grid_fault(500e-9)
    ('', 'are one wavelength alone')
    """
    if is_traced(wavelengths):
        return "are traced by JAX, so that their order is not known"
    grid = np.asarray(wavelengths, np.float64)
    if not grid.size:
        return "are none at all"
    if grid.size < 2:
        return "are one wavelength alone"
    if grid.ndim != 1:
        return f"have the shape {grid.shape}, not one axis"
    steps = np.diff(grid)
    if np.all(steps > 0.0) or np.all(steps < 0.0):
        return ""
    return "are repeated" if np.any(steps == 0.0) else "neither rise nor fall throughout"


def grid_edges(wavelengths: Any) -> Any:
    """Return the edges of the bins of a grid, in nanometres.

    A bin reaches halfway to each neighbour, and ends where the grid does, so that the sum of
    density times width is the integral by the trapezoidal rule.

    Shapes: wavelengths (n,); returns (n + 1,). Units: wavelengths in metres.

    Examples
    --------
    >>> grid_edges([400e-9, 500e-9, 700e-9]).round(9)
    array([400., 450., 600., 700.])
    """
    xp = namespace(wavelengths)
    grid = wavelengths if is_traced(wavelengths) else np.asarray(wavelengths, np.float64)
    grid = grid * NANOMETRES
    halfway = 0.5 * (grid[:-1] + grid[1:])
    return xp.concatenate([grid[:1], halfway, grid[-1:]])


def grid_widths(wavelengths: Any) -> Any:
    """Return the widths of the bins of a grid, in nanometres: weights of the trapezoidal rule.

    Shapes: wavelengths (n,); returns (n,). Units: wavelengths in metres.

    Examples
    --------
    >>> grid_widths([400e-9, 500e-9, 700e-9]).round(9)
    array([ 50., 150., 100.])
    """
    xp = namespace(wavelengths)
    return xp.abs(xp.diff(grid_edges(wavelengths)))
