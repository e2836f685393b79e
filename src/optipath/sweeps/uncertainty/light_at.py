"""The light of a path at values of what is uncertain, all else as it is."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import AngleWarning, ParameterError, listed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.light.light import Light
    from optipath.plan.plan import Plan
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue


@dataclass(frozen=True, eq=False)
class LightAt:
    """What gives the light at one detector, as often as it is asked."""

    plan: Plan
    detector: str
    exact: Mapping[str, Any]
    uncertain: tuple[UncertainValue, ...]

    def __call__(self, values: Mapping[str, Any]) -> Light:
        """Return the light where some values are others than the best estimates."""
        given = {**self.exact, **{each.name: each.value for each in self.uncertain}, **values}
        given = {n: v.item() if _is_one(v) else v for n, v in given.items()}
        with warnings.catch_warnings():
            # Whoever gave the values has been warned of them.
            warnings.simplefilter("ignore", AngleWarning)
            if len(self.plan.program.detectors) == 1:
                return self.plan.run(**given)
            return self.plan.run_all(**given)[self.detector]

    def beside(self, values: Mapping[str, Any], names: Sequence[str]) -> Light:
        """Return the light beside the best estimates; a fault says of which."""
        try:
            return self(values)
        except ParameterError as fault:
            about = f"the path with another value of {listed(list(names))}"
            raise ParameterError(*fault.faults, about=about) from None


def _is_one(value: Any) -> bool:
    return type(value) is np.ndarray and not value.ndim
