"""Gains: how much of the light in a loop comes back each time round; 1 or more has no sum."""

from __future__ import annotations

import warnings
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import LoopWarning, ParameterError
from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.values.calls_up import calls_up

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from optipath.engines.program.loops import LoopSolver

    Array = np.ndarray[Any, Any]

_MOST = 1 << 22
"""How many entries of matrices are looked at together; larger systems are judged by sums."""

_WARNED = 1e-4
"""What leaves a loop each time round below which it is told, as a share."""

_FEW_DIGITS, _NEAR = 1e-9, 1e-3
"""How near to 1 a gain has lost its digits, and how near it may have, where light gains."""

_ROUNDING = 1e-15


class LargestGain(NamedTuple):
    """That path of a batch of which most stays in a loop."""

    closed: bool
    leaves: float
    condition: float


def check_gains(solvers: Sequence[LoopSolver]) -> None:
    """Refuse light that gains going round; warn where nearly all of it comes back.

    Where no element amplifies, all of some light stays where a pivot is 0. Else the spectral
    radius of the whole round trip tells; next to 1, whether unpolarised light that is given to
    every junction adds up to light that can be, which it does where the radius is below 1, and
    only there (Krein & Rutman, Uspekhi Mat. Nauk 3, 1948).
    """
    faults = []
    for solver in solvers:
        if np.all(reduce(np.logical_and, solver.conditions, np.True_)):
            continue
        place = solver.program.steps[solver.loop.start].label
        worst = _Judged(solver).worst()
        if worst is None:
            faults.append(
                f"what comes back of the light that goes round at '{place}' is no finite number: "
                f"a value is too extreme; give values nearer to 1, or compose with "
                f"method='stable' and dtype='float64'"
            )
        elif worst.closed:
            faults.append(
                f"light that goes round at '{place}' never fades: {1.0 - worst.leaves:.9g} of it "
                f"comes back each time; let some of it leave, or absorb some"
            )
        elif worst.leaves < _WARNED:
            warnings.warn(
                f"of the light that goes round at '{place}', all but {worst.leaves:.2g} comes back "
                f"each time; the condition number of the sum is {worst.condition:.2g}, by which "
                f"errors of the values that are given may be enlarged",
                LoopWarning,
                stacklevel=calls_up(),
            )
    if faults:
        raise ParameterError(*faults)


class _Judged:
    """The doubtful paths of a batch, by what the unknowns of a loop are to each other."""

    def __init__(self, solver: LoopSolver) -> None:
        self.solver = solver
        self.columns = [solver.scattered(column.back) for column in solver.columns]
        numbers = [*solver.pivots, *(n for column in self.columns for n in column.values())]
        self.shape = np.broadcast_shapes((1,), *(np.shape(_plain(number)) for number in numbers))
        holds = reduce(np.logical_and, solver.conditions, np.True_)
        self.where = tuple(np.argwhere(~np.broadcast_to(holds, self.shape)).T)
        # What no light ever gets to may keep all of it.
        self.lit = self._stacked(_lit(number, self.shape) for number in solver.found) > 0.0
        self.pivots = np.where(self.lit, self._stacked(solver.pivots), 1.0)
        self.fades = self._picked(reduce(np.logical_and, solver.fading(), np.True_)) > 0.0

    def worst(self) -> LargestGain | None:
        """Return the worst of them; None where one is no finite number."""
        if not np.all(np.isfinite(self.pivots)):
            return None
        least = self.pivots.min(axis=-1)
        closed = self.fades & (least <= 0.0)
        first = self._doubtful(least)
        if len(self.solver.unknowns) ** 2 > _MOST:
            closed = np.where(self.fades, closed, ~self._adds_up())
            left = float(least.min(initial=1.0))
            return LargestGain(bool(closed.any()), left, 2.0 / max(left, np.finfo(float).tiny))
        if not first.size:
            return _HARMLESS
        matrices = self._matrices(first)
        if not np.all(np.isfinite(matrices)):
            return None
        leaves, least, fades = 1.0 - _radius(matrices), least[first], self.fades[first]
        # Next to 1, a gain has lost the digits that the pivots still have.
        leaves = np.where(fades & (leaves < _FEW_DIGITS), np.maximum(leaves, least), leaves)
        near = np.abs(leaves) < _NEAR
        gains = np.where(near, ~self._adds_up()[first], leaves <= 0.0) & ~fades
        closed = closed[first] | gains
        leaves = np.where(gains, np.minimum(leaves, 0.0), leaves)
        worst = np.lexsort((leaves, ~closed))[0]
        return LargestGain(bool(closed[worst]), float(leaves[worst]), _condition(matrices[worst]))

    def _doubtful(self, least: Array) -> Array:
        """Return the paths that must be looked at: all that may gain, and the most closed."""
        order = np.argsort(least)
        order = order[self.fades[order] & (least[order] < _WARNED)]
        most = max(1, _MOST // len(self.solver.unknowns) ** 2)
        return np.concatenate([np.flatnonzero(~self.fades), order[:most]])

    def _matrices(self, paths: Array) -> Array:
        """Return what of each unknown comes back as which, for some paths."""
        count = len(self.solver.unknowns)
        matrices = np.zeros((len(paths), count, count))
        for place, column in enumerate(self.columns):
            for row, number in column.items():
                matrices[:, row, place] = self._picked(number)[paths]
        lit = self.lit[paths]
        return np.where(lit[:, :, np.newaxis] & lit[:, np.newaxis, :], matrices, 0.0)

    def _adds_up(self) -> Array:
        """Return where unpolarised light at every junction adds up to light that can be."""
        unpolarised = {
            junction: ((1.0,), (0.5, 0.5), (0.5, 0.5, 0.0), (0.5, 0.5, 0.0, 0.0))[count - 1]
            for junction in self.solver.loop.junctions
            if (count := self.solver.count(junction))
        }
        with np.errstate(all="ignore"):
            self.solver.lights(unpolarised)
            return self._picked(self.solver.adds_up(_ROUNDING)) > 0.0

    def _picked(self, number: Any) -> Array:
        return np.broadcast_to(np.asarray(_plain(number), float), self.shape)[self.where]

    def _stacked(self, numbers: Iterable[Any]) -> Array:
        return np.stack([self._picked(number) for number in numbers], axis=-1)


_HARMLESS = LargestGain(closed=False, leaves=1.0, condition=1.0)


def _radius(matrices: Array) -> Array:
    """Return the spectral radius of each of several matrices."""
    return np.asarray(np.abs(np.linalg.eigvals(matrices)).max(axis=-1))


def _condition(matrix: Array) -> float:
    """Return the condition number of (I - M)^-1 with respect to I and M.

    Unlike that of their difference it sees a loop whose lights all stay alike.
    """
    with np.errstate(all="ignore"):
        sums = np.linalg.pinv(np.eye(len(matrix)) - matrix, rcond=0.0)
    return float((1.0 + np.linalg.norm(matrix, 2)) * np.linalg.norm(sums, 2))


def _plain(number: Any) -> Any:
    return number.high if isinstance(number, DoubleDouble) else number


def _lit(number: Any, shape: tuple[int, ...]) -> Array:
    """Return where an unknown is not 0, for any of the paths that share a loop."""
    lit = np.asarray(np.asarray(number) != 0.0)
    while lit.ndim > len(shape):
        lit = np.asarray(lit.any(axis=0))
    own = shape[len(shape) - lit.ndim :]
    shared = tuple(axis for axis, length in enumerate(own) if length == 1)
    return np.asarray(lit.any(axis=shared, keepdims=True))
