"""Which Stokes vectors can be light, what is said of the others, and the light nearest to one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.light.polarization_state import length
from optipath.values.arrays.jax_values import namespace
from optipath.values.domains.states import can_be_light
from optipath.values.roundings import rounding_of

if TYPE_CHECKING:
    from optipath.values.roundings import Array

_CURE = (
    "give S0 >= 0 and S1^2 + S2^2 + S3^2 <= S0^2; or, for measured noise, "
    "Light(..., physical=False), of which nearest_physical() makes light"
)


def check_physical(stokes: Array) -> None:
    """Refuse Stokes vectors that no light has; NaN is what nobody has read.

    Shape: stokes (..., 4).

    Examples
    --------
    >>> check_physical(np.array([1.0, 0.6, 0.0, np.nan]))
    """
    endless = np.asarray(np.isinf(stokes).any(axis=-1))
    told = np.where(np.isnan(stokes) | endless[..., np.newaxis], 0.0, stokes)
    beyond = ~(can_be_light(told, rounding_of(stokes)) | np.isnan(stokes[..., 0]))
    bad = endless | (told[..., 0] < 0.0) | beyond
    if not bad.any():
        return
    place = tuple(int(i) for i in np.argwhere(bad)[0])
    which = f"light {list(place)}" if place else "light"
    more = f" (one of {bad.sum()} such)" if bad.sum() > 1 else ""
    vector = stokes[place]
    raise ValueFault(f"{which} is {shown(vector.tolist())}, {problem_of(vector)}{more}; {_CURE}")


def problem_of(vector: Array) -> str:
    """Say why a Stokes vector is no light.

    Examples
    --------
    >>> problem_of(np.array([1.0, 3.0, 0.0, 4.0]))
    'polarised by 500 %'
    """
    if np.isinf(vector).any():
        return "which is not finite"
    if vector[0] < 0.0:
        return f"whose intensity {vector[0]!s} is negative"
    if vector[0] == 0.0:
        return "which is polarised, and dark"
    share = 100.0 * float(length(*np.where(np.isnan(vector), 0.0, vector)[1:]) / vector[0])
    text = f"polarised by {share:.6g} %"
    return f"{text} and a little" if f"{share:.6g}" == "100" else text


def nearest_light(stokes: Any) -> Any:
    """Return Stokes vectors that light can have: S0 is kept, and S1, S2, S3 are scaled together.

    Shapes: stokes (..., 4); returns (..., 4).

    Examples
    --------
    >>> nearest_light(np.array([[1.0, 3.0, 0.0, 4.0], [-1.0, 0.5, 0.0, 0.0]]))
    array([[1. , 0.6, 0. , 0.8],
           [0. , 0. , 0. , 0. ]])
    """
    xp = namespace(stokes)
    s0, rest = xp.maximum(stokes[..., :1], 0.0), stokes[..., 1:]
    read = xp.where(xp.isnan(rest), 0.0, rest)
    polarised = length(*(read[..., i] for i in range(3)))[..., np.newaxis]
    beyond = polarised > s0
    share = xp.where(beyond, s0 / xp.where(beyond, polarised, 1.0), 1.0)
    return xp.concatenate([s0, rest * share], axis=-1)
