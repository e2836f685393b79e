"""Loops of light that hardly leaves: solved in twice the precision, and refused where light gains.

Where little light leaves a loop, 1 - gain loses digits, so elements of a loop are evaluated and
summed in twice the precision, by the same kernels.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.program import LoopSolver, evaluated
from optipath.errors import LoopWarning, ParameterError
from optipath.kernels.carriers.carrier import StokesCarrier
from optipath.kernels.carriers.structures import ROTATION
from optipath.kernels.double_double import DoubleDouble, twice
from optipath.kernels.primitives import NUMPY
from optipath.values.angles import warn
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from optipath.engines.program import Loop, Program
    from optipath.kernels.carriers.structures import Numbers
    from optipath.plan.reading import Batch
    from optipath.values.precision import Array


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

    Without amplifiers, some light stays where a pivot is 0. Else the spectral radius of the round
    trip tells; next to 1, whether unpolarized light given to every junction adds up to physical
    light, which it does just where the radius is below 1 (Krein & Rutman, Uspekhi Mat. Nauk 3,
    1948).
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
            warn(
                f"of the light that goes round at '{place}', all but {worst.leaves:.2g} comes back "
                f"each time; the condition number of the sum is {worst.condition:.2g}, by which "
                f"errors of the values that are given may be enlarged",
                LoopWarning,
            )
    ParameterError.raise_for(faults)


class _Judged:
    """The doubtful paths of a batch, by what the unknowns of a loop are to each other."""

    def __init__(self, solver: LoopSolver) -> None:
        self.solver = solver
        self.columns = [solver.scattered(column.back) for column in solver.columns]
        numbers = [*solver.pivots, *(n for column in self.columns for n in column.values())]
        self.shape = np.broadcast_shapes((1,), *(np.shape(_high(number)) for number in numbers))
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
        return np.broadcast_to(np.asarray(_high(number), float), self.shape)[self.where]

    def _stacked(self, numbers: Iterable[Any]) -> Array:
        return np.stack([self._picked(number) for number in numbers], axis=-1)


_HARMLESS = LargestGain(closed=False, leaves=1.0, condition=1.0)


def _radius(matrices: Array) -> Array:
    """Return the spectral radius of each of several matrices."""
    return np.asarray(np.abs(np.linalg.eigvals(matrices)).max(axis=-1))


def _condition(matrix: Array) -> float:
    """Return the condition number of (I - M)^-1 with respect to I and M, not to I - M."""
    with np.errstate(all="ignore"):
        sums = np.linalg.pinv(np.eye(len(matrix)) - matrix, rcond=0.0)
    return float((1.0 + np.linalg.norm(matrix, 2)) * np.linalg.norm(sums, 2))


def _high(number: Any) -> Any:
    return number.high if isinstance(number, DoubleDouble) else number


def _lit(number: Any, shape: tuple[int, ...]) -> Array:
    """Return where an unknown is not 0, for any of the paths that share a loop."""
    lit = np.asarray(np.asarray(number) != 0.0)
    while lit.ndim > len(shape):
        lit = np.asarray(lit.any(axis=0))
    own = shape[len(shape) - lit.ndim :]
    shared = tuple(axis for axis, length in enumerate(own) if length == 1)
    return np.asarray(lit.any(axis=shared, keepdims=True))


_TWICE = twice(NUMPY)


@dataclass(eq=False, repr=False)
class CloserLook:
    """Solves the loops of a program for what is given."""

    program: Program
    given: Batch
    plain: list[Array]
    dtype: np.dtype[Any]
    _operands: dict[int, Any] = field(default_factory=dict)
    _numbers: dict[int, Numbers] = field(default_factory=dict)

    def meet(self, loop: Loop) -> LoopSolver:
        """Return the lights at the junctions of a loop."""
        return LoopSolver(self.program, loop, self.numbers, _TWICE, _longer, self._rounded)

    def evaluations(self) -> dict[int, tuple[Array, ...]]:
        """Return what every evaluation comes to, rounded, as `execute` may be given it.

        Reflection, entry and return at a boundary then share each digit of its angle.
        """
        used = (index for index, uses in enumerate(self.program.evaluation_uses) if uses)
        return {index: tuple(map(self._rounded, self.numbers(index))) for index in used}

    def numbers(self, index: int) -> Numbers:
        """Return what an evaluation comes to."""
        if index not in self._numbers:
            self._numbers[index] = self._evaluated(index)
        return self._numbers[index]

    def _evaluated(self, index: int) -> Numbers:
        evaluation = self.program.evaluations[index]
        operands = list(self.plain)
        for place in self.program.passed_to[index]:
            operands[place] = self._operand(place)
        try:
            numbers = evaluated(self.program, index, operands, StokesCarrier(_TWICE), _longer)
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            numbers = evaluated(self.program, index, self.plain, StokesCarrier(NUMPY), _longer)
        if evaluation.kernel.structure is ROTATION:
            # A cosine and a sine that are rounded belong to no angle; their ratio does.
            numbers = _of_an_angle(*numbers)
        return numbers

    def _operand(self, place: int) -> Any:
        if place not in self._operands:
            operand, kind = self.program.operands[place], wide(self.dtype)
            if operand.known:
                raw = _longer(self.given.cut(np.asarray(operand.raw(), kind)))
            else:
                raw = operand.number_in(self.given.numbers, lambda n: _longer(np.asarray(n, kind)))
            raw = _of_an_angle(*raw) if isinstance(raw, tuple) else raw
            self._operands[place] = operand.evaluated(_TWICE, raw)
        return self._operands[place]

    def _rounded(self, number: Any) -> Any:
        return np.asarray(_high(number), self.dtype)


def _longer(number: Any) -> DoubleDouble:
    if isinstance(number, DoubleDouble):
        return number
    array = np.asarray(number)
    # Not a plain 0: the rest has the precision of the number.
    kind = np.result_type(array, np.float64)
    array = array.astype(kind, copy=False)
    return DoubleDouble(NUMPY, array, 0.0 * array)


def _of_an_angle(c: DoubleDouble, s: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    length = (c * c + s * s).sqrt()
    return c / length, s / length
