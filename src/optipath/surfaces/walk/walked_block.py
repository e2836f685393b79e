"""What has become of the photons of a block."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    import numpy.typing as npt


class WalkedBlock(NamedTuple):
    """What has become of the photons of a block.

    Shapes: sums (OUTCOMES, MOST_COUNTED, lights, SUMS); record (events + 1, RECORD); starts (2
    layers,); lights (lights, CARRIED); ends (photons, ENDS + CARRIED lights).
    """

    photons: int
    sums: Mapping[int, npt.NDArray[np.float64]]
    record: npt.NDArray[np.float64]
    starts: npt.NDArray[np.float64]
    lights: npt.NDArray[np.float64]
    ends: npt.NDArray[np.float64]
