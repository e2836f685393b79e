"""Values with standard uncertainties, and their correlations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import shown
from optipath.values.arrays import Unchanging, locked, same_fields
from optipath.values.units import dimension_of, displayed, format_range

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class UncertainValue(Unchanging):
    """A value of a parameter, or a batch of them, with its standard uncertainty; angles in rad.

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


_ROUNDING = 1e-12
_PAIR = 2
_EXAMPLE = '{("n1", "k1"): 0.3}'


def read_correlation(
    argument: Any, names: Sequence[str]
) -> tuple[npt.NDArray[np.float64], list[str]]:
    """Return the matrix (k, k) of correlation coefficients, and faults in it.

    >>> read_correlation({("n", "k"): 0.5}, ["n", "k"])[0]
    array([[1. , 0.5],
           [0.5, 1. ]])
    """
    matrix = np.eye(len(names))
    if argument is None:
        return matrix, []
    if not isinstance(argument, Mapping):
        return matrix, [f"correlation must be a mapping such as {_EXAMPLE}, not {shown(argument)}"]
    faults: list[str] = []
    seen: list[set[int]] = []
    for pair, coefficient in argument.items():
        is_pair = isinstance(pair, tuple) and len(pair) == _PAIR and pair[0] != pair[1]
        if not is_pair or any(name not in names for name in pair):
            faults.append(
                f"correlation is of pairs of parameters that have an uncertainty, such as "
                f"{_EXAMPLE}, not of {shown(pair)}; there are: {', '.join(names)}"
            )
            continue
        one, other = (names.index(name) for name in pair)
        is_number = isinstance(coefficient, (int, float, np.number))
        if not is_number or np.iscomplexobj(coefficient) or not -1.0 <= coefficient <= 1.0:
            faults.append(
                f"the correlation of {shown(pair)} is {shown(coefficient)}; give a number "
                f"within -1 .. 1"
            )
        elif {one, other} in seen:
            faults.append(f"the correlation of {shown(pair)} is given twice; give it once")
        else:
            seen.append({one, other})
            matrix[one, other] = matrix[other, one] = coefficient
    if not faults and len(names) and (least := np.linalg.eigvalsh(matrix)[0]) < -_ROUNDING:
        faults.append(
            f"no values can be correlated like this: the matrix of the coefficients has the "
            f"eigenvalue {least:.3g}, and none may be negative; make the coefficients smaller"
        )
    return matrix, faults


def root_of(matrix: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return a root R of a matrix of coefficients, R @ R.T, also where it is singular.

    >>> root_of(np.eye(2))
    array([[1., 0.],
           [0., 1.]])
    """
    values, vectors = np.linalg.eigh(matrix)
    return np.asarray((vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T)
