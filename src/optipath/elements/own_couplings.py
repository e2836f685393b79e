"""The ways through an element as its class says them: what that raises, and whether they fit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.elements.coupling import Coupling, Operation
from optipath.errors import PathError, listed, shown
from optipath.kernels.carriers.own_code import called

if TYPE_CHECKING:
    from collections.abc import Iterator


def is_own(element_class: type[Any]) -> bool:
    """Tell whether a class of elements is a user's own."""
    return not element_class.__module__.startswith("optipath.")


def couplings_of(element: Any) -> tuple[Coupling, ...]:
    """Return the ways through an element.

    Raises
    ------
    PathError
        If the class does not say them, its code raises anything, or they do not fit its ports;
        naming the class.
    """
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


def _ports(which: str, ports: tuple[str, ...], port: Any) -> str:
    """Say which ports there are, and how another comes to be one."""
    there = f"are {listed([shown(each) for each in ports])}" if ports else "are none"
    return (
        f"its {which} {there}: name one of these in op.Coupling, or say {which} = "
        f"({shown(port)}, ...) in the class (mueller_rows lead from 'in' to 'out')"
    )
