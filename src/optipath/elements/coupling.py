"""Couplings: which way light goes through an element, and what happens to it there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.catalogue import TURN, TURN_BACK
from optipath.kernels.numbers.primitives import NUMPY
from optipath.light.mueller.stacking import stacked
from optipath.values.arrays.read_only import read_only, same_fields
from optipath.values.materials import Material
from optipath.values.operands import Operand, operand_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.kernels.carriers.kernel import Kernel, KernelFamily
    from optipath.kernels.numbers.primitives import Primitives
    from optipath.values.domains.domain import Domain


@dataclass(frozen=True, eq=False, slots=True)
class Operation:
    """A kernel and the values it is given.

    Attributes
    ----------
    kernel : Kernel or KernelFamily
        What is computed; of a family, the method that the composer is asked for.
    arguments : tuple
        Numbers, arrays, parameters, operands, and what other operations come to.

    Examples
    --------
    An index of refraction n = 1.5 + 0.004 / wavelength^2 (in um), as a kernel is given it:

    >>> from optipath.kernels.carriers.kernel import Kernel
    >>> from optipath.kernels.numbers.primitives import FLOAT
    >>> cauchy = Kernel("Cauchy", None, lambda xp: lambda a, b, length: (a + b / length**2, 0.0))
    >>> n, k = Operation(cauchy, (1.5, 0.004, 0.5)).results(2)
    >>> n.operation.numbers(FLOAT, float)
    (1.516, 0.0)
    """

    kernel: Kernel | KernelFamily
    arguments: tuple[Any, ...]

    def results(self, count: int) -> tuple[ResultOf, ...]:
        """Return as many numbers as it comes to, as arguments of other operations."""
        return tuple(ResultOf(self, place) for place in range(count))

    def numbers(
        self, xp: Primitives, read: Callable[[Any], Any], method: str = "stable"
    ) -> tuple[Any, ...]:
        """Return what it comes to.

        Parameters
        ----------
        xp : Primitives
            What is computed with.
        read : callable
            Gives the number of an argument that is no result of another operation.
        method : str, optional
            Of a family of kernels.

        Returns
        -------
        tuple
            The numbers of the kernel's structure.
        """
        known: dict[int, tuple[Any, ...]] = {}
        given = []
        for argument in self.arguments:
            if isinstance(argument, ResultOf):
                inner = argument.operation
                if id(inner) not in known:
                    known[id(inner)] = inner.numbers(xp, read, method)
                given.append(known[id(inner)][argument.place])
            else:
                given.append(read(argument))
        return self.kernel.by_method(method).made_for(xp)(*given)

    def operands(self) -> Iterator[Operand]:
        """Yield the operands that it is given, and those behind the results that it is given."""
        inner = {id(a.operation): a.operation for a in self.arguments if isinstance(a, ResultOf)}
        for operation in inner.values():
            yield from operation.operands()
        yield from (operand_of(a) for a in self.arguments if not isinstance(a, ResultOf))

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True, slots=True)
class ResultOf:
    """One of the numbers that an operation comes to."""

    operation: Operation
    place: int

    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True, eq=False, slots=True)
class Coupling:
    """One way through an element: from an in-port to an out-port, in order of travel.

    Attributes
    ----------
    enters : str or None
        The in-port; None where light begins (a source).
    leaves : str
        The out-port.
    operations : tuple of Operation
        What is done to light, in order.
    reflects : bool
        Whether it is a bounce, and no passage.
    """

    enters: str | None
    leaves: str
    operations: tuple[Operation, ...]
    reflects: bool = False

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]

    def matrix(self, method: str) -> np.ndarray[Any, Any]:
        """Return the Mueller matrix of shape (..., 4, 4); every value must be a number.

        What is so faint that floats lose its digits is 0, as what is fainter still.
        """
        matrix = np.eye(4)
        for operation in self.operations:
            kernel = operation.kernel.by_method(method)
            numbers = operation.numbers(NUMPY, lambda value: operand_of(value).numbers({}), method)
            assert kernel.structure is not None  # noqa: S101 - only sources have none
            matrix = stacked(kernel.structure.rows(NUMPY, numbers)) @ matrix
        faint = np.abs(matrix[..., :1, :1]) < np.finfo(np.float64).tiny
        return np.where(faint, 0.0, matrix)


def turned(angle: Any, *operations: Operation) -> tuple[Operation, ...]:
    """Return operations whose axes stand at an angle to the frame, right-handed from x.

    Units: angle in radians.

    Examples
    --------
    >>> turned(0.0, Operation(TURN, (0.3,)))[0].kernel.name
    'turn'
    >>> [operation.kernel.name for operation in turned(0.5)]
    ['turn', 'turn back']
    """
    if isinstance(angle, (int, float)) and angle == 0.0:
        return operations
    return (Operation(TURN, (angle,)), *operations, Operation(TURN_BACK, (angle,)))


def numbers_of(value: Any, domain: Domain) -> tuple[Any, ...]:
    """Return a value as the plain numbers that kernels take.

    An index of refraction is two numbers (n, k), and so is any complex number; a Stokes
    vector is four, a matrix sixteen, anything else one.

    Examples
    --------
    >>> from optipath.values.domains.indices import IndexDomain
    >>> numbers_of(1.5 + 2j, IndexDomain("index"))
    (1.5, 2.0)
    """
    if domain.tail:
        count = int(np.prod(domain.tail))
        return tuple(Operand(value, position, domain.tail) for position in range(count))
    if isinstance(value, Material):
        return value.n, value.k
    if not domain.complex_parts:
        return (value,)
    if type(value) is float:
        return value, 0.0
    if isinstance(value, (int, float, complex, np.ndarray)):
        return read_only(np.real(value)), read_only(np.imag(value))
    return Operand(value, "real"), Operand(value, "imag")
