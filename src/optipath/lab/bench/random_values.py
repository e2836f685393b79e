"""Random values for a path, so that it can be timed as a batch of many."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError

if TYPE_CHECKING:
    from optipath.plan.plan import Plan


def random_values(plan: Plan, count: int, seed: int = 1) -> dict[str, Any]:
    """Return arrays for the parameters of a plan that are open.

    Angles are drawn from their range, at most a whole turn; where there are none, the
    other numbers within 10 % of their defaults. What is optional stays as it is by default.

    Shape: returns (count,).

    Examples
    --------
    >>> import optipath as op
    >>> values = random_values(op.load_preset("npgr026").compose(), 5)
    >>> sorted(values), values["phi"].shape
    (['delta', 'phi', 'rho'], (5,))
    """
    draw = np.random.default_rng(seed).uniform
    angles, others = {}, {}
    for name, parameter in plan.inputs.open.items():
        low, high = plan.inputs.limits[name]
        default = parameter.default
        if parameter.optional or plan.inputs.tails[name]:
            continue
        if plan.inputs.dimensions[name] == "angle":
            angles[name] = draw(max(low, -np.pi), min(high, np.pi), count)
        elif isinstance(default, (int, float)):
            others[name] = np.clip(default * draw(0.9, 1.1, count), low, high)
    if not angles and not others:
        raise ParameterError(
            "the path has no open parameter that can be varied; leave an angle open to time it"
        )
    return angles or others
