"""Light carried as intensities alone, and bounds of the intensity without polarization.

With u = artanh(DoP of the source) and d_i = artanh(diattenuation of element i), the intensity
behind a chain of elements that do not depolarise is that without polarisation, times
cosh(eta) / (cosh u prod cosh d_i), where max(0, 2 max - sum) <= eta <= sum over {u, d_i}: each
element is a boost of the Stokes vector (Barakat, J. Opt. Soc. Am. 53, 1963), and boosts of
unknown directions add up like hyperbolic lengths. The products below are these terms without
the artanh, so that a perfect polariser is a number like any other.
"""

from __future__ import annotations

import math
from functools import reduce
from operator import mul
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.carriers.structures import Intensities, along_x_and_y, in_all
from optipath.kernels.linear_solve import Elimination, is_zero
from optipath.kernels.primitives import Primitives, total

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.kernels.carriers.carried import Components, SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure


class IntensityCarrier(Carrier):
    """Carries intensities over one denominator, which is divided by at the very end."""

    def __init__(self, xp: Primitives, least: float = 0.0) -> None:
        super().__init__(xp)
        self.least = least

    def made_for(self, xp: Primitives) -> Carrier:
        return IntensityCarrier(xp, self.least)

    def emit(self, stokes: Components, count: int = 2) -> Intensities:
        s0, s1 = stokes[:2]
        if count == 1:
            return s0, 1.0
        return 0.5 * (s0 + s1), 0.5 * (s0 - s1), 1.0

    def act(
        self, structure: Structure, numbers: Numbers, state: Intensities, count: int = 2
    ) -> Intensities:
        return structure.powers(self.xp, numbers, state, count)

    def add(self, first: Intensities, second: Intensities) -> Intensities:
        if len(first) == len(second) == 2:
            return first[0] * second[1] + second[0] * first[1], first[1] * second[1]
        x1, y1, over1 = along_x_and_y(first)
        x2, y2, over2 = along_x_and_y(second)
        return x1 * over2 + x2 * over1, y1 * over2 + y2 * over1, over1 * over2

    def read(self, state: Intensities, _: int = 1) -> tuple[Components, Any]:
        total, over = in_all(state)
        stored = (total >= self.least) & (over >= self.least)
        return (self.xp.where(stored, total / over, 0.0), 0.0, 0.0, 0.0), 0


class Boosts(NamedTuple):
    """What is known of several boosts of the tangents hyperbolic t_i."""

    most: Any
    more: Any = 1.0
    less: Any = 1.0


def boosted(xp: Primitives, boosts: Boosts, t: Any) -> Boosts:
    """Return the boosts with one more."""
    most, other = xp.maximum(boosts.most, t), xp.minimum(boosts.most, t)
    return Boosts(most, boosts.more * (1.0 + other), boosts.less * (1.0 - other))


def ratio_bounds(xp: Primitives, boosts: Boosts) -> tuple[Any, Any]:
    """Return the least and the largest ratio of the true intensity to that of no polarisation."""
    most, more, less = boosts
    upper = 0.5 * ((1.0 + most) * more + (1.0 - most) * less)
    opposed = 0.5 * ((1.0 + most) * less + (1.0 - most) * more)
    # All others together may undo the largest, unless it is more than they are.
    undone = xp.sqrt((1.0 - most) * (1.0 + most) * more * less)
    return xp.where(most * (more + less) >= more - less, opposed, undone), upper


def dop_bound(boosts: Boosts) -> Any:
    """Return the largest degree of polarisation that boosts can give, or add up to."""
    more, less = (1.0 + boosts.most) * boosts.more, (1.0 - boosts.most) * boosts.less
    return (more - less) / (more + less)


def largest_error(xp: Primitives, lower: Any, upper: Any, model: str) -> Any:
    """Return the largest error of a model of the intensity, from the bounds of the scalar one.

    As a share of the true intensity, or of that of the model, whichever is larger. What any
    model gives that drops components lies between the bounds, too.
    """
    there = lower > 0.0
    lower = xp.where(there, lower, 1.0)
    error = xp.maximum(1.0 / lower - 1.0, upper - 1.0) if model == "scalar" else upper / lower - 1.0
    return xp.where(there, error, math.inf)


class Bounded(NamedTuple):
    """Light of which nothing is known but its intensity without polarisation, and bounds."""

    total: Any
    lower: Any
    upper: Any
    boosts: Boosts
    excess: Any = 0.0


_PARTS = range(6)
"""Of light in a loop: the intensity of no polarization, the most of I and of q, the least of I, of
I - q and of m."""


def _passed(light: Sequence[Any], shares: Sequence[Any]) -> tuple[Any, ...]:
    """Return the parts of light behind an element."""
    total, upper, q, lower, unpolarized, length = light
    mean, t, p, stored, is_pure, left = shares
    behind = (
        (mean, total),
        (mean, _added((1.0, upper), (t, q))),
        (mean, _added((p, upper), (stored, q))),
        (mean, _added((1.0 - t, lower), (t, unpolarized))),
        (mean * (1.0 - p), unpolarized),
        (mean * left, length if is_pure else unpolarized),
    )
    return tuple(map(_added, behind))


def _added(*pairs: tuple[Any, Any]) -> Any:
    """Return the sum of products, a plain 0 where each has a plain 0 for a factor."""
    terms = [a * b for a, b in pairs if not (is_zero(a) or is_zero(b))]
    return total(terms) if terms else 0.0


class BoundsCarrier(Carrier):
    """Carries unpolarized intensities, with bounds of what polarization does, of physical matrices.

    Read are that intensity, the least and the largest ratio of the true one to it, and the largest
    DoP.
    """

    def __init__(self, xp: Primitives, slack: Any = 2.0**-44) -> None:
        super().__init__(xp)
        self.slack = slack

    def emit(self, stokes: Components, _: int = 1) -> Bounded:
        s0, *rest = stokes
        dop = self._ratio(rest, s0)
        excess = self.xp.maximum(dop - 1.0, 0.0)
        return Bounded(s0, 1.0, 1.0, Boosts(self.xp.minimum(dop, 1.0)), excess)

    def act(self, structure: Structure, numbers: Numbers, state: Bounded, _: int = 1) -> Bounded:
        mean, t, polarizance, stored, is_pure = self._shares(structure, numbers)
        total, lower, upper, boosts, excess = state
        after = boosted(self.xp, boosts, t)
        if is_pure:
            return Bounded(mean * total, lower, upper, after, excess)
        # What may depolarise is no boost. The intensity behind it is bounded as if it were, and
        # its light by what the matrix can do at most.
        least, most = ratio_bounds(self.xp, after)
        before = dop_bound(boosts)
        left = 1.0 - t * before
        dop = (polarizance + stored * before) / self.xp.where(left > 0.0, left, 1.0)
        dop = self.xp.where(left > 0.0, self.xp.minimum(dop, 1.0), 1.0)
        return Bounded(mean * total, lower * least, upper * most, Boosts(dop), excess)

    def add(self, first: Bounded, second: Bounded) -> Bounded:
        # Of the degrees of polarisation the larger one is counted.
        xp, sums, dop = self.xp, [0.0, 0.0, 0.0], []
        for light in (first, second):
            least, most = ratio_bounds(xp, light.boosts)
            shares = 1.0, light.lower * least, light.upper * most
            sums = [one + light.total * share for one, share in zip(sums, shares, strict=True)]
            dop.append(dop_bound(light.boosts))
        total, lower, upper = sums
        lit = xp.where(total > 0.0, total, 1.0)
        lower, upper = (xp.where(total > 0.0, part / lit, 1.0) for part in (lower, upper))
        excess = xp.maximum(first.excess, second.excess)
        return Bounded(total, lower, upper, Boosts(xp.maximum(*dop)), excess)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Bounded]) -> dict[int, Bounded]:
        """Return bounded lights at the junctions of a loop, each the sum over all ways to it.

        With I = S0 and q = |(S1, S2, S3)|, an element of mean A, diattenuation t and polarizance p
        lets out I' <= A (I + t q), q' <= A (p I + q); and, since light is I - q of unpolarized
        light and q of polarized, I' >= A ((1 - t) I + t (I - q)), I' - q' >= A (1 - p) (I - q) and
        m' >= A sqrt(1 - p^2) m, m^2 = I^2 - q^2, if it does not depolarize; else of I - q in place
        of m. Sums of lights obey all of them (the triangle inequality, reversed for m in
        Minkowski's space), so that the bounds of all ways together solve linear systems of gains
        >= 0, which are finite where no pivot is <= 0 (M-matrices: Berman & Plemmons, Nonnegative
        Matrices in the Mathematical Sciences, ch. 6).
        """
        xp, places = self.xp, dict[int, int]()
        back: list[dict[int, Any]] = []
        for start, end, elements in solver.ways():
            for junction in (start, end):
                if junction not in places:
                    places[junction] = len(back)
                    back += [{} for _ in _PARTS]
            shares = [self._shares(*each) for each in elements]
            passed = [(*each, xp.sqrt((1.0 - each[2]) * (1.0 + each[2]))) for each in shares]
            for part in _PARTS:
                unit: Sequence[Any] = [float(part == other) for other in _PARTS]
                gains = reduce(_passed, passed, unit)
                column = back[places[start] + part]
                for to, gain in enumerate(gains, places[end]):
                    column[to] = column[to] + gain if to in column else gain
        dark = [0.0] * len(back)
        system = Elimination(xp, back, dark, [False] * len(back))
        given, excess = list[Any](dark), 0.0
        for junction, light in arriving.items():
            place, excess = places[junction], xp.maximum(excess, light.excess)
            given[place : place + len(_PARTS)] = self._begun(light)
        found = system.solved(given)
        # What no light ever gets to may keep all of it. Where light does not fade, some sum is
        # negative, and others may have come to 0 by cancellation.
        pivots = [
            xp.where(number == 0.0, 1.0, xp.where(number > 0.0, pivot, -1.0))
            for number, pivot in zip(found, system.pivots, strict=True)
        ]
        most = [pivot for place, pivot in enumerate(pivots) if place % len(_PARTS) in (1, 2)]
        least = [pivot for place, pivot in enumerate(pivots) if place % len(_PARTS) not in (1, 2)]
        fades, bounded = (reduce(xp.minimum, pivots) > 0.0 for pivots in (least, most))
        # Each division by what hardly comes back enlarges roundings.
        sizes = [xp.where(bounded, pivot, 1.0) for pivot in most]
        excess = excess + self.slack / reduce(mul, [*least, *sizes])
        results = {}
        for junction, place in places.items():
            total, upper, _, lower, unpolarized, length = found[place : place + len(_PARTS)]
            total = xp.where(fades, total, math.nan)
            unit, above = xp.where(total > 0.0, total, 1.0), xp.where(upper > 0.0, upper, 1.0)
            dop = xp.where(bounded, xp.maximum(1.0 - unpolarized / above, 0.0), 1.0)
            results[junction] = Bounded(
                total,
                xp.where(total > 0.0, xp.maximum(lower, length) / unit, 1.0),
                xp.where(total > 0.0, xp.where(bounded, upper / unit, math.inf), 1.0),
                Boosts(xp.where(total > 0.0, dop, 0.0)),
                excess,
            )
        return results

    def _begun(self, light: Bounded) -> tuple[Any, ...]:
        """Return the parts of light that comes to a loop."""
        total, lower, upper, boosts, _ = light
        least, most = ratio_bounds(self.xp, boosts)
        more, less = (1.0 + boosts.most) * boosts.more, (1.0 - boosts.most) * boosts.less
        low, high = total * lower, total * upper
        length = low * self.xp.sqrt(more * less)
        return total, high * most, 0.5 * high * (more - less), low * least, low * less, length

    def _shares(self, structure: Structure, numbers: Numbers) -> tuple[Any, ...]:
        """Return mean, diattenuation, polarizance, stored polarization, and if none is lost."""
        (mean, *first), *rows = structure.rows(self.xp, numbers)
        t = self._share(first, mean)
        if structure.jones is not None:
            return mean, t, t, 1.0, True
        p = self._share([row[0] for row in rows], mean)
        stored = self._share([entry for row in rows for entry in row[1:]], mean)
        return mean, t, p, stored, False

    def read(self, state: Bounded, _: int = 1) -> tuple[Components, Any]:
        least, most = ratio_bounds(self.xp, state.boosts)
        # Light (1, d, 0, 0) is d times (1, 1, 0, 0) less d - 1 of unpolarised light.
        slack = self.slack + 2.0 * state.excess
        upper = state.upper * most * (1.0 + slack)
        # What all but cancels is as sure as what it is left of.
        lower = self.xp.maximum(state.lower * least - slack * upper, 0.0)
        return (state.total, lower, upper, dop_bound(state.boosts)), 0

    def _share(self, parts: Sequence[Any], whole: Any) -> Any:
        """Return the length of a vector over a number, at most 1; 0 where the number is 0."""
        return self.xp.minimum(self._ratio(parts, whole), 1.0)

    def _ratio(self, parts: Sequence[Any], whole: Any) -> Any:
        """Return the length of a vector over a number; 0 where the number is 0."""
        xp = self.xp
        parts = [part for part in parts if not (isinstance(part, float) and part == 0.0)]
        if not parts:
            return 0.0
        length = xp.absolute(parts[0])
        if len(parts) > 1:
            largest = reduce(xp.maximum, map(xp.absolute, parts))
            unit = xp.where(largest > 0.0, largest, 1.0)
            length = largest * xp.sqrt(total([(part / unit) * (part / unit) for part in parts]))
        there = whole > 0.0
        return xp.where(there, length / xp.where(there, whole, 1.0), 0.0)
