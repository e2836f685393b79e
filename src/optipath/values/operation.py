"""Operations: kernels with the values that they are given."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.values.arrays.read_only import same_fields
from optipath.values.operands import Operand, operand_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.kernels.carriers.kernel import Kernel, KernelFamily
    from optipath.kernels.numbers.primitives import Primitives


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
