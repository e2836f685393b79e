"""Uncertainty by samples."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING

import numpy as np

from optipath.sweeps.uncertainty.drawn_samples import DrawnSamples
from optipath.sweeps.uncertainty.first_order import Spread
from optipath.sweeps.uncertainty.light_figures import STOKES, difference, figures_of, rounding_of
from optipath.sweeps.uncertainty.notes import notes_of_lost_figures
from optipath.sweeps.uncertainty.sample_moments import SampleMoments

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.light_at import LightAt

PATHS = 1 << 17
"""How many paths a block of samples has at most, if the batch itself has no more."""


def samples_at_once(shape: tuple[int, ...]) -> int:
    """Return how many samples of a batch of some shape run at once.

    Examples
    --------
    >>> samples_at_once((1000,))
    131
    """
    return max(1, PATHS // max(1, prod(shape)))


def spread_of_samples(
    light_at: LightAt, light: Light, correlation: npt.NDArray[np.float64], count: int, seed: int
) -> tuple[Spread, npt.NDArray[np.float64], list[str]]:
    """Return how the light of samples varies.

    JCGM 101:2008 (Supplement 1 of the GUM), eqs. 16 and 17; for the shares each value varies
    alone, with the same random numbers (annex B).

    Shapes: correlation (k, k); returns mean (..., 4).
    """
    order = [*light_at.plan.inputs.open]
    places = [order.index(each.name) for each in light_at.uncertain]
    axes = len(light.shape)
    samples = DrawnSamples(light_at.uncertain, correlation, places, count, seed, axes)
    names = [each.name for each in light_at.uncertain]
    moments = _moments(light_at, light, samples, names)
    outside = dict(samples.outside)
    alone = [_moments(light_at, light, samples, [name]).deviation for name in names]
    deviation = moments.deviation
    still = deviation <= rounding_of(light)
    deviation = np.where(still, 0.0, deviation)
    with np.errstate(all="ignore"):
        shares = (np.stack(alone, axis=-1) / deviation[..., np.newaxis]) ** 2
    shares = np.where(still[..., np.newaxis], 0.0, shares)
    notes = [
        f"{each.name}: {outside[each.name]:,} of {count:,} samples were outside its range, "
        f"{each.range_text}, and were drawn again: the distribution is cut off there"
        for each in light_at.uncertain
        if outside[each.name]
    ]
    figures = figures_of(light)
    notes += notes_of_lost_figures(~np.isnan(figures) & np.isnan(deviation))
    spread = Spread(moments.covariance, deviation, shares)
    return spread, np.asarray(light.stokes) + moments.mean[..., :STOKES], notes


def _moments(
    light_at: LightAt, light: Light, samples: DrawnSamples, names: Sequence[str]
) -> SampleMoments:
    """Return the moments of what samples differ by from the light at the best estimates."""
    center, found = figures_of(light), SampleMoments(light.intensity)
    size = samples_at_once(light.shape)
    for start in range(0, samples.count, size):
        values = samples.within(slice(start, min(start + size, samples.count)), names)
        some = light_at.beside(values, names)
        with np.errstate(all="ignore"):
            found.add(difference(figures_of(some), center))
    return found
