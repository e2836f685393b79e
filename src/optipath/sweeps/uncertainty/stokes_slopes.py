"""The slopes of the Stokes vector, by what there is to find them."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from optipath.engines.automatic import is_installed
from optipath.errors import MissingExtraError, ParameterError, shown
from optipath.sweeps.uncertainty.slopes_by_differences import slopes_by_differences

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from optipath.sweeps.uncertainty.light_at import LightAt


class StokesSlopes(NamedTuple):
    """Slopes, and how they were found.

    Attributes
    ----------
    slopes : ndarray, shape (..., 4, k)
        Along each value that is uncertain.
    method : str
        In words.
    rounding : float
        What is less than this share of the terms that it is the sum of, is 0.
    """

    slopes: npt.NDArray[np.float64]
    method: str
    rounding: float


def slopes_of(light_at: LightAt, method: str) -> StokesSlopes:
    """Return the slopes of the Stokes vector.

    Parameters
    ----------
    light_at : LightAt
        What gives the light.
    method : {"auto", "gradients", "differences"}
        By JAX if it is there and traces the path, by JAX, or by differences.

    Returns
    -------
    StokesSlopes

    Raises
    ------
    MissingExtraError
        If gradients are asked for, and JAX is not there.
    ParameterError
        If they are, and JAX does not trace the path.
    """
    why = ""
    if method == "gradients" and not is_installed("jax"):
        raise MissingExtraError("gradients", "JAX", "jax")
    if method != "differences" and is_installed("jax"):
        try:
            by_jax = import_module("optipath.sweeps.uncertainty.slopes_by_jax").slopes_by_jax
            return StokesSlopes(by_jax(light_at), "gradients by JAX", 1e-12)
        except Exception as fault:  # noqa: BLE001 - an element of one's own may raise anything
            if method == "gradients":
                raise ParameterError(
                    f"JAX does not trace this path, which raises {shown(fault)}; write "
                    f"method='differences'"
                ) from None
            why = ", since JAX does not trace this path"
    return StokesSlopes(slopes_by_differences(light_at), f"differences{why}", 1e-8)
