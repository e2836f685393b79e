"""First order: the law of propagation of uncertainty, slopes and linearity.

Ridders' method (C. J. F. Ridders, Adv. Eng. Softw. 4, 75 (1982); Numerical Recipes, sec. 5.7):
steps become shorter, each quotient is extrapolated with those before, and the estimate of least
error (truncation and rounding) is kept, by component and path.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.choice import is_installed
from optipath.errors import ParameterError
from optipath.extras import need
from optipath.faults import shown
from optipath.plan.explanation import operations
from optipath.sweeps.light_figures import STOKES, difference, figures_of, gradients_of, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.plan.plan import Plan
    from optipath.sweeps.light_figures import LightAt, UncertainValue


_NOISES = 4.0
"""A slope is none that changes the light by less than so many times its noise."""


class Spread(NamedTuple):
    """Covariance (..., 4, 4), uncertainties (..., n), shares (..., n, k) of figures of light."""

    covariance: npt.NDArray[np.float64]
    uncertainties: npt.NDArray[np.float64]
    shares: npt.NDArray[np.float64]


def changes_of(
    light: Light, slopes: Any, uncertain: tuple[UncertainValue, ...], rounding: float
) -> npt.NDArray[np.float64]:
    """Return the change (..., n, k) of each figure by a standard uncertainty of each value."""
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
        result, size = sum(terms), sum(map(np.abs, terms))
        result = np.where(np.abs(result) <= rounding * size, 0.0, result)
    result[..., :STOKES, :] = stokes
    is_there = ~np.isnan(figures_of(light))[..., np.newaxis]
    return np.where(is_there, result, np.nan)


def spread_of(changes: Any, correlation: npt.NDArray[np.float64]) -> Spread:
    """Return how figures vary that change so much with one standard uncertainty of each value.

    JCGM 100:2008 (GUM), eq. 13, and eq. 10 without correlation; for several figures at once JCGM
    102:2011, sec. 6.2. The share of a value is that of its row in the double sum of eq. 13. Shapes:
    changes (..., n, k); correlation (k, k).

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


LARGEST = 0.1
"""How much may be left of an uncertainty, before the first order is doubtful."""

FLAT = 100.0
"""Beyond how much of it there is no slope to speak of."""


STEPS = (1.0, 1.5, 2.0, 2.5, 3.0)
"""How many standard uncertainties away values are looked at: beyond 3 are 0.3 % of all."""


def nonlinearity_of(
    light_at: LightAt, light: Light, changes: Any, uncertainties: Any, correlation: Any
) -> npt.NDArray[np.float64]:
    """Return what the first order leaves (..., n, k), as a share of the uncertainty.

    The path runs with each value up to 3 standard uncertainties up and down, each pair changed by
    one, and all along the direction in which each Stokes component changes most; the remainder at n
    uncertainties is divided by n squared, so that a quadratic term counts equally at all of them.
    """
    center, uncertain = figures_of(light), light_at.uncertain
    result, rounding = np.zeros_like(changes), rounding_of(light)

    def moved(values: dict[str, Any]) -> Any:
        there = difference(figures_of(light_at.beside(values, [*values])), center)
        # What is lost on the way changes by more than any slope says.
        return np.where(np.isnan(there) & ~np.isnan(center), np.inf, there)

    def count(left: Any, share: Any, step: float = 1.0) -> None:
        """Count what is left for the values that have a share in the change."""
        left = np.where(left <= rounding, 0.0, left / step**2)[..., np.newaxis]
        result[...] = np.where(share, np.fmax(result, left), result)

    inner = [_one_sigma_away(each) for each in uncertain]
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
        share = result / uncertainties[..., np.newaxis]
    return np.where(result == 0.0, 0.0, share)


def _directions(changes: Any, correlation: Any) -> list[Any]:
    """Return which way values are changed together, in standard uncertainties, shape (..., k)."""
    values = changes.shape[-1]
    batch = (*changes.shape[:-2], values)
    results = [np.broadcast_to(row, batch) for row in np.eye(values)]
    if values > 1:
        stokes = np.nan_to_num(np.moveaxis(changes[..., :STOKES, :], -2, 0))
        together = stokes @ correlation
        with np.errstate(all="ignore"):
            size = np.max(np.abs(stokes), axis=-1, keepdims=True)
            stokes, together = stokes / size, together / size
            scale = np.sqrt(np.sum(stokes * together, axis=-1, keepdims=True))
            results += [*np.nan_to_num(together / scale, posinf=0.0, neginf=0.0)]
    return results


def _one_sigma_away(each: UncertainValue) -> Any:
    """Return a value plus its uncertainty, or minus it where it may not have that; else itself."""
    above, below = each.value + each.sigma, each.value - each.sigma
    return np.where(each.allows(above), above, np.where(each.allows(below), below, each.value))


_FIRST = 0.0437
"""The first step, as a share of the value, or of 1: no round one, against periods of retarders."""
_SHRINK = 1.7
_STEPS = 46
_COLUMNS = 9
_LEAST = 4
_ENOUGH = 1e-12
_ROUNDING = 1e-15
_DOUBT = 16.0
_NEAR = 0.01
"""Closer to an end of its range a value has differences to one side alone."""


def slopes_by_differences(light_at: LightAt) -> npt.NDArray[np.float64]:
    """Return the slopes (..., 4, k) of the Stokes vector along each uncertain value."""
    light = light_at({})
    stokes, noise = np.asarray(light.stokes, np.float64), np.asarray(light.noise, np.float64)
    columns = [_slope(light_at, each, stokes, noise) for each in light_at.uncertain]
    return np.stack(columns, axis=-1)


def _slope(light_at: LightAt, along: UncertainValue, stokes: Any, noise: Any) -> Any:
    """Return the slope along one value, of shape (..., 4)."""
    step, left, right = _steps(along)
    # Quotients of both sides have errors of even orders of the step alone.
    order = np.where((left == 0.0) | (right == 0.0), 1, 2)[..., np.newaxis]
    best, least = np.full_like(stokes, np.nan), np.full_like(stokes, np.inf)
    row: list[Any] = []
    for number in range(_STEPS):
        h = step / _SHRINK**number
        ends = [np.clip(along.value + by, along.low, along.high) for by in (h * right, -h * left)]
        above, below = (
            np.asarray(light_at.beside({along.name: end}, [along.name]).stokes) for end in ends
        )
        width = np.asarray(ends[0] - ends[1])[..., np.newaxis]
        with np.errstate(all="ignore"):
            size = np.maximum(above[..., :1], below[..., :1])
            rounding = np.fmax(_ROUNDING * size, 4.0 * noise[..., np.newaxis]) / width
            before, row = row, [(above - below) / width]
            for column, known in enumerate(before[: _COLUMNS - 1], 1):
                weight = 1.0 / (_SHRINK ** (column * order) - 1.0)
                row.append(row[-1] + (row[-1] - known) * weight)
                error = np.maximum(np.abs(row[-1] - row[-2]), np.abs(row[-1] - known))
                error = error + rounding
                best = np.where(error < least, row[-1], best)
                least = np.fmin(error, least)
            steepest = np.max(np.abs(best), axis=-1, keepdims=True)
        done = (least <= _ENOUGH * steepest) | (least <= 2.0 * rounding) | np.isnan(stokes)
        if number >= _LEAST and np.all(done):
            break
    # What may be all error is none.
    return np.where(np.abs(best) <= _DOUBT * least, 0.0, best)


def _steps(along: UncertainValue) -> tuple[Any, Any, Any]:
    """Return the longest step, and whether it goes to the left and to the right, as 0 and 1."""
    before, behind = along.value - along.low, along.high - along.value
    near = np.minimum(before, behind) < _NEAR * along.scale
    left = np.where(near & (behind >= before), 0.0, 1.0)
    right = np.where(near & (behind < before), 0.0, 1.0)
    room = np.minimum(np.where(left, before, np.inf), np.where(right, behind, np.inf))
    return np.minimum(_FIRST * along.scale, room), left, right


_SLOPE_STEPS, _OPERATIONS = 100, 1_000
"""Beyond these JAX takes seconds, or minutes, for slopes that differences have at once."""


def slopes_of(light_at: LightAt, method: str) -> tuple[npt.NDArray[np.float64], str, float]:
    """Return the slopes (..., 4, k) of the Stokes vector, how they were found, and rounding."""
    if method == "gradients":
        return _gradients(light_at)
    why = ""
    if method == "auto" and is_installed("jax"):
        why = _why_not(light_at.plan)
        if not why:
            try:
                return _gradients(light_at)
            except ParameterError:
                why = ", since JAX does not trace this path"
    return slopes_by_differences(light_at), f"differences{why}", 1e-8


def _gradients(light_at: LightAt) -> tuple[npt.NDArray[np.float64], str, float]:
    need("gradients", "jax")
    try:
        return _slopes_by_jax(light_at), "gradients by JAX", 1e-12
    except Exception as fault:  # noqa: BLE001 - an element of one's own may raise anything
        raise ParameterError(
            f"JAX does not trace this path, which raises {shown(fault)}; write method='differences'"
        ) from None


def _slopes_by_jax(light_at: LightAt) -> npt.NDArray[np.float64]:
    """Return the slopes (..., 4, k) of the Stokes vector along each uncertain value, by JAX.

    Not compiled: that would take seconds a path, for slopes mostly needed once.
    """
    import jax  # noqa: PLC0415 - an extra

    from optipath.engines.jax_path import double_precision  # noqa: PLC0415 - an extra

    uncertain = light_at.uncertain

    def stokes(values: dict[str, Any]) -> Any:
        return light_at(values).stokes

    def along(tangents: dict[str, Any]) -> Any:
        return jax.jvp(stokes, (values,), (tangents,))[1]

    with double_precision()(True), jax.disable_jit():  # noqa: FBT003 - as JAX has it
        values = {each.name: jax.numpy.asarray(each.value) for each in uncertain}
        tangents = {
            each.name: jax.numpy.asarray(np.multiply.outer(row, np.ones(each.value.shape)))
            for row, each in zip(np.eye(len(uncertain)), uncertain, strict=True)
        }
        result = np.asarray(jax.vmap(along)(tangents))
    return np.moveaxis(result, 0, -1)


def _why_not(plan: Plan) -> str:
    """Return why JAX is not asked, though it is there; nothing if it is."""
    if len(plan.program.steps) > _SLOPE_STEPS:
        return f", since JAX takes long for {len(plan.program.steps):,} steps"
    counted = operations(plan.answers.light, unreduced=plan.reduction.unreduced)
    if counted is not None and counted["all"] > _OPERATIONS:
        return f", since JAX takes long for {counted['all']:,} operations"
    return ""
