"""MuellerElement: an element given by its Mueller matrix."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self, TypeAlias

import numpy as np

from optipath.elements.coupling import Coupling, numbers_of, value_back
from optipath.elements.element import Element, with_values
from optipath.errors import ValueFault
from optipath.faults import Cure, Fault
from optipath.kernels.catalog import MATRIX
from optipath.light.decompositions import reciprocal, tolerance_for, tolerance_of
from optipath.light.passive import are_passive, cure_of, problem_of
from optipath.materials.quantities import Angle, Quantity, YesOrNo
from optipath.values.domains import PhysicalDomain
from optipath.values.operands import Operation

if TYPE_CHECKING:
    import numpy.typing as npt


class MuellerElement(Element, kind="mueller"):
    """An element whose Mueller matrix is known, measured perhaps.

    Parameters
    ----------
    matrix : array_like, shape (..., 4, 4), or Parameter
        Acts on Stokes vectors in the element's frame.
    azimuth : float, array_like or Parameter, optional
        The turn of its frame against the frame of the port before it.
    physical : bool, optional
        Whether a matrix is refused that no passive element can have, beyond the rounding of its
        numbers: one that could polarise light by more than 100 % (Cloude's criterion), or let
        out more than comes in. False for what has been measured with noise, which
        `Mueller.nearest_physical` mends, and for amplifiers.
    straight : bool, optional
        Whether light keeps its direction. False for what it leaves another way, as a mirror or a
        sample that scatters light: the frames before and behind are two then, each with the
        direction of its light for z.

    Examples
    --------
    >>> MuellerElement(matrix=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]).azimuth
    0.0
    """

    mirrored: ClassVar[tuple[str, ...]] = ()

    matrix: ElementMatrix
    azimuth: Angle = 0.0
    physical: YesOrNo = True  # type: ignore[misc] # each element says it for itself
    straight: YesOrNo = True  # type: ignore[misc] # ditto

    def couplings(self) -> tuple[Coupling, ...]:
        """Return the matrix as it is given."""
        numbers = numbers_of(self.matrix, self.domains()["matrix"])
        return (Coupling("in", "out", (Operation(MATRIX, numbers),)),)

    def reversed(self) -> Self:
        """Return the element with Q M^T Q, Q = diag(1, 1, -1, 1), for its matrix.

        Raises
        ------
        PathError
            If the matrix is an open parameter, or the element has an azimuth.
        """
        matrix = value_back(self.kind, "matrix", self.matrix)
        return with_values(super().reversed(), matrix=reciprocal(matrix))


@dataclass(frozen=True)
class MatrixDomain(PhysicalDomain):
    """Mueller matrices of passive elements, beyond the rounding of their precision; or any."""

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
            place, wanted = [*np.argwhere(bad)[0].tolist()], cure_of(array, tolerance)
            cure = Cure.of(
                lambda free: f"give {wanted}, or {free} for measured matrices and for amplifiers",
                "physical=False",
                "physical = false",
            )
            problem = problem_of(array[bad][0], tolerance)
            raise ValueFault(Fault(f"{owner}{place or ''} {problem}", cure))


ElementMatrix: TypeAlias = Annotated[Quantity, MatrixDomain("Mueller matrix", tail=(4, 4))]
