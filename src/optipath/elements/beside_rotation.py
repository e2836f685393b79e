"""What may be nothing but 0 beside another: the same rotation by another sign."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault
from optipath.values.arrays.jax_values import is_traced
from optipath.values.domains.domain import Domain

if TYPE_CHECKING:
    from optipath.values.parameters import Parameter


@dataclass(frozen=True)
class Beside(Domain):
    """A quantity that may be nothing but 0 beside another."""

    why: str = ""

    def described(self) -> str:
        """Say in words which values are allowed."""
        return f"0 beside {self.why}"

    def check(self, owner: str, value: Any) -> Any:
        if is_traced(value):
            raise ValueFault(f"{owner} is traced by JAX; give {self.described()}")
        return super().check(owner, value)

    def check_parameter(self, owner: str, parameter: Parameter) -> None:
        if not parameter.bound:
            raise ValueFault(f"{owner} is parameter '{parameter.name}'; give {self.described()}")


def _beside(name: str, why: str) -> Beside:
    return Beside(name, "angle per length", minimum=0.0, maximum=0.0, why=why)


ROTATION_BESIDE_DEXTROROTATION = _beside(
    "rotation", "a dextrorotation, which is the same rotation with the other sign"
)
