"""The domain of a Mueller matrix that stands for an element."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import numpy as np

from optipath.errors import ValueFault
from optipath.light.mueller.cloude import tolerance_for, tolerance_of
from optipath.light.mueller.passive_matrices import are_passive, cure_of, problem_of
from optipath.values.arrays.read_only import read_only
from optipath.values.cures import cure
from optipath.values.domains.domain import Domain
from optipath.values.domains.quantities import Quantity

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True)
class MatrixDomain(Domain):
    """Mueller matrices of passive elements, beyond the rounding of their precision; or any."""

    physical: bool = True

    @property
    def unphysical(self) -> Domain:
        """The domain of matrices as they are measured, and of amplifiers."""
        return replace(self, physical=False)

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change, in the precision by which it is judged."""
        return read_only(value, widened=False)

    def allows(self, numbers: Any) -> Any:
        finite = super().allows(numbers).all(axis=(-1, -2))
        spare = tolerance_for(numbers)
        return finite & are_passive(numbers, spare) if self.physical else finite

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        super()._check_numbers(owner, array, rounding)
        if not self.physical:
            return
        tolerance = tolerance_of(rounding)
        bad = ~are_passive(array, tolerance)
        if np.any(bad):
            place = [*np.argwhere(bad)[0].tolist()]
            free = cure("physical=False", "physical = false")
            raise ValueFault(
                f"{owner}{place or ''} {problem_of(array[bad][0], tolerance)}; give "
                f"{cure_of(array, tolerance)}, or {free} for what is measured as it is, "
                f"and for amplifiers"
            )


ElementMatrix: TypeAlias = Annotated[Quantity, MatrixDomain("Mueller matrix", tail=(4, 4))]
