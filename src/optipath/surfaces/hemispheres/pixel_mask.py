"""PixelMask: which pixels are bright enough, and known well enough, to be compared."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True)
class PixelMask:
    """Pixels that count where light with polarisation and without are compared.

    Dim pixels decide how large the largest difference is, so that none is worth anything without
    its mask; and the largest of many noisy ones is noise.

    Examples
    --------
    >>> print(PixelMask(brighter_than=0.5, noise=None))
    light without polarisation above 0.5 of the mean over the hemisphere's pixels, any noise
    """

    brighter_than: float = 0.2
    noise: float | None = 0.2
    known_to: float = 0.001

    def __post_init__(self) -> None:
        """Refuse all faults."""
        given = {"brighter_than": self.brighter_than, "known_to": self.known_to}
        if self.noise is not None:
            given["noise"] = self.noise
        faults = [
            f"{name} is {shown(value)}; give a number from 0, such as {_USUAL[name]:g}"
            for name, value in given.items()
            if not _is_threshold(value)
        ]
        if faults:
            raise SurfaceError(*faults)

    def bright(self, light: Numbers) -> npt.NDArray[np.bool_]:
        """Return which pixels are bright enough.

        Shapes: light (rows, columns); returns (rows, columns).
        """
        return np.asarray(light > self.brighter_than * np.nanmean(light))

    def known(self, difference: Numbers, error: Numbers) -> npt.NDArray[np.bool_]:
        """Return which differences are known well enough.

        Shapes: difference, error (...); returns (...).
        """
        if self.noise is None:
            return ~np.isnan(difference)
        return np.asarray(error <= np.maximum(self.noise * np.abs(difference), self.known_to))

    def __str__(self) -> str:
        bright = (
            f"light without polarisation above {self.brighter_than:g} of the mean over the "
            "hemisphere's pixels"
        )
        if self.noise is None:
            return f"{bright}, any noise"
        return (
            f"{bright}, standard error at most {self.noise:g} of the difference, or at most "
            f"{self.known_to:g}"
        )


_USUAL = {"brighter_than": 0.2, "noise": 0.2, "known_to": 0.001}


def _is_threshold(value: Any) -> bool:
    real = isinstance(value, Real) and not isinstance(value, bool | np.bool_)
    return real and 0.0 <= float(value) < np.inf
