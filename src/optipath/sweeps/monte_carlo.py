"""Monte Carlo: uncertainty by samples, normal and correlated."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any

import networkx as nx
import numpy as np

from optipath.errors import ParameterError
from optipath.faults import listed
from optipath.light.quantities import QUANTITIES
from optipath.sweeps.first_order import Spread
from optipath.sweeps.light_figures import STOKES, difference, figures_of, rounding_of
from optipath.sweeps.propagation import notes_of_lost_figures

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from optipath.light.light import Light
    from optipath.sweeps.light_figures import LightAt, UncertainValue
    from optipath.values.precision import Numbers


PATHS = 1 << 17
"""How many paths a block of samples has at most, if the batch itself has no more."""


def samples_at_once(shape: tuple[int, ...]) -> int:
    """Return how many samples of a batch of some shape run at once."""
    return max(1, PATHS // max(1, prod(shape)))


def spread_of_samples(
    light_at: LightAt, light: Light, correlation: Numbers, count: int, seed: int
) -> tuple[Spread, Numbers, list[str]]:
    """Return how the light of samples varies.

    JCGM 101:2008 (Supplement 1 of the GUM), eqs. 16 and 17; for the shares each value varies alone,
    with the same random numbers (annex B). Shapes: correlation (k, k); returns mean (..., 4).
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
    notes += notes_of_lost_figures(~np.isnan(figures_of(light)) & np.isnan(deviation))
    spread = Spread(moments.covariance, deviation, shares)
    return spread, np.asarray(light.stokes) + moments.mean[..., :STOKES], notes


def _moments(
    light_at: LightAt, light: Light, samples: DrawnSamples, names: Sequence[str]
) -> SampleMoments:
    """Return the moments of what samples differ by from the light at the best estimates."""
    center, result = figures_of(light), SampleMoments(light.intensity)
    size = samples_at_once(light.shape)
    for start in range(0, samples.count, size):
        values = samples.within(slice(start, min(start + size, samples.count)), names)
        some = light_at.beside(values, names)
        with np.errstate(all="ignore"):
            result.add(difference(figures_of(some), center))
    return result


_CHUNK = 4096
"""How many random numbers begin anew, whatever the blocks are that samples run in."""

_ROUNDS = 1000
"""How often samples outside are drawn again, before what is inside is next to nothing."""


class DrawnSamples:
    """Samples of some values, one set of random numbers for every path of a batch.

    Values out of range are drawn again with those they correlate with (a truncated normal
    distribution). The samples of a value depend on the seed and on its correlated values only, not
    on blocks or the order of values. Shape: correlation (k, k).
    """

    def __init__(
        self,
        uncertain: Sequence[UncertainValue],
        correlation: Numbers,
        places: Sequence[int],
        count: int,
        seed: int,
        axes: int,
    ) -> None:
        self.count, self._seed, self._axes = count, seed, axes
        self._places = {each.name: place for each, place in zip(uncertain, places, strict=True)}
        self._groups = [
            ([uncertain[place] for place in group], _root_of(correlation[np.ix_(group, group)]))
            for group in _groups(correlation, places)
        ]
        self.outside = dict.fromkeys([each.name for each in uncertain], 0)

    def within(self, block: slice, names: Collection[str]) -> dict[str, Numbers]:
        """Return some samples of some values, an axis of them in front of the batch."""
        results: dict[str, list[Any]] = {name: [] for name in names}
        for chunk in range(block.start // _CHUNK, (block.stop - 1) // _CHUNK + 1):
            first = chunk * _CHUNK
            part = slice(max(block.start - first, 0), min(block.stop - first, _CHUNK))
            for group, root in self._groups:
                if any(each.name in results for each in group):
                    drawn = self._within(group, root, chunk, part)
                    for each in group:
                        if each.name in results:
                            results[each.name].append(drawn[each.name])
        return {name: np.concatenate(parts) for name, parts in results.items()}

    def _within(
        self, group: Sequence[UncertainValue], root: Any, chunk: int, part: slice
    ) -> dict[str, Any]:
        results = self._drawn(group, root, chunk, part, 0)
        for each in group:
            outer = ~_inside(each, results[each.name])
            outer = outer.reshape(len(outer), -1).any(axis=1)
            self.outside[each.name] += int(np.count_nonzero(outer))
        for number in range(1, _ROUNDS):
            bad = ~np.logical_and.reduce(
                np.broadcast_arrays(*[_inside(each, results[each.name]) for each in group])
            )
            if not np.any(bad):
                return results
            again = self._drawn(group, root, chunk, part, number)
            results = {name: np.where(bad, again[name], results[name]) for name in results}
        raise ParameterError(
            f"hardly any sample of {listed([each.name for each in group])} is within the range; "
            f"give a smaller uncertainty, or a value farther inside"
        )

    def _drawn(
        self, group: Sequence[UncertainValue], root: Any, chunk: int, part: slice, number: int
    ) -> dict[str, Any]:
        """Return the samples that are drawn in some round, be they inside or not."""
        normal = [self._normal(self._places[each.name], chunk, number)[part] for each in group]
        results = {}
        for each, row in zip(group, root, strict=True):
            mixed = sum(weight * some for weight, some in zip(row, normal, strict=True))
            mixed = np.reshape(mixed, (-1, *(1,) * self._axes))
            with np.errstate(over="ignore"):
                results[each.name] = each.value + each.sigma * mixed
        return results

    def _normal(self, place: int, chunk: int, number: int) -> Numbers:
        own = np.random.SeedSequence(self._seed, spawn_key=(place, chunk, number))
        return np.random.Generator(np.random.PCG64(own)).standard_normal(_CHUNK)


def _groups(correlation: Numbers, places: Sequence[int]) -> list[list[int]]:
    """Return which values are correlated, also by way of others, in the order of their places."""
    linked = nx.from_numpy_array(correlation != 0.0)
    groups = [sorted(each, key=places.__getitem__) for each in nx.connected_components(linked)]
    return sorted(groups, key=lambda group: places[group[0]])


def _root_of(matrix: Numbers) -> Numbers:
    """Return a root R of a matrix of coefficients, R @ R.T, also where it is singular."""
    values, vectors = np.linalg.eigh(matrix)
    return np.asarray((vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T)


def _inside(each: UncertainValue, samples: Any) -> Any:
    return each.allows(samples) & np.isfinite(samples)


class SampleMoments:
    """Sums of differences of sampled figures from those at the best estimates.

    Samples are added one by one: the same to the last bit for any blocks.

    >>> moments = SampleMoments(1e-200)
    >>> moments.add(np.full((2, len(QUANTITIES)), [[1e-200], [3e-200]]))
    >>> print(moments.mean[0], f"{moments.deviation[0]:.3g}")
    2e-200 1.41e-200
    """

    def __init__(self, intensity: Any) -> None:
        power = np.asarray(np.frexp(intensity)[1])[..., np.newaxis]
        self._scale = np.exp2(np.where(np.arange(len(QUANTITIES)) < STOKES, power, 0))
        self._count = 0
        self._first: Any = 0.0
        self._second: Any = 0.0
        self._crossed: Any = 0.0

    def add(self, apart: Numbers) -> None:
        """Add a block of samples. Shape: apart (samples, ..., 10)."""
        with np.errstate(all="ignore"):
            scaled = apart / self._scale
            self._first = _added(self._first, scaled)
            self._second = _added(self._second, scaled**2)
            self._crossed = _added(self._crossed, _products(scaled))
        self._count += len(apart)

    @property
    def mean(self) -> Numbers:
        """Their mean, shape (..., n)."""
        return np.asarray(self._mean * self._scale)

    @property
    def deviation(self) -> Numbers:
        """Their standard deviation, shape (..., n)."""
        with np.errstate(all="ignore"):
            left = np.maximum(self._second - self._count * self._mean**2, 0.0)
            return np.asarray(np.sqrt(left / (self._count - 1)) * self._scale)

    @property
    def covariance(self) -> Numbers:
        """That of the Stokes vector, shape (..., 4, 4)."""
        with np.errstate(all="ignore"):
            left = self._crossed - self._count * _products(self._mean)
            return np.asarray(left / (self._count - 1) * _products(self._scale))

    @property
    def _mean(self) -> Any:
        return self._first / self._count


def _products(figures: Any) -> Any:
    """Return the products of the components of Stokes vectors with each other."""
    stokes = figures[..., :STOKES]
    return stokes[..., :, np.newaxis] * stokes[..., np.newaxis, :]


def _added(total: Any, more: Any) -> Any:
    """Return a sum with what is added to it, one after the other along the first axis."""
    total = np.broadcast_to(total, more.shape[1:])
    return np.cumsum(np.concatenate([total[np.newaxis], more]), axis=0)[-1]
