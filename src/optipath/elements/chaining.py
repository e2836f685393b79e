"""Chaining: ``a >> b`` of elements, which make a path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from optipath.errors import PathError, shown


class Chainable:
    """What may stand in a chain such as ``Source() >> Polarizer() >> Detector()``."""

    __slots__ = ()

    def __rshift__(self, behind: Any) -> Any:
        """Return the path in which light goes on from here to what stands behind."""
        return begun(self) >> behind

    def __rrshift__(self, before: object) -> Any:
        """Refuse what is not chainable."""
        return begun(before)


def begun(first: object) -> Any:
    """Return the path of one element, such as a chain begins with."""
    if isinstance(first, type) and issubclass(first, Chainable):
        raise PathError(f"{first.__name__} is a class; write {first.__name__}(...) in a chain")
    if not isinstance(first, Chainable):
        raise PathError(
            f"a chain is made of elements, such as Source() >> Polarizer() >> Detector(), "
            f"and not of {shown(first)}"
        )
    from optipath.paths.path_graph import path_of  # noqa: PLC0415 - paths stand above elements

    return path_of(first)


@dataclass(frozen=True)
class NamedElement(Chainable):
    """An element and what it is called in a chain."""

    name: str
    element: Any
