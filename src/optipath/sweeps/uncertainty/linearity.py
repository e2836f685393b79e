"""Whether light changes as its slopes say, as far as the uncertainties reach."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.uncertainty.light_figures import difference, figures_of, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.light_at import LightAt
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

LARGEST = 0.1
"""How much may be left of an uncertainty, before the first order is doubtful."""

FLAT = 100.0
"""Beyond how much of it there is no slope to speak of."""


def nonlinearity_of(
    light_at: LightAt, light: Light, changes: Any, uncertainties: Any
) -> npt.NDArray[np.float64]:
    """Return what the first order leaves, as a share of the uncertainty.

    The path runs at each value one standard uncertainty up and down, and at each pair of values
    with both changed; what the slopes did not say counts for the values that were changed.

    Parameters
    ----------
    light_at : LightAt
        What gives the light.
    light : Light
        At the best estimates.
    changes : ndarray, shape (..., 10, k)
        What slopes say.
    uncertainties : ndarray, shape (..., 10)
        Of the figures.

    Returns
    -------
    ndarray, shape (..., 10, k)
        Infinite where the first order says that nothing varies, and something does.
    """
    center, uncertain = figures_of(light), light_at.uncertain
    found = np.zeros_like(changes)

    def moved(values: dict[str, Any]) -> Any:
        there = difference(figures_of(light_at.beside(values, [*values])), center)
        # What is lost on the way changes by more than any slope says.
        return np.where(np.isnan(there) & ~np.isnan(center), np.inf, there)

    inner = [_towards(each, 1.0, -1.0) for each in uncertain]
    alone = [moved({each.name: end}) for each, end in zip(uncertain, inner, strict=True)]
    for place, each in enumerate(uncertain):
        for sign in (1.0, -1.0):
            left = moved({each.name: _towards(each, sign)}) - sign * changes[..., place]
            is_inside = each.allows(each.value + sign * each.sigma)[..., np.newaxis]
            found[..., place] = np.fmax(found[..., place], np.where(is_inside, np.abs(left), 0.0))
    for one, other in combinations(range(len(uncertain)), 2):
        both = moved({uncertain[place].name: inner[place] for place in (one, other)})
        left = np.abs(both - alone[one] - alone[other])
        for place in (one, other):
            found[..., place] = np.fmax(found[..., place], left)
    with np.errstate(all="ignore"):
        share = found / uncertainties[..., np.newaxis]
    return np.where(found <= rounding_of(light)[..., np.newaxis], 0.0, share)


def _towards(each: UncertainValue, *signs: float) -> Any:
    """Return a value plus or minus its uncertainty, the first that it may have; else itself."""
    found = each.value
    for sign in reversed(signs):
        end = each.value + sign * each.sigma
        found = np.where(each.allows(end), end, found)
    return found
