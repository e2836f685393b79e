"""PartSums: what light falls on each pixel, in parts of the photons that know nothing of others."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
import numpy.typing as npt

from optipath.surfaces.hemispheres.given_estimate import following

if TYPE_CHECKING:
    from collections.abc import Callable

Numbers = npt.NDArray[np.float64]

_MIRRORED = np.outer([1.0, 1.0, -1.0, -1.0], [1.0, 1.0, -1.0, -1.0]).ravel()
"""What a Mueller matrix is multiplied by in a mirror that is the plane of incidence."""


class PartSums(NamedTuple):
    """Sums over photons, part by part; or, where none are walked, light that is known exactly.

    Shapes: sums (parts, sides, rows, columns, wavelengths, numbers); counts (sides, rows, columns);
    photons (parts,).
    """

    sums: Numbers
    counts: npt.NDArray[np.int64]
    photons: npt.NDArray[np.int64]

    @classmethod
    def none(cls, shape: tuple[int, ...]) -> Self:
        """Return the sums over no photons."""
        zero = np.zeros(shape)
        return cls(zero, np.zeros(shape[1:4], np.int64), np.zeros(shape[0], np.int64))

    def add(self, other: PartSums) -> None:
        """Add the sums over other photons to these."""
        for mine, its in zip(self, other, strict=True):
            np.add(mine, its, out=mine)

    def mirrored(self) -> PartSums:
        """Return the means of what there is and its mirror image across the plane of incidence.

        On a sample that is the same in a mirror they have the same expectation, and less noise.
        """
        numbers = self.sums.shape[-1]
        signs = np.append(_MIRRORED, 1.0)[-numbers if numbers == 1 else slice(numbers)]
        return self._replace(sums=0.5 * (self.sums + self.sums[:, :, ::-1] * signs))

    def estimate(self, found: Callable[[Numbers], Numbers]) -> tuple[Numbers, Numbers]:
        """Return what follows from the light of the pixels, and its standard error.

        The jackknife: the spread of what follows where one part after the other is left out
        (B. Efron, The Jackknife, the Bootstrap and Other Resampling Plans, SIAM 1982, eq. 3.13).
        """
        found = following(found)
        total, photons = self.sums.sum(axis=0), self.photons.sum()
        if not photons:
            with np.errstate(invalid="ignore", divide="ignore"):
                value = found(total)
            return value, np.zeros_like(value)
        with np.errstate(invalid="ignore", divide="ignore"):
            value = found(total / photons)
            # Of the differences from the whole, since the squares of the values cancel.
            mean, square, parts = np.zeros_like(value), np.zeros_like(value), 0
            for part, size in zip(self.sums, self.photons, strict=True):
                if size:
                    apart = found((total - part) / (photons - size)) - value
                    mean, square, parts = mean + apart, square + apart * apart, parts + 1
            if parts < 2:
                return value, np.full_like(value, np.nan)
            variance = (parts - 1) / parts * np.maximum(square - mean * mean / parts, 0.0)
            return value, np.sqrt(variance)
