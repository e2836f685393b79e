"""Values with an uncertainty, and the figures of light that get one from them."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from optipath.errors import AngleWarning, ParameterError
from optipath.faults import listed, unknown
from optipath.light.polarization_state import length
from optipath.light.quantities import DERIVED, QUANTITIES, Shares
from optipath.values.arrays import ComparedByFields, Unchanging, locked
from optipath.values.units import dimension_of, displayed, format_range

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.plan.plan import Plan


STOKES = 4
"""How many of the figures are the Stokes vector itself; they come first."""

FigureName: TypeAlias = Literal[
    "S0", "S1", "S2", "S3", "DoP", "DoLP", "AoP", "ellipticity", "psi", "delta",
    "dop", "dolp", "aop", "intensity",
]  # fmt: skip
_ROUNDINGS = 64.0
_NAMES = {each.variable: place for place, each in enumerate(QUANTITIES)} | {
    each.attribute: place for place, each in enumerate(QUANTITIES) if not each.attribute.isdigit()
}
_NAMES["intensity"] = 0
_PERIODS = {place: each.period for place, each in enumerate(QUANTITIES) if each.period}


def figures_of(light: Light) -> npt.NDArray[np.float64]:
    """Return all figures (..., n), in the order of `QUANTITIES`; NaN for what is not."""
    return np.stack([np.asarray(each.of(light), np.float64) for each in QUANTITIES], axis=-1)


def difference(figures: Any, others: Any) -> npt.NDArray[np.float64]:
    """Return differences of figures (..., n), of angles the shorter way round."""
    result = np.asarray(figures - others)
    for place, period in _PERIODS.items():
        result[..., place] -= period * np.round(result[..., place] / period)
    return result


def rounding_of(light: Light) -> npt.NDArray[np.float64]:
    """Return which changes of the figures are no more than rounding, shape (..., n)."""
    with np.errstate(all="ignore"):
        slopes = np.sum(np.abs(np.nan_to_num(gradients_of(light))), axis=-1)
        noise = np.asarray(light.noise, np.float64)[..., np.newaxis]
        result = noise * slopes
        of_one = noise / np.asarray(light.stokes)[..., :1]
        result[..., STOKES:] = np.fmax(result[..., STOKES:], of_one)
    return np.asarray(_ROUNDINGS * result)


def place_of(quantity: object) -> int:
    """Return the place of a quantity among the figures."""
    ParameterError.raise_for(unknown("quantity", quantity, _NAMES))
    return _NAMES[quantity]  # type: ignore[index]


def gradients_of(light: Light) -> npt.NDArray[np.float64]:
    """Return the slopes (..., n, 4) of all figures; NaN at corners, as of unpolarized DoP."""
    stokes = np.asarray(light.stokes, np.float64)
    s0 = stokes[..., 0]
    with np.errstate(all="ignore"):
        noise = np.asarray(light.noise, np.float64) / s0
        s1, s2, s3 = (stokes[..., place] / s0 for place in (1, 2, 3))
        p, q, t = (_at_least(noise, *of) for of in ((s1, s2, s3), (s1, s2), (s2, s3)))
        shares = Shares(s1, s2, s3, p, q, t, np.zeros_like(s0))
        rows = [each.gradient(shares) for each in DERIVED if each.gradient is not None]
        derived = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
        derived = derived / s0[..., np.newaxis, np.newaxis]
    own = np.broadcast_to(np.eye(STOKES), (*s0.shape, STOKES, STOKES))
    return np.concatenate([own, derived], axis=-2)


def _at_least(noise: Any, *components: Any) -> Any:
    """Return the length of a vector, NaN where it is no more than noise."""
    long = length(*components)
    return np.where(long > noise, long, np.nan)


@dataclass(frozen=True, eq=False)
class UncertainValue(Unchanging, ComparedByFields):
    """A value of a parameter, or a batch of them, with its standard uncertainty; angles in rad."""

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


@dataclass(frozen=True, eq=False)
class LightAt:
    """What gives the light at one detector, as often as it is asked."""

    plan: Plan
    detector: str
    exact: Mapping[str, Any]
    uncertain: tuple[UncertainValue, ...]

    def __call__(self, values: Mapping[str, Any]) -> Light:
        """Return the light where some values are others than the best estimates."""
        arguments = {**self.exact, **{each.name: each.value for each in self.uncertain}, **values}
        arguments = {n: v.item() if _is_one(v) else v for n, v in arguments.items()}
        with warnings.catch_warnings():
            # Whoever gave the values has been warned of them.
            warnings.simplefilter("ignore", AngleWarning)
            if len(self.plan.program.detectors) == 1:
                return self.plan.run(**arguments)
            return self.plan.run_all(**arguments)[self.detector]

    def beside(self, values: Mapping[str, Any], names: Sequence[str]) -> Light:
        """Return the light beside the best estimates; a fault says of which."""
        try:
            return self(values)
        except ParameterError as fault:
            about = f"the path with another value of {listed(list(names))}"
            raise ParameterError(*fault.faults, about=about) from None


def _is_one(value: Any) -> bool:
    return type(value) is np.ndarray and not value.ndim
