"""What pictures show, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from optipath.errors import SurfaceError, unknown

if TYPE_CHECKING:
    from collections.abc import Sequence


class Named(Protocol):
    """A quantity."""

    @property
    def variable(self) -> str:
        """What it is called."""


Quantity = TypeVar("Quantity", bound=Named)


def named_quantity(name: Any, quantities: Sequence[Quantity]) -> Quantity:
    """Return the quantity of a name.

    Examples
    --------
    >>> from optipath.plots.hemispheres.pixel_quantity import QUANTITIES
    >>> named_quantity("AoP", QUANTITIES).label
    'angle of polarisation (°)'
    """
    names = [each.variable for each in quantities]
    if faults := unknown("quantity", name, names):
        raise SurfaceError(*faults)
    return quantities[names.index(name)]
