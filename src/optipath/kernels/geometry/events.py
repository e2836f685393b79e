"""What happens to light at a vertex of a chain, as kernels are given it: a number for each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Sequence


class Event:
    """The numbers by which kernels tell what happens at a vertex of each path."""

    REFLECTS: ClassVar[float] = 0.0
    REFRACTS: ClassVar[float] = 1.0
    BEHIND: ClassVar[float] = 2.0
    CANNOT: ClassVar[float] = 3.0


def ended(events: Sequence[Any]) -> list[Any]:
    """Return the condition of each vertex that its chain has ended before.

    Examples
    --------
    >>> ended([Event.REFLECTS, Event.BEHIND])
    [False, True]
    """
    return [event == Event.BEHIND for event in events]
