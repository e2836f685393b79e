"""The ways through elements of a user's own: what they raise, and whether light can go so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.coupling import Coupling
from optipath.errors import OptipathError, PathError, ValueFault, shown
from optipath.kernels.carriers.own_code import in_words
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.mueller.cloude import tolerance_of
from optipath.light.mueller.passive_matrices import are_passive, cure_of, problem_of
from optipath.light.mueller.stacking import stacked
from optipath.values.domains.states import StokesDomain
from optipath.values.operands import operand_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.operands import Operand

_LONGEST = 100

_EMITTED = StokesDomain("Stokes vector", tail=(4,))


def couplings_of(element: Any) -> tuple[Coupling, ...]:
    """Return the ways through an element.

    Raises
    ------
    PathError
        If the class does not say them, or its code raises anything; naming the class.
    """
    what = f"couplings() of element class {type(element).__name__}"
    try:
        found = tuple(element.couplings())
    except (MemoryError, OptipathError, Warning):
        raise
    except Exception as error:
        raise in_words(what, error) from error
    for coupling in found:
        if not isinstance(coupling, Coupling):
            raise PathError(f"{what} gives {shown(coupling)}; return a tuple of op.Coupling")
    return found


def is_looked_at(element: Any) -> bool:
    """Tell whether an element is of a user's own class that does not say ``physical = False``."""
    return element.physical is not False and not type(element).__module__.startswith("optipath.")


@dataclass(frozen=True, eq=False)
class OwnWay:
    """A way through an element of a user's own, which no proof stands behind.

    Attributes
    ----------
    owner : str
        The node.
    element : Element
        What stands there.
    coupling : Coupling
        The way.
    method : str
        How Fresnel's equations are computed.
    """

    owner: str
    element: Any
    coupling: Coupling
    method: str = "stable"

    @property
    def operands(self) -> list[Operand]:
        """The numbers that it is made of, such as it is given and such as are known."""
        return [one for operation in self.coupling.operations for one in operation.operands()]

    @property
    def is_known(self) -> bool:
        """Whether all of them are numbers already."""
        return all(operand.known and not operand.traced for operand in self.operands)

    def faults(self, read: Callable[[Operand], Any]) -> list[tuple[int, str]]:
        """Return what is wrong with what it does to light: for which path, and in words.

        Parameters
        ----------
        read : callable
            Gives the number of an operand.

        Returns
        -------
        list of (int, str)
            Mostly empty; else the first such path, and a sentence.
        """
        matrix: Any = np.eye(4)
        # NaN and infinity are told where the light is.
        with np.errstate(all="ignore"):
            for operation in self.coupling.operations:
                kernel = operation.kernel.by_method(self.method)
                numbers = operation.numbers(NUMPY, lambda a: read(operand_of(a)), self.method)
                if self.coupling.enters is None:
                    return self._emission_faults(numbers)
                if kernel.structure is None:
                    return []
                matrix = stacked(kernel.structure.rows(NUMPY, numbers)) @ matrix
        several = matrix.reshape(-1, 4, 4)
        several = np.where(np.isfinite(several).all(axis=(1, 2), keepdims=True), several, 0.0)
        bad = np.flatnonzero(~are_passive(several, tolerance_of(0.0)))
        if not bad.size:
            return []
        tolerance = tolerance_of(0.0)
        problem, cure = problem_of(several[bad[0]], tolerance), cure_of(several, tolerance)
        rows = (", ".join(f"{number:.6g}" for number in row) for row in several[bad[0]])
        text = (
            f"{self._named()} has the Mueller matrix ({'), ('.join(rows)}), which {problem}; "
            f"mend its rows, to {cure} perhaps, or say physical: ClassVar[bool] = False in the "
            f"class, to take it as it is"
        )
        return [(int(bad[0]), text)]

    def _emission_faults(self, numbers: Any) -> list[tuple[int, str]]:
        stokes = np.stack(np.broadcast_arrays(*numbers), axis=-1).astype(np.float64)
        bad = np.flatnonzero(~_EMITTED.allows(stokes.reshape(-1, 4)))
        for place in bad[:1]:
            try:
                _EMITTED.check(f"the light of {self._named()}", stokes.reshape(-1, 4)[place])
            except ValueFault as fault:
                return [(int(place), str(fault))]
        return []

    def _named(self) -> str:
        name, text = type(self.element).__name__, shown(self.element)
        values = f", {text}" if self.is_known and len(text) <= _LONGEST else ""
        return f"'{self.owner}' (element class {name}{values})"
