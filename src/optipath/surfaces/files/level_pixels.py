"""LevelPixels: the BRDF that a hemisphere has measured, between its pixels too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from optipath.light.frames import Frame
from optipath.light.mueller.matrix import Mueller
from optipath.surfaces.facets.directions import frame_along
from optipath.surfaces.hemispheres.projections import PROJECTIONS

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere
    from optipath.surfaces.hemispheres.sensor import Sensor

Numbers = npt.NDArray[np.float64]

_PARTS = 8
"""Into how many parts the sides of pixels are split, over which frames are averaged."""

_ALL_LOST = 1e-6
"""Where as little is left of what is polarised, nothing is to be had of it."""

_RIM = 1.0 - 1e-9
"""How far from the centre parts of pixels are taken to be: light along the horizon has no frame."""

_UP = np.array([0.0, 0.0, 1.0])
_ACROSS = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True)
class LevelPixels:
    """The Mueller matrices of the BRDF in frames that change smoothly from pixel to pixel.

    Those of pixels turn about the normal; x of a level frame is (0, 1, 0), carried from the normal
    to the direction by the least turn.

    Shapes: there (rows, columns); matrices (rows, columns, wavelengths, 4, 4); errors (rows,
    columns, wavelengths).
    """

    sensor: Sensor
    there: Numbers
    matrices: Numbers
    errors: Numbers

    @classmethod
    def of(cls, hemisphere: Hemisphere) -> LevelPixels:
        """Return those of the light that a sample reflects."""
        brdf, sensor = hemisphere.brdf(), hemisphere.sensor
        there = ~np.isnan(sensor.theta)
        seen = there[..., np.newaxis]
        found = np.where(seen[..., np.newaxis, np.newaxis], brdf.to_numpy()[0], 0.0)
        errors = np.where(seen, brdf.se.to_numpy()[0, ..., 0, 0], 0.0)
        found[..., 1:3, :] = _unturned(sensor, there) @ found[..., 1:3, :]
        if sensor.pixels % 2 and sensor.pixels > 1:
            # Of light about the normal all that is linear is lost; its neighbours have it.
            middle = sensor.pixels // 2
            beside = [(middle - 1, middle), (middle + 1, middle)]
            beside += [(middle, middle - 1), (middle, middle + 1)]
            found[middle, middle] = np.mean([found[place] for place in beside], axis=0)
        return cls(sensor, there.astype(float), found, errors)

    def at(self, directions: Numbers) -> tuple[Numbers, Numbers]:
        """Return what there is in directions, in their level frames, from the nearest four pixels.

        Shapes: directions (n, 3); returns matrices (n, wavelengths, 4, 4), errors (n, wavelengths).
        """
        pixels = self.sensor.pixels
        across, up = (each - 0.5 for each in self.sensor.at(directions))
        found = np.zeros((len(directions), *self.matrices.shape[2:]))
        errors, total = np.zeros(found.shape[:2]), np.zeros(len(directions))
        for row in (np.floor(up), np.floor(up) + 1.0):
            for column in (np.floor(across), np.floor(across) + 1.0):
                i, j = (np.clip(each, 0, pixels - 1).astype(int) for each in (row, column))
                share = (1.0 - np.abs(up - row)) * (1.0 - np.abs(across - column))
                share *= self.there[i, j]
                found += share[:, None, None, None] * self.matrices[i, j]
                errors += share[:, None] * self.errors[i, j]
                total += share
        total = np.where(total > 0.0, total, 1.0)[:, None]
        return found / total[..., None, None], errors / total


def level_frame(z: Numbers) -> Frame:
    """Return the frames of light along directions above the horizon that are level.

    Shape: z (..., 3).

    Examples
    --------
    >>> print(level_frame(np.array([[0.0, 0.0, 1.0], [0.0, 0.6, 0.8]])).x)
    [[ 0.   1.   0. ]
     [ 0.   0.8 -0.6]]
    """
    x = _ACROSS - z[..., 1:2] / (1.0 + z[..., 2:]) * (z + _UP)
    return Frame.trusted(x, np.cross(z, x), z.copy())


def in_frames(matrix: Mueller, before: Frame, behind: Frame) -> Numbers:
    """Return the numbers of Mueller matrices in other frames of the same directions.

    Shapes: matrix (...); returns (..., 4, 4).
    """
    as_it_is = np.eye(4)
    turned = Mueller.of(as_it_is, behind, behind) @ matrix @ Mueller.of(as_it_is, before, before)
    return np.asarray(turned.matrix)


def _unturned(sensor: Sensor, there: npt.NDArray[np.bool_]) -> Numbers:
    """Return by what S1 and S2 of the light of pixels come to be in level frames.

    The inverse of the mean turn from the level frame to the frame of the light over each pixel:
    next to the normal the latter turns a lot within one, and light that is alike all over it has
    lost much of its polarisation in the sum.

    Shape: returns (rows, columns, 1, 2, 2).
    """
    part = ((np.arange(_PARTS) + 0.5) / _PARTS - 0.5) * 2.0 / sensor.pixels
    c, s = np.ones(there.shape), np.zeros(there.shape)
    x, y = (
        each[..., np.newaxis, np.newaxis]
        for each in np.meshgrid(sensor.coordinates, sensor.coordinates)
    )
    x, y = x[there] + part, y[there] + part[:, np.newaxis]
    angle = PROJECTIONS[sensor.projection].angle(np.minimum(np.hypot(x, y), _RIM))
    azimuth = np.arctan2(y, x)
    level = np.sin(angle)
    z = np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.cos(angle)], axis=-1)
    turns = level_frame(z).turn_to(frame_along("the pixel", z, up=True))
    c[there], s[there] = (each.mean(axis=(-2, -1)) for each in turns)
    rows = np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], -2)
    left = c * c + s * s
    return (rows / np.where(left > _ALL_LOST, left, 1.0)[..., None, None])[:, :, None]


def each_wavelength(frame: Frame) -> Frame:
    """Return frames of shape (n, 1) for matrices of (n, wavelengths).

    Examples
    --------
    >>> each_wavelength(level_frame(np.array([[0.0, 0.0, 1.0]]))).z.shape
    (1, 1, 3)
    """
    return Frame.trusted(frame.x[:, None], frame.y[:, None], frame.z[:, None], frame.rounding)
