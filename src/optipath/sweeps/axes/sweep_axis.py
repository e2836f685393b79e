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

    Shapes: shown (count,); given (count,).
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
    """Return the axis of a parameter."""
    idle = isinstance(values, IdleValues)
    told = _IDLE if idle else known[name].help
    return SweepAxis(name, dimension or name, *values, told, idle)
