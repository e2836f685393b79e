"""MuellerElement: an element given by its Mueller matrix."""

from __future__ import annotations

from typing import ClassVar, Self

from optipath.elements.coupling import Coupling, numbers_of
from optipath.elements.element import Element, with_values
from optipath.elements.known_sizes import bound_value
from optipath.elements.matrix_domain import ElementMatrix
from optipath.errors import PathError
from optipath.kernels.catalogue import MATRIX
from optipath.light.mueller.reciprocity import reciprocal
from optipath.values.domains.quantities import Angle, YesOrNo
from optipath.values.operation import Operation
from optipath.values.parameters import Parameter


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
        matrix = self.matrix
        if isinstance(matrix, Parameter):
            if not matrix.bound:
                raise PathError(
                    f"the matrix of {self.kind} is parameter '{matrix.name}', which is transposed "
                    f"on the way back, and no parameter stands for that; give the matrix, or "
                    f"bind it first, path.bind({matrix.name}=...)"
                )
            matrix = bound_value(matrix)
        return with_values(super().reversed(), matrix=reciprocal(matrix))
