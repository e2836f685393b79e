"""Energy: what a sample does with light, with polarisation and without."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from optipath.surfaces.energies.energy_shares import EnergyShares, energy_shares
from optipath.surfaces.walk.walk_layout import (
    COUNT,
    INTENSITY,
    INTENSITY_SQUARED,
    PRODUCT,
    SCALAR,
    SCALAR_SQUARED,
    SIDEWAYS,
    STUCK,
)

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from optipath.surfaces.walk.photon_beam import PhotonBeam


@dataclass(frozen=True, eq=False)
class Energy(EnergyShares):
    """What becomes of the light that falls on a sample; the shares are those of `EnergyShares`.

    Standard errors are over the photons, and over the realisations of random surfaces that they
    fell on. Of one surface nothing is known of others; of one photon nothing at all (NaN).
    """

    scalar: EnergyShares
    difference: EnergyShares
    photons: int
    surfaces: int
    sideways: int
    stuck: int

    @classmethod
    def of(cls, beam: PhotonBeam, sums: npt.NDArray[np.float64]) -> Energy:
        """Return what sums over photons say.

        Shape: sums (surfaces, ends, events, lights, SUMS).
        """
        source, shape = beam.states[0][0], beam.indices.n.shape
        counts = sums[..., 0, COUNT]
        photons = counts.sum(axis=(1, 2))

        def shares(
            total: npt.NDArray[np.float64], squares: npt.NDArray[np.float64], whole: float
        ) -> EnergyShares:
            wanted = (*sums.shape[:3], *shape)
            return energy_shares(
                photons,
                (total / source).reshape(wanted),
                (squares / source**2).reshape(wanted),
                whole,
            )

        polarised, scalar = sums[..., INTENSITY], sums[..., SCALAR]
        squares, scalar_squares = sums[..., INTENSITY_SQUARED], sums[..., SCALAR_SQUARED]
        apart = squares - 2.0 * sums[..., PRODUCT] + scalar_squares
        return cls(
            **vars(shares(polarised, squares, 1.0)),
            scalar=shares(scalar, scalar_squares, 1.0),
            difference=shares(polarised - scalar, apart, 0.0),
            photons=int(photons.sum()),
            surfaces=int((photons > 0.0).sum()),
            sideways=int(counts[:, SIDEWAYS].sum()),
            stuck=int(counts[:, STUCK].sum()),
        )
