"""What the rates of a medium must not be together: amplifying, or too much at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.kernels.filters.lorentz_depolarizing import LARGEST, LARGEST_DICHROISM
from optipath.values.agreement import Agreement, text_of

if TYPE_CHECKING:
    from collections.abc import Collection

_ROUNDING = 1e-6
"""By what share dichroism may exceed the absorption, values being rounded; nothing amplifies."""


@dataclass(frozen=True, eq=False)
class PassiveDichroism(Agreement):
    """What absorbs one state of light more than the mean absorbs another less, but not below 0.

    The operands are the absorption, the linear dichroism and the circular one, per metre.
    """

    owner: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        absorption, linear, circular = numbers
        return ~(xp.hypot(linear, circular) > absorption * (1.0 + _ROUNDING))

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        del varying  # The cure is said of each path.
        absorption, linear, circular = (
            text_of(operand, number / 100.0, " 1/cm")
            for operand, number in zip(self.operands, numbers, strict=True)
        )
        least = float(abs(complex(*numbers[1:]))) / 100.0
        return (
            f"'{self.owner}' would amplify some light: its dichroism is {linear} and its "
            f"circular_dichroism {circular}, but its absorption, the mean of all states, "
            f"{absorption}; give an absorption of {least:.10g} 1/cm or more"
        )


@dataclass(frozen=True, eq=False)
class WithinReach(Agreement):
    """Dichroism and depolarisation at once are computed up to a limit.

    The operands are the linear and the circular dichroism, the retardance, the rotation and the
    depolarization, per metre, and the length.
    """

    owner: str

    def fits(self, xp: Any, *numbers: Any) -> Any:
        dichroism, whole = _products(xp, *numbers)
        return ~((dichroism > LARGEST_DICHROISM) | (whole > LARGEST))

    def sentence(self, *numbers: float, varying: Collection[int] = ()) -> str:
        import numpy as np  # noqa: PLC0415

        del varying
        dichroism, whole = _products(np, *numbers)
        return (
            f"over the length of '{self.owner}', {text_of(self.operands[-1], numbers[-1], ' m')}, "
            f"its dichroism comes to {dichroism:.3g}, and with its retardance, rotation and "
            f"depolarization to {whole:.3g}; beside a depolarization, {LARGEST_DICHROISM:g} and "
            f"{LARGEST:g} are the most: put several Media of a part of the length one after the "
            f"other"
        )


def _products(xp: Any, *numbers: Any) -> tuple[Any, Any]:
    """Return what dichroism comes to over a length, and all together."""
    linear, circular, retardance, rotation, depolarization, length = numbers
    dichroism = xp.hypot(linear, circular) * length
    turning = xp.hypot(retardance, 2.0 * rotation) * length
    return dichroism, dichroism + turning + depolarization * length
