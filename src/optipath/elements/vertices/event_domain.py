"""The domain of events: what happens to light at each vertex of a chain, as whole numbers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import numpy as np

from optipath.errors import ValueFault
from optipath.kernels.geometry.events import Event
from optipath.values.arrays.shapes import first_place
from optipath.values.domains.domain import Domain
from optipath.values.domains.quantities import Quantity

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class EventsDomain(Domain):
    """A number of an `Event` for each vertex of a chain."""

    def described(self) -> str:
        return (
            "0 where light is reflected, 1 where it is refracted, 2 behind the end of a chain, or "
            "3 where there is no such chain"
        )

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        del parameter
        raise ValueFault(f"{owner} cannot be a parameter; give {self.described()}")

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        if np.all(_are_events(array)):
            return  # As quickly as that; the rest is for words.
        super()._check_numbers(owner, array, rounding)
        bad = array != np.rint(array)
        if np.any(bad):
            number = array[bad].ravel()[0]
            raise ValueFault(f"{owner} is {number}{first_place(bad)}; give {self.described()}")


def _are_events(array: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    events = Event.REFLECTS, Event.REFRACTS, Event.BEHIND, Event.CANNOT
    return reduce(np.logical_or, (array == event for event in events))


EVENTS = EventsDomain("event", minimum=Event.REFLECTS, maximum=Event.CANNOT)
Events: TypeAlias = Annotated[Quantity, EVENTS]
