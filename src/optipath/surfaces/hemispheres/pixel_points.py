"""Points within the pixels of a sensor, by which what is known of directions is averaged."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from optipath.surfaces.hemispheres.projections import PROJECTIONS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.surfaces.hemispheres.sensor import Sensor

Numbers = npt.NDArray[np.float64]


def pixel_points(sensor: Sensor, points: int) -> Iterator[tuple[Numbers, Numbers]]:
    """Yield points^2 directions within each pixel, and the solid angles that they stand for.

    By the rule of Gauss and Legendre along y, and along what of x is within the hemisphere.

    Shapes: returns directions (pixels, pixels, 3), solid_angles (pixels, pixels).

    Examples
    --------
    >>> from optipath.surfaces.hemispheres.sensor import Sensor
    >>> sensor = Sensor(16, "equal-area")
    >>> found = sum(area for _, area in pixel_points(sensor, 4))
    >>> print(abs(found - sensor.solid_angle)[4:12, 4:12].max() < 1e-15)
    True
    """
    projection, half = PROJECTIONS[sensor.projection], 1.0 / sensor.pixels
    nodes, weights = np.polynomial.legendre.leggauss(points)
    middle = sensor.coordinates
    for node_y, weight_y in zip(nodes, weights, strict=True):
        y = (middle + half * node_y)[:, np.newaxis]
        chord = np.sqrt(1.0 - y * y)
        begin, end = (np.clip(middle + side, -chord, chord) for side in (-half, half))
        for node_x, weight_x in zip(nodes, weights, strict=True):
            x = 0.5 * (begin + end) + 0.5 * (end - begin) * node_x
            radius = np.hypot(x, y)
            area = 0.5 * (end - begin) * half * weight_x * weight_y * projection.density(radius)
            theta = np.where(area > 0.0, projection.angle(np.minimum(radius, 1.0)), 0.0)
            level = np.sin(theta) / np.where(radius > 0.0, radius, 1.0)
            yield np.stack([level * x, level * y, np.cos(theta)], axis=-1), area
