"""Mean, standard deviation and covariance of samples that come in blocks."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from optipath.sweeps.uncertainty.light_figures import STOKES
from optipath.sweeps.uncertainty.scaled_squares import LEAST, covariance_of, exponent_of

Array = npt.NDArray[np.float64]


class SampleMoments:
    """Sums of what samples of figures differ by from those at the best estimates.

    One sample is added after the other, so that the sums are the same to the last bit in whatever
    blocks; each figure of each path is divided by a power of two, so that no square of it is too
    small or too large for a float.

    Examples
    --------
    >>> moments = SampleMoments()
    >>> moments.add(np.full((2, 10), [[1e-200], [3e-200]]))
    >>> print(moments.mean[0], f"{moments.deviation[0]:.3g}")
    2e-200 1.41e-200
    """

    def __init__(self) -> None:
        self._count = 0
        self._exponent: Any = np.int32(LEAST)
        self._first: Any = 0.0
        self._second: Any = 0.0
        self._crossed: Any = 0.0

    def add(self, apart: Array) -> None:
        """Add a block of samples.

        Parameters
        ----------
        apart : ndarray, shape (samples, ..., 10)
            By how much their figures differ.
        """
        before = self._exponent
        self._exponent = exponent = np.maximum(before, exponent_of(apart, 0))
        by = before - exponent
        with np.errstate(all="ignore"):
            scaled = np.ldexp(apart, -exponent)
            stokes, by_stokes = scaled[..., :STOKES], by[..., :STOKES]
            crossed_by = by_stokes[..., :, np.newaxis] + by_stokes[..., np.newaxis, :]
            product = stokes[..., :, np.newaxis] * stokes[..., np.newaxis, :]
            self._first = _added(np.ldexp(self._first, by), scaled)
            self._second = _added(np.ldexp(self._second, 2 * by), scaled**2)
            self._crossed = _added(np.ldexp(self._crossed, crossed_by), product)
        self._count += len(apart)

    @property
    def mean(self) -> Array:
        """Their mean, shape (..., 10)."""
        with np.errstate(all="ignore"):
            return np.asarray(np.ldexp(self._mean, self._exponent))

    @property
    def deviation(self) -> Array:
        """Their standard deviation, shape (..., 10)."""
        with np.errstate(all="ignore"):
            left = np.maximum(self._second - self._count * self._mean**2, 0.0)
            return np.asarray(np.ldexp(np.sqrt(left / (self._count - 1)), self._exponent))

    @property
    def covariance(self) -> Array:
        """That of the Stokes vector, shape (..., 4, 4); NaN for what no float holds."""
        with np.errstate(all="ignore"):
            mean = self._mean[..., :STOKES]
            product = mean[..., :, np.newaxis] * mean[..., np.newaxis, :]
            left = (self._crossed - self._count * product) / (self._count - 1)
        return covariance_of(left, self._exponent[..., :STOKES])

    @property
    def _mean(self) -> Any:
        return self._first / self._count


def _added(total: Any, more: Any) -> Any:
    """Return a sum with what is added to it, one after the other along the first axis."""
    total = np.broadcast_to(total, more.shape[1:])
    return np.cumsum(np.concatenate([total[np.newaxis], more]), axis=0)[-1]
