"""The slopes of the Stokes vector, by what there is to find them."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from optipath.engines.automatic import is_installed
from optipath.errors import ParameterError, shown
from optipath.extras import need
from optipath.plan.running.counts import operations
from optipath.sweeps.uncertainty.slopes_by_differences import slopes_by_differences

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from optipath.plan.plan import Plan
    from optipath.sweeps.uncertainty.light_at import LightAt

_STEPS, _OPERATIONS = 100, 1_000
"""Beyond these JAX takes seconds, or minutes, for slopes that differences have at once."""


class StokesSlopes(NamedTuple):
    """Slopes, and how they were found.

    Shape: slopes (..., 4, k).
    """

    slopes: npt.NDArray[np.float64]
    method: str
    rounding: float


def slopes_of(light_at: LightAt, method: str) -> StokesSlopes:
    """Return the slopes of the Stokes vector."""
    if method == "gradients":
        return _gradients(light_at)
    why = ""
    if method == "auto" and is_installed("jax"):
        why = _why_not(light_at.plan)
        if not why:
            try:
                return _gradients(light_at)
            except ParameterError:
                why = ", since JAX does not trace this path"
    return StokesSlopes(slopes_by_differences(light_at), f"differences{why}", 1e-8)


def _gradients(light_at: LightAt) -> StokesSlopes:
    need("gradients", "jax")
    by_jax = import_module("optipath.sweeps.uncertainty.slopes_by_jax").slopes_by_jax
    try:
        return StokesSlopes(by_jax(light_at), "gradients by JAX", 1e-12)
    except Exception as fault:  # noqa: BLE001 - an element of one's own may raise anything
        raise ParameterError(
            f"JAX does not trace this path, which raises {shown(fault)}; write method='differences'"
        ) from None


def _why_not(plan: Plan) -> str:
    """Return why JAX is not asked, though it is there; nothing if it is."""
    if len(plan.program.steps) > _STEPS:
        return f", since JAX takes long for {len(plan.program.steps):,} steps"
    counted = operations(plan.answers.light, unreduced=plan.reduction.unreduced)
    if counted is not None and counted["all"] > _OPERATIONS:
        return f", since JAX takes long for {counted['all']:,} operations"
    return ""
