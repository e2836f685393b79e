"""FOLLOWS: what a boundary takes over from the one before it."""

from __future__ import annotations


class Follows:
    """What stands for a value of the boundary before; `FOLLOWS` is the only one.

    Examples
    --------
    >>> FOLLOWS
    FOLLOWS
    """

    __slots__ = ()

    word = "follows"
    """How files write it."""

    in_file = f'"{word}"'
    """The same with its quotes."""

    def __repr__(self) -> str:
        return "FOLLOWS"

    def __reduce__(self) -> str:
        # Copies are the same one.
        return "FOLLOWS"


FOLLOWS = Follows()
"""In place of ``outside``: the medium that light comes from. In place of ``incidence``: that of
the boundary before, refracted by Snell's law. Files write ``"follows"``.
"""
