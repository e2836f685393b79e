"""Sensor: a hemisphere of directions as an image of pixels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.faults import unknown
from optipath.values.precision import Numbers, whole_number

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


Places = npt.NDArray[np.int64]

_BORDER = 1e-6
"""How far from the border of a pixel, in pixels, directions still are on it."""


ProjectionName: TypeAlias = Literal["equidistant", "equal-area"]


@dataclass(frozen=True)
class Sensor:
    """A hemisphere of directions, laid out flat as a square image, which its disc just fits.

    Seen from above the sample, x goes to the right and y upwards: light that goes on as it came is
    on the right. The lower hemisphere is seen from above as well, through the sample. Pixel [i, j]
    is the one at x = (2 j + 1) / pixels - 1, y = (2 i + 1) / pixels - 1.

    Parameters
    ----------
    pixels : int, optional
        How many there are along each side.
    projection : {"equidistant", "equal-area"}, optional
        The polar angle is proportional to the distance from the centre, or all pixels are of one
        solid angle.
    parts : int, optional
        Into how many parts of light a measurement is split, from whose spread all standard errors
        are found; memory grows with them.

    Examples
    --------
    >>> sensor = Sensor(64)
    >>> print(sensor.place([0.0, 0.0, 1.0]), sensor.theta[32, 63].round(4))
    2080 1.5464
    >>> print((sensor.solid_angle.sum() / (2.0 * np.pi)).round(12))
    1.0
    """

    pixels: int = 128
    projection: ProjectionName = "equidistant"
    parts: int = 16

    def __post_init__(self) -> None:
        """Refuse all faults."""
        faults = whole_number("pixels", self.pixels) + whole_number("parts", self.parts, 2)
        faults += unknown("projection", self.projection, PROJECTIONS)
        SurfaceError.raise_for(faults)
        vars(self).update(pixels=int(self.pixels), parts=int(self.parts))

    @classmethod
    def of(cls, given: Any) -> Self:
        """Return a sensor, given as it is, by its pixels, or by its projection."""
        if isinstance(given, cls):
            return given
        return cls(**{"projection" if isinstance(given, str) else "pixels": given})

    @cached_property
    def coordinates(self) -> Numbers:
        """Where the centres of columns are, and of rows, from -1 to 1."""
        return (2.0 * np.arange(self.pixels) + 1.0) / self.pixels - 1.0

    @cached_property
    def theta(self) -> Numbers:
        """The angle of each centre to the normal, in radians; NaN beyond the horizon."""
        radius = np.hypot(self.coordinates, self.coordinates[:, np.newaxis])
        there = radius <= 1.0
        angle = PROJECTIONS[self.projection].angle(np.where(there, radius, 0.0))
        return np.where(there, angle, np.nan)

    @cached_property
    def phi(self) -> Numbers:
        """The azimuth of each centre from x towards y, in radians; NaN beyond the horizon."""
        angle = np.arctan2(self.coordinates[:, np.newaxis], self.coordinates)
        return np.where(np.isnan(self.theta), np.nan, angle)

    @cached_property
    def directions(self) -> Numbers:
        """The direction of each centre, upwards, of shape (pixels, pixels, 3)."""
        theta, phi = self.theta, self.phi
        level = np.sin(theta)
        return np.stack([level * np.cos(phi), level * np.sin(phi), np.cos(theta)], axis=-1)

    @cached_property
    def solid_angle(self) -> Numbers:
        """The solid angle of each pixel within the hemisphere, in sr; 2 pi in all."""
        return pixel_areas(self.pixels, PROJECTIONS[self.projection].cap)

    @property
    def width_at_normal(self) -> float:
        """The angle that pixels next to the normal are wide, in radians.

        Those of an equidistant sensor are as long everywhere, along theta.
        """
        (density,) = PROJECTIONS[self.projection].density(np.zeros(1))
        return float(2.0 / self.pixels * np.sqrt(density))

    def place(self, directions: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Return the number of the pixel in which each direction is, rows one after the other.

        Directions are unit vectors (..., 3), upwards or downwards.
        """
        last = self.pixels - 1
        column, row = (np.clip(each.astype(np.int64), 0, last) for each in self.at(directions))
        return np.asarray(row * self.pixels + column)

    def around(self, direction: npt.ArrayLike) -> tuple[Places, Places]:
        """Return the pixel in which a direction is, or all those on whose border it is.

        The rows and columns of one pixel, of two or of four: where there is an even number along
        each side, all directions in the plane of incidence are on the border of two.

        >>> print(*Sensor(64).around([0.6, 0.0, 0.8]), *Sensor(65).around([0.6, 0.0, 0.8]))
        [31 32] [45 45] [32] [45]
        """
        last = self.pixels - 1
        columns, rows = (
            np.unique(np.clip(np.floor([each - _BORDER, each + _BORDER]).astype(int), 0, last))
            for each in self.at(direction)
        )
        return np.repeat(rows, len(columns)), np.tile(columns, len(rows))

    def radius(self, directions: npt.ArrayLike) -> Numbers:
        """Return how far directions are from the normal on the image, of which the rim is 1."""
        x, y, z = np.moveaxis(np.asarray(directions, float), -1, 0)
        return PROJECTIONS[self.projection].radius(np.hypot(x, y), np.abs(z))

    def at(self, directions: npt.ArrayLike) -> tuple[Numbers, Numbers]:
        """Return where directions are, in columns and in rows from the corner."""
        x, y, _ = np.moveaxis(np.asarray(directions, float), -1, 0)
        sin = np.hypot(x, y)
        scale, half = self.radius(directions) / np.where(sin > 0.0, sin, 1.0), 0.5 * self.pixels
        return (scale * x + 1.0) * half, (scale * y + 1.0) * half


class Projection(NamedTuple):
    """A projection of directions, each at its azimuth."""

    radius: Callable[[Numbers, Numbers], Numbers]
    angle: Callable[[Numbers], Numbers]
    cap: Callable[[Numbers], Numbers]
    density: Callable[[Numbers], Numbers]


PROJECTIONS = {
    "equidistant": Projection(
        radius=lambda sin, cos: np.arctan2(sin, cos) / (np.pi / 2.0),
        angle=lambda r: np.asarray(r * (np.pi / 2.0)),
        cap=lambda r: np.asarray(2.0 * (np.pi / 4.0 * np.sinc(r / 4.0)) ** 2),
        density=lambda r: np.asarray((np.pi / 2.0) ** 2 * np.sinc(r / 2.0)),
    ),
    "equal-area": Projection(
        radius=lambda sin, cos: np.asarray(sin / np.sqrt(1.0 + cos)),
        angle=lambda r: 2.0 * np.arcsin(r / np.sqrt(2.0)),
        cap=np.ones_like,
        density=lambda r: np.full_like(r, 2.0),
    ),
}
"""The polar angle is proportional to the distance from the centre; or all areas are kept."""


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


def pixel_areas(pixels: int, cap: Callable[[Numbers], Numbers]) -> Numbers:
    """Return the solid angles (pixels, pixels) of a square that just holds the hemisphere's disc.

    By Green's theorem, the integral of (1 - cos theta) / r^2 (x dy - y dx) along the sides of the
    pixel within the disc, and its rim.
    """
    lines = np.linspace(-1.0, 1.0, pixels + 1)
    half_chord = np.sqrt(np.maximum(1.0 - lines**2, 0.0))[:, np.newaxis]
    begin, end = (np.clip(each, -half_chord, half_chord) for each in (lines[:-1], lines[1:]))
    along = np.zeros_like(begin)
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        at = 0.5 * (begin + end) + 0.5 * (end - begin) * node
        along += weight * cap(np.hypot(at, lines[:, np.newaxis]))
    sides = 0.5 * (end - begin) * along * lines[:, np.newaxis]
    within = np.diff(sides, axis=0)
    return within + within.T + _rim(lines)


def _rim(lines: Numbers) -> Numbers:
    """Return the angle under which the part of the rim in each pixel is seen from the centre."""
    pixels = len(lines) - 1
    meets = np.arccos(lines)
    all_meets = np.concatenate([meets, -meets, np.pi / 2.0 - meets, np.pi / 2.0 + meets])
    angles = np.unique(np.concatenate([[0.0, 2.0 * np.pi], all_meets % (2.0 * np.pi)]))
    middle = 0.5 * (angles[1:] + angles[:-1])
    column, row = (
        np.clip(((each + 1.0) * (0.5 * pixels)).astype(int), 0, pixels - 1)
        for each in (np.cos(middle), np.sin(middle))
    )
    result = np.zeros((pixels, pixels))
    np.add.at(result, (row, column), np.diff(angles))
    return result


def pixel_points(sensor: Sensor, points: int) -> Iterator[tuple[Numbers, Numbers]]:
    """Yield points^2 directions (pixels, pixels, 3), solid angles (pixels, pixels) in each pixel.

    By Gauss-Legendre quadrature along y, and along the part of x within the hemisphere.
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
