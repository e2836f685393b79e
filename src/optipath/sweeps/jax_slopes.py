"""Slopes of the Stokes vector by JAX, forward and without compiling."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np

from optipath.engines.jax_path import double_precision

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.sweeps.light_figures import LightAt


def slopes_by_jax(light_at: LightAt) -> npt.NDArray[np.float64]:
    """Return the slopes (..., 4, k) of the Stokes vector along each uncertain value, by JAX.

    Not compiled: that would take seconds a path, for slopes mostly needed once.
    """
    uncertain = light_at.uncertain

    def stokes(values: dict[str, Any]) -> Any:
        return light_at(values).stokes

    def along(tangents: dict[str, Any]) -> Any:
        return jax.jvp(stokes, (values,), (tangents,))[1]

    with double_precision()(True), jax.disable_jit():  # noqa: FBT003 - as JAX has it
        values = {each.name: jnp.asarray(each.value) for each in uncertain}
        rows = np.eye(len(uncertain))
        tangents = {
            each.name: jnp.asarray(np.multiply.outer(row, np.ones(each.value.shape)))
            for row, each in zip(rows, uncertain, strict=True)
        }
        result = np.asarray(jax.vmap(along)(tangents))
    return np.moveaxis(result, 0, -1)
