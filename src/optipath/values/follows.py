"""FOLLOWS: what a boundary takes over from the one before it."""

from __future__ import annotations

from typing import Any, NoReturn

from optipath.errors import ParameterError


class Follows:
    """What stands for a value of the boundary before; `FOLLOWS` is the only one.

    Examples
    --------
    >>> FOLLOWS
    FOLLOWS
    """

    __slots__ = ()

    # NumPy's numbers leave arithmetic to it.
    __array_ufunc__ = None

    word = "follows"
    """How files write it."""

    in_file = f'"{word}"'
    """The same with its quotes."""

    def __repr__(self) -> str:
        return "FOLLOWS"

    def __reduce__(self) -> str:
        # Copies are the same one.
        return "FOLLOWS"


def _refused(*_: Any) -> NoReturn:
    raise ParameterError(
        "FOLLOWS stands for what the boundary before has, just as it is, and has no arithmetic; "
        "give the number, or the Parameter that the boundary before has, which has it"
    )


_REFUSED = "add radd sub rsub mul rmul truediv rtruediv pow rpow matmul rmatmul neg pos abs"
for _name in _REFUSED.split():
    setattr(Follows, f"__{_name}__", _refused)

FOLLOWS = Follows()
"""In place of ``outside``: the medium that light comes from. In place of ``incidence``: that of
the boundary before, refracted by Snell's law. Files write ``"follows"``.
"""
