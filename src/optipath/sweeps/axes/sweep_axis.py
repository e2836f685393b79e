"""An axis of a sweep: the values of one parameter, along one dimension."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True)
class SweepAxis:
    """The values that one parameter takes in a sweep.

    Attributes
    ----------
    name : str
        The parameter.
    dimension : str
        Along which it varies: its own name, or that which it shares with others by ``zip``.
    shown : ndarray, shape (count,)
        The values as the coordinate has them: as they were given, in `unit`.
    unit : str
        That in which they were given: ``"rad"`` and ``"m"`` for plain numbers of Python, ``"deg"``
        or ``"nm"`` for texts with these; ``""`` without a dimension, and for words.
    given : ndarray, shape (count,)
        The same for `Plan.run`: radians, metres, or words.
    help : str
        What the parameter is.
    """

    name: str
    dimension: str
    shown: npt.NDArray[Any]
    unit: str
    given: npt.NDArray[Any]
    help: str = ""

    def __len__(self) -> int:
        return len(self.given)
