"""What has become of the photons of a block."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    import numpy.typing as npt


class WalkedBlock(NamedTuple):
    """What has become of the photons of a block.

    Attributes
    ----------
    photons : int
        How many there were.
    sums : mapping of int to ndarray, shape (OUTCOMES, MOST_COUNTED, lights, SUMS)
        By the surface that they walked over; as `walk_layout` says.
    record : ndarray, shape (events + 1, RECORD)
        The photon that was wanted.
    starts : ndarray, shape (2 layers,)
        Where on each mesh the last photon has started, along x and along y.
    lights : ndarray, shape (lights, CARRIED)
        The lights of the last photon.
    ends : ndarray, shape (photons, ENDS + CARRIED lights)
        The end of every photon, where these are kept.
    """

    photons: int
    sums: Mapping[int, npt.NDArray[np.float64]]
    record: npt.NDArray[np.float64]
    starts: npt.NDArray[np.float64]
    lights: npt.NDArray[np.float64]
    ends: npt.NDArray[np.float64]
