"""PairedRun: some photons with polarisation and without, and what they tell pixel by pixel."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.surfaces.decisions.largest_of import LargestOf
from optipath.surfaces.hemispheres.measure import measure

if TYPE_CHECKING:
    from optipath.surfaces.hemispheres.hemisphere import Hemisphere
    from optipath.surfaces.hemispheres.pixel_mask import PixelMask
    from optipath.surfaces.samples.sample import Sample

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PairedRun:
    """Photons that fall on a sample, all that come back, and those that have met it once."""

    sample: Sample
    incidence: Any
    mask: PixelMask
    side: str
    walked: dict[str, Any]

    @cached_property
    def hemisphere(self) -> Hemisphere:
        """The light of all photons."""
        return measure(self.sample, self.incidence, **self.walked)

    @cached_property
    def once(self) -> Hemisphere:
        """The light of those of the same photons that have met the surface once."""
        return measure(self.sample, self.incidence, **self.walked, polarized="scalar", events=1)

    @cached_property
    def counts(self) -> npt.NDArray[np.bool_]:
        """The pixels that count, (rows, columns): at least one."""
        found = self.hemisphere
        light = found.scalar_light(found.side(self.side))
        counts = self.mask.bright(light)
        if not counts.any():
            raise SurfaceError(self._none_counts(light))
        return counts

    @cached_property
    def difference(self) -> LargestOf:
        """The largest abs(S0 - U) / U of a pixel at a wavelength."""
        found = self.hemisphere.relative_difference(
            self.side, brighter_than=self.mask.brighter_than
        )
        counts = self.counts
        return LargestOf.of(found.values[counts], found.se.values[counts])

    @cached_property
    def multiple(self) -> LargestOf:
        """The largest share of a pixel's light that has met the surface more than once."""
        every, single = self.hemisphere.own, self.once.own
        both = every._replace(
            sums=np.concatenate([every.sums[..., -1:], single.sums[..., -1:]], axis=-1)
        )
        value, error = both.estimate(lambda light: 1.0 - light[..., 1] / light[..., 0])
        at, counts = self.hemisphere.side(self.side), self.counts
        return LargestOf.of(value[at][counts], error[at][counts])

    @cached_property
    def beside_model(self) -> LargestOf:
        """How far the analytic model is off all light of a pixel, over that light, at most."""
        found = self.hemisphere
        model = found.single_scattering().values[..., 0, 0]
        value, error = found.own.estimate(
            lambda light: model / found.matrices(light)[:1, ..., 0, 0] - 1.0
        )
        return LargestOf.of(value[0][self.counts], error[0][self.counts])

    @property
    def told(self) -> str:
        """How it was made, in words."""
        sensor = self.hemisphere.sensor
        return (
            f"{self.hemisphere.photons:,} photons, {sensor.pixels} x {sensor.pixels} pixels, of "
            f"which {self.counts.sum()} count: {self.mask}"
        )

    def _none_counts(self, light: Numbers) -> str:
        photons, most = self.hemisphere.photons, np.nanmax(light)
        if not most:
            other = ", or look at the other side" if len(self.hemisphere.seen.sides) > 1 else ""
            return (
                f"no pixel counts: of {photons:,} photon{'s' if photons > 1 else ''} none is "
                f"{self.side}; walk more photons{other}"
            )
        brightest = most / np.nanmean(light)
        return (
            f"no pixel counts: none has {self.mask.brighter_than:g} times the mean light of the "
            f"hemisphere's pixels, and the brightest {brightest:.3g} times; give a smaller "
            f"brighter_than, such as 0.2"
        )
