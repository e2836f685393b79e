"""The ways through an element as its class says them: what that raises, and whether they fit."""

from __future__ import annotations

from inspect import signature
from typing import TYPE_CHECKING, Any

from optipath.elements.coupling import Coupling
from optipath.errors import PathError, listed, shown
from optipath.kernels.carriers.kernel import Kernel, KernelFamily
from optipath.kernels.carriers.own_code import called
from optipath.kernels.numbers.primitives import NUMPY
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced
from optipath.values.operands import Operand, operand_of
from optipath.values.operation import Operation, ResultOf
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Iterator


def is_own(element_class: type[Any]) -> bool:
    """Tell whether a class of elements is a user's own."""
    return not element_class.__module__.startswith("optipath.")


def couplings_of(element: Any) -> tuple[Coupling, ...]:
    """Return the ways through an element."""
    what = f"couplings() of element class {type(element).__name__}"
    found: tuple[Coupling, ...] = called(what, lambda: tuple(element.couplings()))
    if is_own(type(element)) and (faults := list(_faults(what, element, found))):
        raise PathError(*faults)
    return found


def _faults(what: str, element: Any, found: tuple[Any, ...]) -> Iterator[str]:
    known = list[tuple[Any, Any]]()
    for coupling in found:
        if not isinstance(coupling, Coupling):
            yield f"{what} gives {shown(coupling)}; return a tuple of op.Coupling"
            continue
        enters, leaves = way = (coupling.enters, coupling.leaves)
        if enters is not None and enters not in element.inputs:
            yield f"{what} lead from {shown(enters)}; {_ports('inputs', element.inputs, enters)}"
        if leaves not in element.outputs:
            yield f"{what} lead to {shown(leaves)}; {_ports('outputs', element.outputs, leaves)}"
        if way in known:
            yield (
                f"{what} lead from {shown(enters)} to {shown(leaves)} more than once; give one "
                f"op.Coupling for each way"
            )
        known.append(way)
        operations = coupling.operations
        if not isinstance(operations, (tuple, list)) or not all(
            isinstance(operation, Operation) for operation in operations
        ):
            yield (
                f"{what} give the operations {shown(operations)}; give a tuple of op.Operation: "
                f"those of another element are element.couplings()[0].operations"
            )
            continue
        names = {parameter.name for parameter in element.parameters()}
        for operation in operations:
            yield from _operation_faults(what, operation, names)


def _operation_faults(what: str, operation: Operation, names: set[str]) -> Iterator[str]:
    """Say whether an operation has a kernel, and values that this takes."""
    kernel, values = operation.kernel, operation.arguments
    if not isinstance(kernel, (Kernel, KernelFamily)):
        yield (
            f"{what} give op.Operation the kernel {shown(kernel)}; give an "
            f"optipath.kernels.carriers.kernel.Kernel: that of another element is "
            f"element.couplings()[0].operations[0].kernel"
        )
        return
    to = f"{what} give kernel '{kernel.name}'"
    if not isinstance(values, (tuple, list)):
        yield f"{to} the values {shown(values)}; give a tuple"
        return
    inner = {id(value.operation): value.operation for value in values if type(value) is ResultOf}
    for behind in inner.values():
        yield from _operation_faults(what, behind, names)
    yield from (f"{to} {fault}" for value in values if (fault := _value_fault(value, names)))
    takes = signature(kernel.by_method("stable").made_for(NUMPY))
    try:
        takes.bind(*values)
    except TypeError:
        yield f"{to} the values {shown(values)}; give as many as it takes, {takes}"


def _value_fault(value: Any, names: set[str]) -> str:
    """Say what is wrong with a value for a kernel, given the parameters of the element."""
    operand = operand_of(value)
    if not operand.known and operand.value.name not in names:
        return f"parameter '{operand.value.name}', which is in no field; give it to one as well"
    if isinstance(value, (float, Parameter, Operand, ResultOf)) or is_traced(value):
        return ""
    if as_given("a value for a kernel", value, PathError).dtype.kind in "biufc":
        return ""
    return f"{shown(value)}, which is no number; give a number or a parameter"


def _ports(which: str, ports: tuple[str, ...], port: Any) -> str:
    """Say which ports there are, and how another comes to be one."""
    there = f"are {listed([shown(each) for each in ports])}" if ports else "are none"
    return (
        f"its {which} {there}: name one of these in op.Coupling, or say {which} = "
        f"({shown(port)}, ...) in the class (mueller_rows lead from 'in' to 'out')"
    )
