"""The polarised BRDF that hemispheres of several incidences have measured, between these too."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown
from optipath.light.frames import Frame
from optipath.light.mueller.matrix import Mueller
from optipath.surfaces.files.half_angles import LOWEST
from optipath.surfaces.files.level_pixels import (
    LevelPixels,
    each_wavelength,
    in_frames,
    level_frame,
)
from optipath.surfaces.hemispheres.hemisphere import Hemisphere

if TYPE_CHECKING:
    from collections.abc import Sequence

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True)
class BrdfOfHemispheres:
    """What hemispheres have measured of an isotropic sample, for light from anywhere.

    Between two incidences, by the share of each: what each of them has where light of its
    incidence goes that is mirrored by the same facet, so that lobes stay where they are; times
    cos(theta_i) cos(theta_o), by which the light of facets is divided. Beyond the first and the
    last incidence it is that of these, by the same facet.
    """

    hemispheres: tuple[Hemisphere, ...]

    @classmethod
    def of(cls, hemispheres: Sequence[Any]) -> BrdfOfHemispheres:
        """Return that of hemispheres in any order."""
        for each in hemispheres:
            if not isinstance(each, Hemisphere):
                raise SurfaceError(f"{shown(each)} is no hemisphere; give what op.measure returns")
        if len(hemispheres) < 2:
            raise SurfaceError(
                f"{len(hemispheres) or 'no'} hemisphere is not enough for all incidences; measure "
                f"at several, such as every 5 deg from 0 to 85 deg"
            )
        found = tuple(sorted(hemispheres, key=_incidence))
        first = found[0]
        for each, before in zip(found[1:], found, strict=False):
            if not np.array_equal(each.wavelengths, first.wavelengths, equal_nan=True):
                raise SurfaceError(f"{each} has other wavelengths than {first}")
            if each.seen.beam.sample != first.seen.beam.sample:
                raise SurfaceError(f"{each} is of another sample than {first}")
            if _incidence(each) == _incidence(before):
                raise SurfaceError(f"{each} is there twice; leave one of them out")
        if not first.seen.beam.sample.isotropic:
            raise SurfaceError(
                "the table is of samples that look the same from all sides, and this one is not "
                "isotropic"
            )
        return cls(found)

    @property
    def wavelengths(self) -> Numbers:
        """In metres; NaN where nothing depends on them."""
        return self.hemispheres[0].wavelengths

    @cached_property
    def _pixels(self) -> list[LevelPixels]:
        return [LevelPixels.of(each) for each in self.hemispheres]

    def at(self, before: Frame, behind: Frame) -> tuple[Numbers, Numbers]:
        """Return the BRDF for light that comes and goes in frames whose x is across both.

        Shapes: before, behind (n,); returns matrices (n, wavelengths, 4, 4), errors (n,
        wavelengths).
        """
        to_light, to_eye = -before.z, behind.z
        half = to_light + to_eye
        half = half / np.linalg.norm(half, axis=-1, keepdims=True)
        known = np.array([_incidence(each) for each in self.hemispheres])
        place = np.interp(np.arccos(to_light[:, 2]), known, np.arange(len(known)))
        matrices = np.zeros((len(half), len(self.wavelengths), 4, 4))
        errors = np.zeros(matrices.shape[:2])
        for number, pixels in enumerate(self._pixels):
            share = np.maximum(1.0 - np.abs(place - number), 0.0)
            near = share > 0.0
            found = _by_same_facet(
                pixels, known[number], to_light[near], half[near], before.x[near]
            )
            matrices[near] += share[near][:, None, None, None] * found[0]
            errors[near] += share[near][:, None] * found[1]
        over = (to_light[:, 2] * to_eye[:, 2])[:, None]
        return matrices / over[..., None, None], errors / over


def _incidence(hemisphere: Hemisphere) -> float:
    beam = hemisphere.seen.beam
    return float(np.arctan2(beam.sin, beam.cos))


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
    found = in_frames(
        Mueller.of(matrices, own, each_wavelength(level_frame(eye))),
        each_wavelength(Frame.from_direction(np.broadcast_to(-light, x.shape), x)),
        each_wavelength(Frame.from_direction(eye, x)),
    )
    both = up * eye[:, 2][:, None]
    return found * both[..., None, None], errors * both
