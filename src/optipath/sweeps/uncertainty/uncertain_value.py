"""A value with its standard uncertainty."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from optipath.values.arrays.read_only import Unchanging, locked, same_fields
from optipath.values.displayed import displayed, format_range
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class UncertainValue(Unchanging):
    """A value of a parameter, or a batch of them, with its standard uncertainty.

    Units: value, sigma in radians.

    Examples
    --------
    >>> UncertainValue("k", np.array(0.1), np.array(0.2), 0.0, np.inf, "").leaves_its_range
    True
    """

    name: str
    value: npt.NDArray[np.float64]
    sigma: npt.NDArray[np.float64]
    low: float
    high: float
    unit: str

    def __post_init__(self) -> None:
        """Keep copies, which nobody can change."""
        for name in ("value", "sigma"):
            object.__setattr__(self, name, locked(np.array(getattr(self, name))))

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]

    def allows(self, numbers: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
        """Return which numbers are within the range."""
        return (numbers >= self.low) & (numbers <= self.high)

    @property
    def leaves_its_range(self) -> bool:
        """Whether a value of the range is less than a standard uncertainty from its ends."""
        ends = self.value - self.sigma, self.value + self.sigma
        return not all(bool(np.all(self.allows(end))) for end in ends)

    @property
    def scale(self) -> npt.NDArray[np.float64]:
        """What a change of the value is small against, of its shape."""
        size = np.abs(self.value)
        if dimension_of(self.unit) in ("", "angle"):
            return np.maximum(size, 1.0)
        return np.where(size > 0.0, size, np.where(self.sigma > 0.0, self.sigma, 1.0))

    @property
    def range_text(self) -> str:
        """The range in words."""
        return format_range(self.low, self.high, self.unit)

    def __str__(self) -> str:
        value, sigma = self.value, self.sigma
        if value.size != 1:
            return f"{self.name}, shape {value.shape}"
        number, spread = (displayed(float(n.item()), self.unit) for n in (value, sigma))
        return f"{self.name} = {number} +- {spread}"
