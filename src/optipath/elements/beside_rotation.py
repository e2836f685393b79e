"""The domain of a retardance beside a rotation: the two do not commute, so it is 0."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.domains import Domain
from optipath.errors import ValueFault
from optipath.jax_values import is_traced

if TYPE_CHECKING:
    from optipath.parameters import Parameter


class BesideRotation(Domain):
    """A retardance where there is a rotation: none."""

    def described(self) -> str:
        """Say in words which values are allowed."""
        return (
            "0 beside a rotation, with which it does not commute, or put two Media one after "
            "the other"
        )

    def check(self, owner: str, value: Any) -> Any:
        """Return the value as an array of numbers, or say what is wrong with it.

        Raises
        ------
        ValueFault
            If it is not known to be 0.
        """
        if is_traced(value):
            raise ValueFault(f"{owner} is traced by JAX; give {self.described()}")
        return super().check(owner, value)

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        """Refuse a parameter whose value is not known yet.

        Raises
        ------
        ValueFault
            Naming the parameter.
        """
        if not parameter.bound:
            raise ValueFault(f"{owner} is parameter '{parameter.name}'; give {self.described()}")


BESIDE_ROTATION = BesideRotation("retardance", "angle per length", minimum=0.0, maximum=0.0)
