"""The domain of vertices: finite points, each apart from the next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import numpy as np

from optipath.domains import Domain, Quantity
from optipath.errors import ValueFault
from optipath.vertices.by_angles import VerticesByAngles

if TYPE_CHECKING:
    import numpy.typing as npt

_AT_ONCE = 1 << 14
"""How many chains are looked at together, so that they stay in the cache."""


@dataclass(frozen=True)
class VerticesDomain(Domain):
    """Points from the light to the eye, in the unit of any length."""

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        """Return the angles of a chain that is given by them, or the value itself."""
        if isinstance(value, VerticesByAngles):
            return list(value.parts(name))
        return super().parts(name, value)

    def described(self) -> str:
        """Say in words which values are allowed."""
        return "the points of a chain, without a unit"

    @property
    def shows_in_light(self) -> bool:
        """Two vertices in one point have no direction, and light along none is not finite."""
        return True

    def _check_numbers(self, owner: str, array: npt.NDArray[Any]) -> None:
        super()._check_numbers(owner, array)
        chains = array.reshape(-1, *self.tail)
        for start in range(0, len(chains), _AT_ONCE):
            some = chains[start : start + _AT_ONCE]
            alike = some[:, 1:] == some[:, :-1]
            meet = alike[..., 0] & alike[..., 1] & alike[..., 2]
            if meet.any():
                chain, place = (int(found[0]) for found in np.nonzero(meet))
                where = f" of chain {start + chain}" if len(chains) > 1 else ""
                raise ValueFault(
                    f"{owner}: vertices {place} and {place + 1}{where}, counted from the light as "
                    f"0, are one point, {some[chain, place].tolist()}; move one, or leave it out"
                )


VERTICES = VerticesDomain("coordinate")
Vertices: TypeAlias = Annotated[Quantity | VerticesByAngles, VERTICES]
