"""An axis of a sweep: the values of one parameter, along one dimension."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.values.axis_texts import IdleValues

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from optipath.values.axis_texts import AxisValues
    from optipath.values.parameters import Parameter

_IDLE = "nothing depends on it"


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
    idle : bool
        Whether nothing depends on it, so that all is the same along it.
    """

    name: str
    dimension: str
    shown: npt.NDArray[Any]
    unit: str
    given: npt.NDArray[Any]
    help: str = ""
    idle: bool = False

    def __len__(self) -> int:
        return len(self.given)


def sweep_axis(
    known: Mapping[str, Parameter], name: str, values: AxisValues, dimension: str = ""
) -> SweepAxis:
    """Return the axis of a parameter.

    Parameters
    ----------
    known : mapping of str to Parameter
        Those on which something depends.
    name : str
        The parameter.
    values : AxisValues
        What it takes.
    dimension : str, optional
        Along which it varies; its own by default.

    Returns
    -------
    SweepAxis
    """
    idle = isinstance(values, IdleValues)
    told = _IDLE if idle else known[name].help
    return SweepAxis(name, dimension or name, *values, told, idle)
