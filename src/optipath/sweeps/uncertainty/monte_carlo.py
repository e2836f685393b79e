"""Uncertainty by samples."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.uncertainty.drawn_samples import DrawnSamples
from optipath.sweeps.uncertainty.first_order import Spread
from optipath.sweeps.uncertainty.light_figures import STOKES, difference, figures_of, rounding_of
from optipath.sweeps.uncertainty.notes import notes_of_lost_figures

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.light_at import LightAt

PATHS = 1 << 17
"""How many paths a block of samples has at most, if the batch itself has no more."""


def spread_of_samples(
    light_at: LightAt, light: Light, correlation: npt.NDArray[np.float64], count: int, seed: int
) -> tuple[Spread, npt.NDArray[np.float64], list[str]]:
    """Return how the light of samples varies.

    JCGM 101:2008 (Supplement 1 of the GUM), eqs. 16 and 17; for the shares each value varies
    alone, with the same random numbers (annex B).

    Parameters
    ----------
    light_at : LightAt
        What gives the light.
    light : Light
        At the best estimates.
    correlation : ndarray, shape (k, k)
        The coefficients.
    count, seed : int
        How many samples, and what their random numbers begin with.

    Returns
    -------
    spread : Spread
        NaN where some sample does not have a figure.
    mean : ndarray, shape (..., 4)
        Of the Stokes vectors.
    notes : list of str
        What was outside of its range.
    """
    samples = DrawnSamples(light_at.uncertain, correlation, count, seed, len(light.shape))
    names = [each.name for each in light_at.uncertain]
    mean, variance, covariance = _moments(light_at, light, samples, names)
    outside = dict(samples.outside)
    alone = [_moments(light_at, light, samples, [name])[1] for name in names]
    still = variance <= rounding_of(light) ** 2
    variance = np.where(still, 0.0, variance)
    with np.errstate(all="ignore"):
        shares = np.stack(alone, axis=-1) / variance[..., np.newaxis]
    shares = np.where(still[..., np.newaxis], 0.0, shares)
    notes = [
        f"{each.name}: {outside[each.name]:,} of {count:,} samples were outside its range, "
        f"{each.range_text}, and were drawn again: the distribution is cut off there"
        for each in light_at.uncertain
        if outside[each.name]
    ]
    figures = figures_of(light)
    notes += notes_of_lost_figures(~np.isnan(figures) & np.isnan(variance))
    spread = Spread(covariance, np.sqrt(variance), shares)
    return spread, np.asarray(light.stokes) + mean[..., :STOKES], notes


def _moments(
    light_at: LightAt, light: Light, samples: DrawnSamples, names: Sequence[str]
) -> tuple[Any, Any, Any]:
    """Return the mean change of the figures, their variance, and the covariance of four of them.

    All are sums of what differs from the light at the best estimates, one sample after the other,
    so that they are the same to the last bit in whatever blocks.
    """
    center = figures_of(light)
    first: Any = 0.0
    second: Any = 0.0
    crossed: Any = 0.0
    size = max(1, PATHS // max(1, prod(light.shape)))
    for start in range(0, samples.count, size):
        values = samples.within(slice(start, min(start + size, samples.count)))
        some = light_at.beside({name: values[name] for name in names}, names)
        apart = difference(figures_of(some), center)
        stokes = apart[..., :STOKES]
        first, second = _added(first, apart), _added(second, apart**2)
        crossed = _added(crossed, stokes[..., np.newaxis] * stokes[..., np.newaxis, :])
    count = samples.count
    mean = first / count
    variance = np.maximum(second - count * mean**2, 0.0) / (count - 1)
    product = mean[..., :STOKES, np.newaxis] * mean[..., np.newaxis, :STOKES]
    return mean, variance, (crossed - count * product) / (count - 1)


def _added(total: Any, more: Any) -> Any:
    """Return a sum with what is added to it, one after the other along the first axis."""
    total = np.broadcast_to(total, more.shape[1:])
    return np.cumsum(np.concatenate([total[np.newaxis], more]), axis=0)[-1]
