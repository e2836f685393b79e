"""Polarization state: degrees and angles of Stokes vectors, and which are physical.

Read off the vector over S0, at any faintness. Undefined or noise is NaN: DoP of dark light, ellipse
of unpolarized light, axis of circular light. Slopes of JAX are 0 there.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.faults import shown
from optipath.kernels.carriers.structures import turn_linear
from optipath.values.arrays import first_place
from optipath.values.domains import can_be_light
from optipath.values.jax_values import is_traced, namespace
from optipath.values.precision import coarser, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.precision import Array


def ratio(part: Any, whole: Any) -> Any:
    """Return a part over the whole: 0 where that is 0, and NaN where it is infinite."""
    xp, dark = namespace(whole), whole == 0.0
    # What is not physical may run over, into infinity.
    with np.errstate(over="ignore", invalid="ignore"):
        known = part / xp.where(dark, 1.0, xp.where(xp.isinf(whole), np.nan, whole))
    return xp.where(dark, 0.0, known)


def length(*components: Any) -> Any:
    """Return the length of a vector from its components, however small; at 0 its slope is 0."""
    return reduce(_hypotenuse, components)


@np.errstate(over="ignore")
def _hypotenuse(a: Any, b: Any) -> Any:
    xp = namespace(a)
    there = (a != 0.0) | (b != 0.0)
    return xp.where(there, xp.hypot(xp.where(there, a, 1.0), xp.where(there, b, 0.0)), 0.0)


def norm(vector: Array) -> Array:
    """Return the length along the last axis, however small; at 0 its slope is 0."""
    return length(*(vector[..., i] for i in range(vector.shape[-1])))  # type: ignore[no-any-return]


def direction(y: Any, x: Any) -> Any:
    """Return the angle in rad from x to y in (-pi, pi], whatever signs zeros have; 0 of 0, 0."""
    xp = namespace(y)
    there = (x != 0.0) | (y != 0.0)
    angle = xp.arctan2(xp.where(there, y, 0.0), xp.where(there, x, 1.0))
    return xp.where(angle <= -np.pi, -angle, angle)


def shares(stokes: Array) -> Array:
    """Return the Stokes vector (..., 4) over S0; 0 where that is 0."""
    return ratio(stokes, stokes[..., :1])  # type: ignore[no-any-return]


def polarised(stokes: Array) -> tuple[Array, Array, Array]:
    """Return S1, S2 and S3 of (..., 4) over S0."""
    stokes = shares(stokes)
    return stokes[..., 1], stokes[..., 2], stokes[..., 3]


def ellipse_of(numbers: Array, floor: Array) -> tuple[Array, Array, Array]:
    """Return (s1, s2, s3) over S0, 0 where they are no more than noise, which has no sign."""
    if is_traced(numbers):  # A slope is there also at 0.
        return polarised(numbers)
    seen = np.where(np.abs(numbers) < floor[..., np.newaxis], 0.0, shares(numbers))
    return seen[..., 1], seen[..., 2], seen[..., 3]


def minor_over_major(s1: Array, s2: Array, s3: Array) -> Array:
    """Return the minor over the major axis, S3 / (p + hypot(S1, S2)); 0 of no ellipse."""
    xp, linear = namespace(s1), length(s1, s2)
    # What is not physical may be infinite, and then is NaN here.
    with np.errstate(over="ignore", invalid="ignore"):
        axes = length(linear, s3) + linear
        return s3 / xp.where(axes == 0.0, 1.0, axes)  # type: ignore[no-any-return]


def where_there(value: Any, stokes: Array, floor: Array, *components: int) -> Array:
    """Return a value, NaN where light is dark, or some components are noise."""
    there = stokes[..., 0] > floor
    if components:
        there = there & (length(*(stokes[..., i] for i in components)) > floor)
    result = namespace(stokes).where(there, value, np.nan)
    return namespace(result).asarray(result)  # type: ignore[no-any-return]


def turned_stokes(stokes: Array, turn: Any) -> Array:
    """Return Stokes vectors (..., 4) in a frame that is turned."""
    xp, (s0, s1, s2, s3) = namespace(stokes), (stokes[..., i] for i in range(4))
    with np.errstate(over="ignore", invalid="ignore"):
        parts = (s0, *turn_linear(turn, s1, s2), s3)
    turned = xp.stack(xp.broadcast_arrays(*parts), axis=-1)
    return turned.astype(coarser(turned, stokes), copy=False)  # type: ignore[no-any-return]


_CURE = (
    "give S0 >= 0 and S1^2 + S2^2 + S3^2 <= S0^2; or, for measured noise, "
    "Light(..., physical=False), of which nearest_physical() makes light"
)


def check_physical(stokes: Array) -> None:
    """Refuse Stokes vectors (..., 4) that no light has; NaN is what nobody has read."""
    endless = np.asarray(np.isinf(stokes).any(axis=-1))
    message = np.where(np.isnan(stokes) | endless[..., np.newaxis], 0.0, stokes)
    beyond = ~(can_be_light(message, rounding_of(stokes)) | np.isnan(stokes[..., 0]))
    bad = endless | (message[..., 0] < 0.0) | beyond
    if not bad.any():
        return
    vector, which = stokes[bad][0], f"light{first_place(bad)}"
    raise ValueFault(f"{which} is {shown(vector.tolist())}, {problem_of(vector)}; {_CURE}")


def problem_of(vector: Array) -> str:
    """Say why a Stokes vector is no light."""
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
    """Return physical Stokes vectors (..., 4): S0 is kept, S1, S2, S3 are scaled together."""
    xp = namespace(stokes)
    s0, rest = xp.maximum(stokes[..., :1], 0.0), stokes[..., 1:]
    read = xp.where(xp.isnan(rest), 0.0, rest)
    polarised = length(*(read[..., i] for i in range(3)))[..., np.newaxis]
    beyond = polarised > s0
    share = xp.where(beyond, s0 / xp.where(beyond, polarised, 1.0), 1.0)
    return xp.concatenate([s0, rest * share], axis=-1)


UNDERFLOW = 2.0**60
"""How many times the smallest normal number light must be, lest what underflows is seen in it."""


@np.errstate(under="ignore", over="ignore")
def unscaled(stokes: Array, exponent: Any) -> Array:
    """Return vectors (..., 4) times two to a power; 0 where none is a normal number any more."""
    result = np.asarray(np.ldexp(stokes, np.asarray(exponent)[..., np.newaxis]))
    # Components that are not read are NaN, as is light that cannot be, which is not dark.
    result[np.fmax.reduce(np.abs(result), axis=-1) < np.finfo(result.dtype).tiny] = 0.0
    return result


def underflows(intensity: Array) -> npt.NDArray[np.bool_]:
    """Tell where light is so weak that what underflows on the way may be seen in it."""
    return np.asarray(intensity < np.finfo(intensity.dtype).tiny * UNDERFLOW)
