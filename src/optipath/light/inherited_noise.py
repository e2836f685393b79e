"""Noise of light that is made of other light: what it inherits, found when it is asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.jax_values import is_traced, known, namespace
from optipath.values.precision import at_least_single

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.roundings import Array


def inheriting(
    lights: tuple[Any, ...],
    factor: Any = 1.0,
    power: Any = 0,
    *,
    mixed: bool = False,
    part: Any = None,
    added: Any = 0.0,
) -> tuple[Any, ...]:
    """Return what light keeps that is made of others, for its noise to be found by."""
    for light in lights:
        # What is inherited twice is found now, lest sums of many lights keep all of them.
        noise = vars(light).get("_noise")
        if isinstance(noise, tuple) and noise[0] is inherited_noise:
            vars(light)["_noise"] = light.noise_floor
    return inherited_noise, lights, factor, power, mixed, part, added


def inherited_noise(
    lights: tuple[Any, ...],
    factor: Any,
    power: Any,
    mixed: bool,  # noqa: FBT001 - called by what is kept of it
    part: Callable[[Any], Any] | None,
    added: Any,
    stokes: Array,
    exponent: Array,
) -> Array:
    """Return the noise in a mantissa, of shape (...).

    Shapes: stokes (..., 4); exponent (...); returns (...).
    """
    total = np.zeros(exponent.shape, stokes.dtype)
    for light in lights:
        floor, own = light.noise_floor, light.exponent
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            if mixed:
                floor = floor + rounding(known(light.mantissa))
            floor = floor * np.abs(factor) + added * np.abs(known(light.mantissa)[..., 0])
        if part is not None:
            floor, own = part(floor), part(own)
        with np.errstate(over="ignore", under="ignore"):
            total = total + np.ldexp(floor, own + power - exponent)
    return total


def noise_in(stokes: Any, noise: Any, exponent: Array) -> Any:
    """Return the noise in a mantissa: the rounding of S0 at least.

    Shapes: stokes (..., 4); exponent (...); returns (...).

    Examples
    --------
    >>> print(noise_in(np.array([1.0, 0.0, 0.0, 0.0]), np.array(1e-9), np.array(0)))
    1e-09
    """
    least = rounding(stokes)
    if noise is None or is_traced(stokes):
        return least
    if isinstance(noise, tuple):
        found, *given = noise
        noise = found(*given, stokes, exponent)
    return np.maximum(least, noise)


def rounding(stokes: Any) -> Any:
    """Return by how much sums of numbers as large as S0 are rounded, of shape (...).

    Examples
    --------
    >>> print(rounding(np.array([2.0, 0.0, 0.0, 0.0], np.float32)))
    2.3841858e-07
    """
    xp = namespace(stokes)
    with np.errstate(under="ignore", over="ignore"):
        return abs(at_least_single(stokes[..., 0])) * float(xp.finfo(stokes.dtype).eps)
