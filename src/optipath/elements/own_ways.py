"""The ways through elements of a user's own: whether light can go so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.own_couplings import is_own
from optipath.errors import ValueFault, listed, shown
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.mueller.cloude import tolerance_of
from optipath.light.mueller.passive_matrices import are_passive, cure_of, gain, problem_of
from optipath.light.mueller.stacking import stacked
from optipath.values.agreement import is_single
from optipath.values.domains.states import StokesDomain
from optipath.values.operands import operand_of

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable

    from optipath.elements.coupling import Coupling
    from optipath.values.operands import Operand
    from optipath.values.roundings import Array

_LONGEST = 100

_EMITTED = StokesDomain("Stokes vector", tail=(4,))

_TAKEN = "say physical: ClassVar[bool] = False in the class, to take it as it is"


def own_ways(owner: str, element: Any, couplings: Iterable[Coupling], method: str) -> list[OwnWays]:
    """Return the ways through an element that are to be looked at: those of a user's own class."""
    if not is_own(type(element)):
        return []
    ports: dict[str | None, list[Coupling]] = {}
    for coupling in couplings:
        ports.setdefault(coupling.enters, []).append(coupling)
    return [OwnWays(owner, element, tuple(each), method) for each in ports.values()]


@dataclass(frozen=True, eq=False)
class OwnWays:
    """The ways from one port through an element of a user's own, which no proof stands behind."""

    owner: str
    element: Any
    couplings: tuple[Coupling, ...]
    method: str = "stable"

    @property
    def operands(self) -> list[Operand]:
        """The numbers that they are made of, such as are given and such as are known."""
        operations = [one for coupling in self.couplings for one in coupling.operations]
        return [operand for operation in operations for operand in operation.operands()]

    @property
    def units(self) -> dict[str, str]:
        """The unit of each parameter among them that is given when a path runs."""
        open_ones = [operand.value for operand in self.operands if not operand.known]
        return {parameter.name: parameter.unit for parameter in open_ones}

    def are_known(self, given: Collection[str] = ()) -> bool:
        """Tell whether all of them are numbers already, with those of parameters that are given."""
        return all(
            not operand.traced and (operand.known or operand.value.name in given)
            for operand in self.operands
        )

    def faults(self, read: Callable[[Operand], Any]) -> list[tuple[int, str]]:
        """Return what is wrong with what they do to light: for which path, and in words."""
        rounding = self._rounding(read)
        tolerance = tolerance_of(rounding)
        matrices: list[Array] = []
        found: list[tuple[int, str]] = []
        for coupling in self.couplings:
            with np.errstate(all="ignore"):
                light = self._emitted(coupling, read)
                matrix = self._matrix(coupling, read) if light is None else None
            if light is not None:
                found += self._emission_faults(light.astype(np.float32) if rounding else light)
            if matrix is not None:
                matrices.append(matrix)
                found += self._matrix_faults(matrix.reshape(-1, 4, 4), tolerance)
        return found or self._sum_faults(matrices, tolerance)

    def _rounding(self, read: Callable[[Operand], Any]) -> float:
        """Return that of single precision where a number has been rounded so; else 0."""
        single = any(np.any(is_single(np, read(operand))) for operand in self.operands)
        return float(np.finfo(np.float32).eps) if single else 0.0

    def _emitted(self, coupling: Coupling, read: Callable[[Operand], Any]) -> Any:
        """Return the light that begins here, shape (..., 4); None where none does."""
        if coupling.enters is not None or not coupling.operations:
            return None
        numbers = self._numbers(coupling.operations[0], read)
        return np.stack(np.broadcast_arrays(*numbers), axis=-1).astype(np.float64)

    def _numbers(self, operation: Any, read: Callable[[Operand], Any]) -> tuple[Any, ...]:
        return operation.numbers(NUMPY, lambda a: read(operand_of(a)), self.method)  # type: ignore[no-any-return]

    def _matrix(self, coupling: Coupling, read: Callable[[Operand], Any]) -> Array | None:
        """Return the Mueller matrix of one way; None where it is none."""
        matrix: Any = np.eye(4)
        for operation in coupling.operations:
            structure = operation.kernel.by_method(self.method).structure
            if structure is None:
                return None
            rows = structure.rows(NUMPY, self._numbers(operation, read))
            matrix = stacked(rows) @ matrix
        return matrix  # type: ignore[no-any-return]

    def _matrix_faults(self, several: Array, tolerance: float) -> list[tuple[int, str]]:
        finite = np.isfinite(several).all(axis=(1, 2))
        if not finite.all():
            place = int(np.argmin(finite))
            text = (
                f"{self._with_matrix(several[place])}, which is not finite; keep divisors from 0 "
                f"and roots from negative numbers, as in x / xp.where(d == 0.0, 1.0, d)"
            )
            return [(place, text)]
        if self.element.physical is False or (passive := are_passive(several, tolerance)).all():
            return []
        place = int(np.argmin(passive))
        problem, cure = problem_of(several[place], tolerance), cure_of(several, tolerance)
        text = f"{self._with_matrix(several[place])}, which {problem}; mend its rows, to {cure}"
        return [(place, f"{text} perhaps, or {_TAKEN}")]

    def _sum_faults(self, matrices: list[Array], tolerance: float) -> list[tuple[int, str]]:
        """Say that several ways, of which each is one, let out more light than comes in."""
        if len(matrices) < 2 or self.element.physical is False:
            return []
        times = np.ravel(gain(sum(np.broadcast_arrays(*matrices), np.zeros((4, 4)))))
        if not np.any(times > 1.0 + tolerance):
            return []
        place = int(np.argmax(times))
        ports = listed([f"'{coupling.leaves}'" for coupling in self.couplings])
        text = (
            f"{self._named()} lets out up to {times[place]:.6g} times the light that comes in at "
            f"'{self.couplings[0].enters}', at {ports} together (M00 + |(M01, M02, M03)| of the "
            f"sum), as no passive element does; part it among them, or {_TAKEN}"
        )
        return [(place, text)]

    def _emission_faults(self, stokes: Array) -> list[tuple[int, str]]:
        if self.element.physical is False:
            return []
        bad = np.flatnonzero(~_EMITTED.allows(stokes.reshape(-1, 4)))
        for place in bad[:1]:
            try:
                _EMITTED.check(f"the light of {self._named()}", stokes.reshape(-1, 4)[place])
            except ValueFault as fault:
                return [(int(place), str(fault))]
        return []

    def _with_matrix(self, matrix: Array) -> str:
        rows = (", ".join(f"{number:.6g}" for number in row) for row in matrix)
        return f"{self._named()} has the Mueller matrix ({'), ('.join(rows)})"

    def _named(self) -> str:
        name, text = type(self.element).__name__, shown(self.element)
        values = f", {text}" if self.are_known() and len(text) <= _LONGEST else ""
        return f"'{self.owner}' (element class {name}{values})"
