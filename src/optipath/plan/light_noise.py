"""The noise of a plan's light, found when somebody asks what light is like that is nearly dark."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.jax_values import is_traced

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.roundings import Array

_SAME = 1e-3
"""How far light may be from what it is when it is computed again."""


def noise_at(
    answers: Any,
    end: str,
    parameters: Mapping[str, Any],
    where: Any,
    stokes: Array,
    exponent: Array,
) -> Array:
    """Return what is noise in light, wherever a component of it is small enough for that.

    Shapes: stokes (..., 4); exponent (...); returns (...).
    """
    found = np.zeros(exponent.shape, stokes.dtype)
    interpreter = answers.noise
    readings = interpreter.program.readings
    if end not in readings or any(map(is_traced, parameters.values())):
        return found
    most = interpreter.most_of_one(parameters)
    if most is not None and not _as_little(stokes, exponent, most).any():
        return found
    given = answers.whole.reader.read(parameters)
    given = given.part(where) if where else given
    doubtful = _as_little(stokes, exponent, interpreter.most(given)).any(axis=-1)
    if not doubtful.any():
        return found
    part = given.part((doubtful,)) if given.batch else given
    again, noise = interpreter.noise(part, readings[end], exponent[doubtful].reshape(part.batch))
    intensity = stokes[doubtful][..., 0].reshape(part.batch)
    with np.errstate(over="ignore", invalid="ignore"):
        same = np.abs(again - intensity) <= 4.0 * noise + _SAME * np.abs(intensity)
    found[doubtful] = np.where(same, noise, 0.0)
    return found


def matrix_noise_at(
    answers: Any, source: str, end: str, parameters: Mapping[str, Any], matrix: Array
) -> Array:
    """Return the noise in the matrix of a path: that in what a source's light becomes, as a share.

    Shapes: matrix (..., 4, 4); returns (...).
    """
    interpreter = answers.noise
    traced = is_traced(matrix) or any(map(is_traced, parameters.values()))
    if traced or len(interpreter.program.sources) > 1:
        return np.zeros(matrix.shape[:-2])
    emitted = interpreter.emitted(answers.whole.reader.read(parameters), source)
    stokes = (np.asarray(matrix) @ emitted[..., np.newaxis])[..., 0]
    exponent = np.zeros(stokes.shape[:-1], dtype=np.int64)
    noise = noise_at(answers, end, parameters, (), stokes, exponent)
    lit = emitted[..., 0] > 0.0
    return np.where(lit, noise / np.where(lit, emitted[..., 0], 1.0), 0.0)


def _as_little(stokes: Array, exponent: Array, most: Any) -> Array:
    """Return which components, other than 0, are no larger than noise can be at most."""
    with np.errstate(over="ignore"):
        least = np.ldexp(most, -exponent)
    sizes = np.abs(stokes)
    return (sizes > 0.0) & (sizes <= least[..., np.newaxis])  # type: ignore[no-any-return]
