"""Published Stokes vectors, each for the light that it stands beside."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, shown, unknown
from optipath.values.arrays.array_likes import array_of

if TYPE_CHECKING:
    import numpy.typing as npt


def published_for(
    published: Any, light: Any, several: Mapping[str, Any]
) -> dict[str, npt.NDArray[np.float64]]:
    """Return published Stokes vectors by the names of the lights that they stand beside.

    Shapes: published (..., 4); returns (4,).

    Examples
    --------
    >>> import optipath as op
    >>> light = op.Light([1.0, 0.5, 0.0, 0.0])
    >>> published_for([1.0, 0.49, 0.0, 0.0], light, {"eye": light})
    {'eye': array([1.  , 0.49, 0.  , 0.  ])}
    """
    if published is None:
        return {}
    if not isinstance(published, Mapping):
        if isinstance(light, Mapping):
            raise OptipathError(
                f"published is {shown(published)}, and lights have names; give a mapping by them"
            )
        rows = _numbers("published", published, (*light.shape, 4)).reshape(-1, 4)
        return dict(zip(several, rows, strict=True))
    faults = [fault for name in published for fault in unknown("published", name, several)]
    if faults:
        raise OptipathError(*faults)
    return {
        name: _numbers(f"published {shown(name)}", each, (4,)) for name, each in published.items()
    }


def _numbers(what: str, given: Any, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    numbers = array_of(what, given, OptipathError)
    if numbers.shape != shape or numbers.dtype.kind not in "iuf":
        raise OptipathError(
            f"{what} is {shown(given)}; give S0, S1, S2 and S3, numbers of shape {shape}"
        )
    if np.isinf(numbers).any():
        raise OptipathError(
            f"{what} is {shown(given)}, which is not finite; write NaN for what is missing"
        )
    return numbers.astype(float)
