"""Whether light changes as its slopes say, as far as the uncertainties reach."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.sweeps.uncertainty.light_figures import (
    STOKES,
    difference,
    figures_of,
    rounding_of,
)

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.light_at import LightAt
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

LARGEST = 0.1
"""How much may be left of an uncertainty, before the first order is doubtful."""

FLAT = 100.0
"""Beyond how much of it there is no slope to speak of."""


STEPS = (1.0, 1.5, 2.0, 2.5, 3.0)
"""How many standard uncertainties away values are looked at: beyond 3 are 0.3 % of all."""


def nonlinearity_of(
    light_at: LightAt, light: Light, changes: Any, uncertainties: Any, correlation: Any
) -> npt.NDArray[np.float64]:
    """Return what the first order leaves, as a share of the uncertainty.

    The path runs with each value up to 3 standard uncertainties up and down, at each pair of values
    with both changed by one, and with all values changed together in the direction in which each
    Stokes component changes most. What the slopes did not say counts for the values that were
    changed; at n uncertainties divided by n squared, so that a curve is the same at all of them.

    Shapes: changes (..., 10, k); uncertainties (..., 10); correlation (k, k); returns (..., 10, k).
    """
    center, uncertain = figures_of(light), light_at.uncertain
    found, rounding = np.zeros_like(changes), rounding_of(light)

    def moved(values: dict[str, Any]) -> Any:
        there = difference(figures_of(light_at.beside(values, [*values])), center)
        # What is lost on the way changes by more than any slope says.
        return np.where(np.isnan(there) & ~np.isnan(center), np.inf, there)

    def count(left: Any, share: Any, step: float = 1.0) -> None:
        """Count what is left for the values that have a share in the change."""
        left = np.where(left <= rounding, 0.0, left / step**2)[..., np.newaxis]
        found[...] = np.where(share, np.fmax(found, left), found)

    inner = [_towards(each, 1.0, -1.0) for each in uncertain]
    alone = [moved({each.name: end}) for each, end in zip(uncertain, inner, strict=True)]
    for along in _directions(changes, correlation):
        size = np.abs(along)
        share = (size > 0.5 * size.max(axis=-1, keepdims=True))[..., np.newaxis, :]
        each = along[..., np.newaxis, :]
        slope = np.sum(np.where(each == 0.0, 0.0, changes * each), axis=-1)
        for step in (sign * step for step in STEPS for sign in (1.0, -1.0)):
            ends = [u.value + step * along[..., k] * u.sigma for k, u in enumerate(uncertain)]
            inside = np.all([u.allows(end) for u, end in zip(uncertain, ends, strict=True)], axis=0)
            values = {
                u.name: np.where(inside, end, u.value)
                for k, (u, end) in enumerate(zip(uncertain, ends, strict=True))
                if np.any(along[..., k])
            }
            try:
                there, said = moved(values), step * slope
            except ParameterError:
                if abs(step) > 1.0:
                    continue  # A path that there is none of so far away.
                raise
            # Phases go round: only within one standard uncertainty must they not.
            with np.errstate(invalid="ignore"):
                left = np.abs(there - said if abs(step) == 1.0 else difference(there, said))
            left = np.where(np.isinf(there), np.inf, left)
            count(np.where(inside[..., np.newaxis], left, 0.0), share, step)
    for one, other in combinations(range(len(uncertain)), 2):
        both = moved({uncertain[place].name: inner[place] for place in (one, other)})
        share = np.isin(np.arange(len(uncertain)), (one, other))
        count(np.abs(both - alone[one] - alone[other]), share)
    with np.errstate(all="ignore"):
        share = found / uncertainties[..., np.newaxis]
    return np.where(found == 0.0, 0.0, share)


def _directions(changes: Any, correlation: Any) -> list[Any]:
    """Return which way values are changed together, in standard uncertainties, shape (..., k)."""
    values = changes.shape[-1]
    batch = (*changes.shape[:-2], values)
    found = [np.broadcast_to(row, batch) for row in np.eye(values)]
    if values > 1:
        stokes = np.nan_to_num(np.moveaxis(changes[..., :STOKES, :], -2, 0))
        together = stokes @ correlation
        with np.errstate(all="ignore"):
            size = np.max(np.abs(stokes), axis=-1, keepdims=True)
            stokes, together = stokes / size, together / size
            scale = np.sqrt(np.sum(stokes * together, axis=-1, keepdims=True))
            found += [*np.nan_to_num(together / scale, posinf=0.0, neginf=0.0)]
    return found


def _towards(each: UncertainValue, *signs: float) -> Any:
    """Return a value plus or minus its uncertainty, the first that it may have; else itself."""
    found = each.value
    for sign in reversed(signs):
        end = each.value + sign * each.sigma
        found = np.where(each.allows(end), end, found)
    return found
