"""Couplings: the ways of light through an element; values as kernels get them; known kinds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import PathError
from optipath.kernels.catalog import TURN, TURN_BACK
from optipath.kernels.primitives import NUMPY
from optipath.light.decompositions import stacked
from optipath.materials.material import Material
from optipath.values.arrays import read_only, same_fields
from optipath.values.operands import Operand, Operation, operand_of
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.domains import Domain


@dataclass(eq=False, slots=True)  # Not frozen, which takes thrice the time to make.
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

    def matrix(
        self, method: str, read: Callable[[Operand], Any] = Operand.numbers
    ) -> np.ndarray[Any, Any]:
        """Return the Mueller matrix; what is so faint that floats lose its digits is 0.

        Parameters
        ----------
        method : str
            How Fresnel's equations are computed.
        read : callable, optional
            Returns the numbers of an `Operand`; by default those that are known.

        Returns
        -------
        ndarray, shape (..., 4, 4)
        """
        matrix = np.eye(4)
        for operation in self.operations:
            kernel = operation.kernel.by_method(method)
            numbers = operation.numbers(NUMPY, lambda value: read(operand_of(value)), method)
            if kernel.structure is None:
                raise PathError(f"kernel '{kernel.name}' has no structure, and so no matrix")
            matrix = stacked(kernel.structure.rows(NUMPY, numbers)) @ matrix
        faint = np.abs(matrix[..., :1, :1]) < np.finfo(np.float64).tiny
        return np.where(faint, 0.0, matrix)


def turned(angle: Any, *operations: Operation) -> tuple[Operation, ...]:
    """Return operations turned by an angle in rad, right-handed from x."""
    if isinstance(angle, (int, float)) and angle == 0.0:
        return operations
    return (Operation(TURN, (angle,)), *operations, Operation(TURN_BACK, (angle,)))


def numbers_of(value: Any, domain: Domain) -> tuple[Any, ...]:
    """Return a value as real numbers: (n, k) of a complex one, 4 of a vector, 16 of a matrix."""
    if domain.tail:
        count = int(np.prod(domain.tail))
        return tuple(Operand(value, position, domain.tail) for position in range(count))
    if isinstance(value, Material):
        return value.n, value.k
    if not domain.complex_parts:
        return (value,)
    if type(value) is float:
        return value, 0.0
    if type(value) is complex:
        return value.real, value.imag
    if isinstance(value, (int, float, complex, np.ndarray)):
        return read_only(np.real(value)), read_only(np.imag(value))
    return Operand(value, "real"), Operand(value, "imag")


KINDS: dict[str, type[Any]] = {}
"""The class of each kind that has been imported so far."""


def register(kind: str, element_class: type[Any]) -> None:
    """Enter a class under its kind; defining the same class again replaces it."""
    known = KINDS.get(kind)
    if known is not None and _identity(known) != _identity(element_class):
        raise PathError(
            f"element kind '{kind}' is taken by {'.'.join(_identity(known))}; choose another"
        )
    KINDS[kind] = element_class


def _identity(element_class: type[Any]) -> tuple[str, str]:
    return element_class.__module__, element_class.__qualname__


def bound_value(parameter: Parameter) -> Any:
    """Return the value of a parameter that is bound; a multiple with its factor and offset."""
    return parameter.placed(parameter.resolve(parameter.default).value)


def value_back(owner: str, name: str, value: Any) -> Any:
    """Return a value that is another on the way back, by no change of sign; it must be known."""
    if not isinstance(value, Parameter):
        return value
    if not value.bound:
        raise PathError(
            f"{owner}.{name} is parameter '{value.name}', whose value is another on the way back; "
            f"give a value, or bind it first, path.bind({value.name}=...)"
        )
    return bound_value(value)


def vanishes(value: Any) -> bool:
    """Tell whether a value is known to be 0."""
    if type(value) is float:
        return value == 0.0
    operand = Operand(value) if isinstance(value, Parameter) else value
    if isinstance(operand, Operand):
        return operand.known and not operand.traced and not np.any(operand.numbers())
    return isinstance(value, (int, float, np.ndarray)) and not np.any(value)


def largest(value: Any) -> float:
    """Return the size of a known value, or the most of an open one; infinite without a range."""
    if isinstance(value, Parameter):
        if not value.bound:
            return value.span_of((value.minimum, value.maximum))[1]
        value = bound_value(value)
    if type(value) is float:
        return abs(value)
    known = np.asarray(value) if isinstance(value, (int, float, np.ndarray)) else np.array(None)
    return float(np.max(np.abs(known), initial=0.0)) if known.dtype.kind in "iuf" else math.inf
