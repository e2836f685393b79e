"""Polarized BRDFs of measured hemispheres, interpolated between pixels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.faults import shown
from optipath.light.frame import Frame
from optipath.light.mueller import Mueller
from optipath.surfaces.facet_model import frame_along
from optipath.surfaces.hemisphere.hemisphere import Hemisphere
from optipath.surfaces.hemisphere.sensor import PROJECTIONS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.surfaces.hemisphere.sensor import Sensor
    from optipath.values.precision import Numbers


@dataclass(frozen=True)
class BrdfOfHemispheres:
    """What hemispheres have measured of an isotropic sample, for light from anywhere.

    Interpolated, times cos(theta_i) cos(theta_o), between incidences at equal half vectors (the
    same facet); beyond the first and the last incidence, it is that of these at the same facet.
    """

    hemispheres: tuple[Hemisphere, ...]

    @classmethod
    def of(cls, hemispheres: Sequence[Any]) -> BrdfOfHemispheres:
        """Return that of hemispheres in any order."""
        for each in hemispheres:
            if not isinstance(each, Hemisphere):
                raise SurfaceError(f"{shown(each)} is no hemisphere; give what op.measure returns")
        results = tuple(sorted(hemispheres, key=lambda each: each.seen.beam.incidence))
        angles = {each.seen.beam.incidence for each in results}
        if len(angles) < max(len(results), 2):
            raise SurfaceError(
                "hemispheres are from too few incidences, or from one of them twice; measure at "
                "several, such as every 5 deg from 0 to 85 deg"
            )
        first = results[0]
        for each in results[1:]:
            alike = np.array_equal(each.wavelengths, first.wavelengths, equal_nan=True)
            if not alike or each.seen.beam.sample != first.seen.beam.sample:
                raise SurfaceError(f"{each} is of another sample or other wavelengths than {first}")
        if not first.seen.beam.sample.isotropic:
            raise SurfaceError("the table is of isotropic samples, and this one is not")
        return cls(results)

    @property
    def wavelengths(self) -> Numbers:
        """In metres; NaN where nothing depends on them."""
        return self.hemispheres[0].wavelengths

    @cached_property
    def _pixels(self) -> list[LevelPixels]:
        return [LevelPixels.of(each) for each in self.hemispheres]

    def at(self, before: Frame, behind: Frame) -> tuple[Numbers, Numbers]:
        """Return matrices (n, wavelengths, 4, 4), errors (n, wavelengths); x is across both."""
        to_light, to_eye = -before.z, behind.z
        half = to_light + to_eye
        half = half / np.linalg.norm(half, axis=-1, keepdims=True)
        known = np.array([each.seen.beam.incidence for each in self.hemispheres])
        place = np.interp(np.arccos(to_light[:, 2]), known, np.arange(len(known)))
        matrices = np.zeros((len(half), len(self.wavelengths), 4, 4))
        errors = np.zeros(matrices.shape[:2])
        for number, pixels in enumerate(self._pixels):
            share = np.maximum(1.0 - np.abs(place - number), 0.0)
            near = share > 0.0
            result = _by_same_facet(
                pixels, known[number], to_light[near], half[near], before.x[near]
            )
            matrices[near] += share[near][:, None, None, None] * result[0]
            errors[near] += share[near][:, None] * result[1]
        over = (to_light[:, 2] * to_eye[:, 2])[:, None]
        return matrices / over[..., None, None], errors / over


def _by_same_facet(
    pixels: LevelPixels, incidence: float, to_light: Numbers, half: Numbers, across: Numbers
) -> tuple[Numbers, Numbers]:
    """Return what light of one incidence does that a facet mirrors, times both cosines."""
    azimuth = np.arctan2(to_light[:, 1], to_light[:, 0])
    c, s, zero = np.cos(azimuth), np.sin(azimuth), np.zeros_like(azimuth)
    level, up = np.sin(incidence), np.cos(incidence)
    # Of the hemisphere, where light comes from -x.
    turn = np.stack([[-c, -s, zero], [s, -c, zero], [zero, zero, zero + 1.0]])
    turn = np.moveaxis(turn, -1, 0)
    half, across = ((turn @ each[..., None])[..., 0] for each in (half, across))
    light = np.array([-level, 0.0, up])
    eye = 2.0 * (half @ light)[:, None] * half - light
    eye[:, 2] = np.maximum(eye[:, 2], LOWEST)
    eye /= np.linalg.norm(eye, axis=-1, keepdims=True)
    x = np.cross(light, eye)
    size = np.linalg.norm(x, axis=-1, keepdims=True)
    x = np.where(size > 1e-6, x / np.maximum(size, 1e-6), across)
    matrices, errors = pixels.at(eye)
    own = Frame((0.0, 1.0, 0.0), (up, 0.0, level), -light)
    result = in_frames(
        Mueller.of(matrices, own, each_wavelength(level_frame(eye))),
        each_wavelength(Frame.from_direction(np.broadcast_to(-light, x.shape), x)),
        each_wavelength(Frame.from_direction(eye, x)),
    )
    both = up * eye[:, 2][:, None]
    return result * both[..., None, None], errors * both


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

    x of a level frame is (0, 1, 0), carried from the normal to the direction by the least turn.
    Shapes: there (rows, columns); matrices (..., wavelengths, 4, 4); errors (..., wavelengths).
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
        result = np.where(seen[..., np.newaxis, np.newaxis], brdf.to_numpy()[0], 0.0)
        errors = np.where(seen, brdf.se.to_numpy()[0, ..., 0, 0], 0.0)
        result[..., 1:3, :] = _unturned(sensor, there) @ result[..., 1:3, :]
        if sensor.pixels % 2 and sensor.pixels > 1:
            # Of light about the normal all that is linear is lost; its neighbours have it.
            middle = sensor.pixels // 2
            others = [(middle - 1, middle), (middle + 1, middle)]
            others += [(middle, middle - 1), (middle, middle + 1)]
            result[middle, middle] = np.mean([result[place] for place in others], axis=0)
        return cls(sensor, there.astype(float), result, errors)

    def at(self, directions: Numbers) -> tuple[Numbers, Numbers]:
        """Return matrices (n, wavelengths, 4, 4), errors (n, wavelengths) of the nearest pixels."""
        pixels = self.sensor.pixels
        across, up = (each - 0.5 for each in self.sensor.at(directions))
        result = np.zeros((len(directions), *self.matrices.shape[2:]))
        errors, total = np.zeros(result.shape[:2]), np.zeros(len(directions))
        for row in (np.floor(up), np.floor(up) + 1.0):
            for column in (np.floor(across), np.floor(across) + 1.0):
                i, j = (np.clip(each, 0, pixels - 1).astype(int) for each in (row, column))
                share = (1.0 - np.abs(up - row)) * (1.0 - np.abs(across - column))
                share *= self.there[i, j]
                result += share[:, None, None, None] * self.matrices[i, j]
                errors += share[:, None] * self.errors[i, j]
                total += share
        total = np.where(total > 0.0, total, 1.0)[:, None]
        return result / total[..., None, None], errors / total


def level_frame(z: Numbers) -> Frame:
    """Return the level frames of light along directions z (..., 3) above the horizon."""
    x = _ACROSS - z[..., 1:2] / (1.0 + z[..., 2:]) * (z + _UP)
    return Frame.trusted(x, np.cross(z, x), z.copy())


def in_frames(matrix: Mueller, before: Frame, behind: Frame) -> Numbers:
    """Return Mueller matrices (..., 4, 4) in other frames of the same directions."""
    as_it_is = np.eye(4)
    turned = Mueller.of(as_it_is, behind, behind) @ matrix @ Mueller.of(as_it_is, before, before)
    return np.asarray(turned.matrix)


def _unturned(sensor: Sensor, there: npt.NDArray[np.bool_]) -> Numbers:
    """Return by what S1 and S2 of the light of pixels come to be in level frames.

    The inverse of the mean turn over each pixel, since next to the normal the frame turns a lot
    within one pixel. Shape: returns (rows, columns, 1, 2, 2).
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
    """Return frames of shape (n, 1) for matrices of (n, wavelengths)."""
    return Frame.trusted(frame.x[:, None], frame.y[:, None], frame.z[:, None], frame.rounding)


LOWEST = float(np.cos(np.radians(89.0)))
"""The cosine of the angle to the normal beyond which nothing is tabulated."""


class HalfAngles(NamedTuple):
    """The axes of a table, in radians (S. Rusinkiewicz, A New Change of Variables, 1998).

    The half vector h is halfway between the directions to the light and to the eye, at theta_h to
    the normal n; the light is at theta_d to h, and phi_d about it: 0 towards (n x h) x h, pi / 2
    towards n x h.
    """

    phi_d: Numbers
    theta_d: Numbers
    theta_h: Numbers

    @classmethod
    def of(cls, shape: tuple[int, int, int]) -> HalfAngles:
        """Return axes of a shape: whole turns and right angles in equal steps.

        Those of theta_h are (place / last)^2, narrow near 0, as in W. Matusik et al., A Data-Driven
        Reflectance Model, 2003.

        >>> axes = HalfAngles.of((5, 3, 4))
        >>> print(np.degrees(axes.theta_h))
        [ 0. 10. 40. 90.]
        """
        turns, rights, halves = shape
        squares = np.linspace(0.0, 1.0, halves) ** 2
        return cls(
            np.linspace(-np.pi, np.pi, turns),
            np.linspace(0.0, np.pi / 2.0, rights),
            squares * (np.pi / 2.0),
        )

    def frames(self, turn: int) -> tuple[npt.NDArray[np.bool_], Frame, Frame]:
        """Return the frames of the light that comes and goes at one of the phi_d.

        Shapes: returns there (theta_d, theta_h), before, behind (n,).
        """
        c, s = np.cos(self.phi_d[turn]), np.sin(self.phi_d[turn])
        ch, sh = np.cos(self.theta_h), np.sin(self.theta_h)
        # Of cos(theta_d) ch -+ sin(theta_d) c sh, which is R cos(theta_d + angle).
        size, angle = np.hypot(ch, c * sh), np.arctan2(np.abs(c) * sh, ch)
        most = np.arccos(np.minimum(LOWEST / size, 1.0)) - angle
        there = np.broadcast_to(most >= 0.0, (len(self.theta_d), len(self.theta_h)))
        theta_d = np.minimum(self.theta_d[:, np.newaxis], most)[there][:, np.newaxis]
        half = np.stack([sh, np.zeros_like(sh), ch], axis=-1)
        along = np.stack([c * ch, np.full_like(sh, s), -c * sh], axis=-1)
        x = np.stack([s * ch, np.full_like(sh, -c), -s * sh], axis=-1)
        half, along, x = (
            np.broadcast_to(each, (*there.shape, 3))[there] for each in (half, along, x)
        )
        to_eye = np.cos(theta_d) * half - np.sin(theta_d) * along
        from_light = -np.cos(theta_d) * half - np.sin(theta_d) * along
        before = Frame.trusted(x, np.cross(from_light, x), from_light)
        return there, before, Frame.trusted(x.copy(), np.cross(to_eye, x), to_eye)
