"""The law of propagation of uncertainty, to the first order."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.sweeps.uncertainty.light_figures import STOKES, figures_of, gradients_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

_NOISES = 4.0
"""A slope is none that changes the light by less than so many times its noise."""


class Spread(NamedTuple):
    """How figures of light vary.

    Shapes: covariance (..., 4, 4); uncertainties (..., 10); shares (..., 10, k).
    """

    covariance: npt.NDArray[np.float64]
    uncertainties: npt.NDArray[np.float64]
    shares: npt.NDArray[np.float64]


def changes_of(
    light: Light, slopes: Any, uncertain: tuple[UncertainValue, ...], rounding: float
) -> npt.NDArray[np.float64]:
    """Return by how much each figure changes with one standard uncertainty of each value.

    Shapes: slopes (..., 4, k); returns (..., 10, k).
    """
    sigmas, scales = (
        np.stack([np.broadcast_to(n, slopes.shape[:-2]) for n in numbers], axis=-1)
        for numbers in ([u.sigma for u in uncertain], [u.scale for u in uncertain])
    )
    with np.errstate(all="ignore"):
        noise = _NOISES * np.asarray(light.noise)[..., np.newaxis] / scales
        still = (np.abs(slopes) <= noise[..., np.newaxis, :]) | (sigmas == 0.0)[..., np.newaxis, :]
        stokes = np.where(still, 0.0, slopes * sigmas[..., np.newaxis, :])
        gradients = gradients_of(light)
        # One component after the other: 0 changes nothing, be it at a corner.
        terms = [
            np.where(change == 0.0, 0.0, gradients[..., place, np.newaxis] * change)
            for place, change in enumerate(np.moveaxis(stokes, -2, 0)[..., np.newaxis, :])
        ]
        found, size = sum(terms), sum(map(np.abs, terms))
        found = np.where(np.abs(found) <= rounding * size, 0.0, found)
    found[..., :STOKES, :] = stokes
    is_there = ~np.isnan(figures_of(light))[..., np.newaxis]
    return np.where(is_there, found, np.nan)


def spread_of(changes: Any, correlation: npt.NDArray[np.float64]) -> Spread:
    """Return how figures vary that change so much with one standard uncertainty of each value.

    JCGM 100:2008 (GUM), eq. 13, and eq. 10 without correlation; for several figures at once
    JCGM 102:2011, sec. 6.2. The share of a value is that of its row in the double sum of eq. 13.

    Shapes: changes (..., 10, k); correlation (k, k).

    Examples
    --------
    >>> changes = np.zeros((10, 2))
    >>> changes[0] = 3.0, 4.0
    >>> print(spread_of(changes, np.eye(2)).uncertainties[0])
    5.0
    """
    with np.errstate(all="ignore"):
        scale = np.max(np.abs(changes), axis=-1, keepdims=True)
        of_one = changes / np.where(scale == 0.0, 1.0, scale)
        rows = of_one * (of_one @ correlation)
        # Of values that are wholly correlated, rounding may leave less than nothing.
        variance = np.maximum(np.sum(rows, axis=-1, keepdims=True), 0.0)
        shares = np.where(variance == 0.0, 0.0, rows / np.where(variance == 0.0, 1.0, variance))
        stokes = changes[..., :STOKES, :]
        covariance = stokes @ correlation @ np.swapaxes(stokes, -1, -2)
        uncertainties = (scale * np.sqrt(variance))[..., 0]
    return Spread(covariance, uncertainties, shares)
