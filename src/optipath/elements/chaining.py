"""Chaining: ``a >> b`` of elements, out of which paths, which stand above, make a path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import PathError, shown

if TYPE_CHECKING:
    from collections.abc import Callable

_BEGINNINGS: list[Callable[[Any], Any]] = []


def chains_begin_with(beginning: Callable[[Any], Any]) -> None:
    """Enter what makes the path of one element, which a chain goes on from."""
    _BEGINNINGS[:] = [beginning]


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
    if not _BEGINNINGS:
        raise PathError(
            "a chain becomes a PathGraph, which nothing has asked for yet; import it first: "
            "from optipath import PathGraph"
        )
    return _BEGINNINGS[0](first)


@dataclass(frozen=True)
class NamedElement(Chainable):
    """An element and what it is called in a chain."""

    name: str
    element: Any
