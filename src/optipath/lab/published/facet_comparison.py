"""The single-scattering model beside what photons do, in numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

Numbers = npt.NDArray[np.float64]

FARTHEST = 60.0
"""Up to how many degrees from the normal the two are compared: 30 deg from grazing."""

BLOCKS = 16
"""How many blocks of pixels there are along a side, whose light is compared."""


def model_of(hemisphere: Hemisphere) -> Numbers:
    """Return the model's Stokes vectors of unpolarised light, of shape (rows, columns, 4)."""
    found: Numbers = hemisphere.single_scattering().values[0, :, :, 0, :, 0]
    return found


def model_excess(hemisphere: Hemisphere, component: int) -> tuple[float, float]:
    """Return by how much the model is above photons, in all: its sum over theirs, less 1."""
    model = model_of(hemisphere)[..., component]
    sign, whole = np.sign(model), np.sum(np.abs(model))

    def above(light: Numbers) -> Numbers:
        return np.asarray(whole / np.sum(_stokes(hemisphere, light)[..., component] * sign) - 1.0)

    value, error = hemisphere.own.estimate(above)
    return float(value), float(error)


def model_off(hemisphere: Hemisphere) -> tuple[float, float]:
    """Return how far the model is off at most, of all components, over the largest S0."""
    model = _blocks(model_of(hemisphere))
    place = (2.0 * np.arange(len(model)) + 1.0) / len(model) - 1.0
    near = 90.0 * np.hypot(place, place[:, np.newaxis]) < FARTHEST
    value, error = hemisphere.own.estimate(
        lambda light: (_blocks(_stokes(hemisphere, light)) - model)[near] / model[..., 0].max()
    )
    at = np.unravel_index(np.argmax(np.abs(value)), value.shape)
    return float(np.abs(value[at])), float(error[at])


def _stokes(hemisphere: Hemisphere, light: Numbers) -> Numbers:
    return hemisphere.matrices(light)[0, :, :, 0, :, 0]


def _blocks(pixels: Numbers) -> Numbers:
    """Return the sums over square blocks."""
    size = max(len(pixels) // BLOCKS, 1)
    side = len(pixels) // size
    whole = pixels[: side * size, : side * size]
    return np.asarray(whole.reshape(side, size, side, size, -1).sum(axis=(1, 3)))
